// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Collective calls of one side of the link.
#include "link/ranks.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

namespace eccentra::link {
namespace {

using Nap = std::chrono::microseconds;
constexpr Nap kShortestNap(20);
constexpr Nap kLongestNap(500);

/// Tag of the empty message by which a rank ends the waits of the others.
constexpr int kAlarm = 20561;

/// This rank has waited in vain because another one has failed.
struct OthersFailed {};

void look_for_alarm(MPI_Comm ranks) {
  int there = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, kAlarm, ranks, &there, MPI_STATUS_IGNORE);
  if (there)
    throw OthersFailed();
}

void raise_alarm(MPI_Comm ranks) {
  for (int rank = 0; rank < size_of(ranks); ++rank)
    if (rank != rank_of(ranks))
      MPI_Send(nullptr, 0, MPI_BYTE, rank, kAlarm, ranks);
}

/// Rows as one MPI type, so that calls count rows and not bytes.
class RowType {
 public:
  explicit RowType(std::size_t bytes) {
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~RowType() { MPI_Type_free(&type_); }
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_;
};

} // namespace

int rank_of(MPI_Comm ranks) {
  int rank = 0;
  MPI_Comm_rank(ranks, &rank);
  return rank;
}

int size_of(MPI_Comm ranks) {
  int size = 1;
  MPI_Comm_size(ranks, &size);
  return size;
}

void wait_asleep(MPI_Request& request) {
  Nap nap = kShortestNap;
  for (;;) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done)
      return;
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, kLongestNap);
  }
}

std::vector<long long> on_all(MPI_Comm ranks, const std::function<long long(const Look&)>& work) {
  struct Result {
    long long failed = 0; ///< length of its sentence
    long long value = 0;
  };
  Result mine;
  std::string why;
  try {
    mine.value = work([ranks] { look_for_alarm(ranks); });
  } catch (const OthersFailed&) {
    // One of them has the sentence.
  } catch (const std::exception& problem) {
    why = problem.what();
    mine.failed = static_cast<long long>(std::max<std::size_t>(why.size(), 1));
    raise_alarm(ranks);
  }
  const int size = size_of(ranks), own = rank_of(ranks);
  std::vector<Result> results(size);
  MPI_Request request;
  MPI_Iallgather(&mine, 2, MPI_LONG_LONG, results.data(), 2, MPI_LONG_LONG, ranks, &request);
  wait_asleep(request);
  int first = size;
  std::vector<long long> values;
  for (int rank = size - 1; rank >= 0; --rank) {
    values.insert(values.begin(), results[rank].value);
    if (results[rank].failed == 0)
      continue;
    first = rank;
    if (rank != own)
      MPI_Recv(nullptr, 0, MPI_BYTE, rank, kAlarm, ranks, MPI_STATUS_IGNORE);
  }
  if (first == size)
    return values;
  why.resize(results[first].failed);
  MPI_Bcast(why.data(), static_cast<int>(why.size()), MPI_CHAR, first, ranks);
  throw Refusal(why);
}

wire::Bytes on_root(MPI_Comm ranks, const std::function<wire::Bytes()>& work) {
  wire::Bytes result;
  long long head[2] = {0, 0}; // length; whether it is a refusal
  if (rank_of(ranks) == 0) {
    try {
      result = work();
    } catch (const std::exception& problem) {
      const std::string text = problem.what();
      const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
      result.assign(bytes, bytes + text.size());
      head[1] = 1;
    }
    head[0] = static_cast<long long>(result.size());
  }
  if (size_of(ranks) > 1) {
    MPI_Request request;
    MPI_Ibcast(head, 2, MPI_LONG_LONG, 0, ranks, &request);
    wait_asleep(request);
    result.resize(head[0]);
    MPI_Bcast(result.data(), static_cast<int>(head[0]), MPI_BYTE, 0, ranks);
  }
  if (head[1])
    throw Refusal(std::string(reinterpret_cast<const char*>(result.data()), result.size()));
  return result;
}

Shares gather_shares(MPI_Comm ranks, std::size_t count) {
  Shares shares;
  const bool root = rank_of(ranks) == 0;
  if (root) {
    shares.count.resize(size_of(ranks));
    shares.begin.resize(shares.count.size());
  }
  const int mine = static_cast<int>(count);
  MPI_Gather(&mine, 1, MPI_INT, shares.count.data(), 1, MPI_INT, 0, ranks);
  for (std::size_t r = 0; r < shares.count.size(); ++r) {
    shares.begin[r] = shares.total;
    shares.total += shares.count[r];
  }
  return shares;
}

Shares even_shares(MPI_Comm ranks, std::size_t count) {
  Shares shares;
  const int size = size_of(ranks);
  for (int r = 0; r < size; ++r) {
    shares.begin.push_back(static_cast<int>(count * r / size));
    shares.count.push_back(static_cast<int>(count * (r + 1) / size) - shares.begin.back());
  }
  shares.total = static_cast<int>(count);
  return shares;
}

void gather_rows(MPI_Comm ranks, const std::byte* mine, int count, std::size_t row_bytes, const Shares& shares,
                 std::byte* all) {
  if (size_of(ranks) == 1)
    return;
  const RowType row(row_bytes);
  MPI_Gatherv(rank_of(ranks) == 0 ? MPI_IN_PLACE : mine, count, row.get(), all, shares.count.data(),
              shares.begin.data(), row.get(), 0, ranks);
}

void scatter_rows(MPI_Comm ranks, const std::byte* all, const Shares& shares, std::size_t row_bytes, std::byte* mine,
                  int count) {
  if (size_of(ranks) == 1)
    return;
  const RowType row(row_bytes);
  MPI_Scatterv(all, shares.count.data(), shares.begin.data(), row.get(),
               rank_of(ranks) == 0 ? MPI_IN_PLACE : static_cast<void*>(mine), count, row.get(), 0, ranks);
}

} // namespace eccentra::link
