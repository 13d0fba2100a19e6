// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Messages, operations and bytes are counted as they were sent, on two ranks; waiting is timed.
#include "link/communication.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <array>
#include <chrono>
#include <functional>
#include <thread>

namespace {

using eccentra::link::communication;
using eccentra::link::Communication;

int my_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

Communication counted(const std::function<void()>& calls) {
  const Communication before = communication();
  calls();
  return communication() - before;
}

constexpr int kCount = 5;
constexpr double kBytes = kCount * sizeof(double);

} // namespace

TEST(MpiCounters, MessagesCountWhereTheyAreSent) {
  std::array<double, kCount> out{}, in{};
  const int other = 1 - my_rank();
  const Communication both = counted([&] {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(out.data(), kCount, MPI_DOUBLE, other, 0, MPI_COMM_WORLD, &request);
    MPI_Recv(in.data(), kCount, MPI_DOUBLE, other, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    MPI_Sendrecv(out.data(), 1, MPI_DOUBLE, other, 1, in.data(), 1, MPI_DOUBLE, other, 1, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
  });
  EXPECT_EQ(both.messages, 2);
  EXPECT_EQ(both.bytes, kBytes + sizeof(double));
  EXPECT_EQ(both.operations, 0);

  const Communication one = counted([&] {
    if (my_rank() == 0)
      MPI_Send(out.data(), kCount, MPI_DOUBLE, other, 0, MPI_COMM_WORLD);
    else
      MPI_Recv(in.data(), kCount, MPI_DOUBLE, other, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  });
  EXPECT_EQ(one.messages, my_rank() == 0 ? 1 : 0);
  EXPECT_EQ(one.bytes, my_rank() == 0 ? kBytes : 0);
}

TEST(MpiCounters, OperationsCountWhatEachRankHandsOver) {
  std::array<double, kCount> out{}, in{};
  std::array<double, 2 * kCount> all{};
  const Communication sums = counted([&] {
    MPI_Allreduce(out.data(), in.data(), kCount, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, in.data(), kCount, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    MPI_Barrier(MPI_COMM_WORLD);
  });
  EXPECT_EQ(sums.operations, 3);
  EXPECT_EQ(sums.bytes, 2 * kBytes);
  EXPECT_EQ(sums.messages, 0);

  // Some arguments count on the root only, or not at all in place: they are no types or null there.
  const std::array<int, 2> counts{kCount, kCount}, begins{0, kCount};
  const bool root = my_rank() == 0;
  const Communication rooted = counted([&] {
    MPI_Bcast(out.data(), kCount, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    MPI_Scatter(root ? all.data() : nullptr, root ? kCount : 0, root ? MPI_DOUBLE : MPI_DATATYPE_NULL, in.data(),
                kCount, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    MPI_Scatterv(root ? all.data() : nullptr, root ? counts.data() : nullptr, root ? begins.data() : nullptr,
                 root ? MPI_DOUBLE : MPI_DATATYPE_NULL, in.data(), kCount, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  });
  EXPECT_EQ(rooted.operations, 3);
  EXPECT_EQ(rooted.bytes, root ? 5 * kBytes : 0);

  const Communication gathered = counted([&] {
    MPI_Allgather(out.data(), kCount, MPI_DOUBLE, all.data(), kCount, MPI_DOUBLE, MPI_COMM_WORLD);
    MPI_Allgather(MPI_IN_PLACE, kCount, MPI_DOUBLE, all.data(), kCount, MPI_DOUBLE, MPI_COMM_WORLD);
    MPI_Alltoallv(MPI_IN_PLACE, nullptr, nullptr, MPI_DATATYPE_NULL, all.data(), counts.data(), begins.data(),
                  MPI_DOUBLE, MPI_COMM_WORLD);
  });
  EXPECT_EQ(gathered.operations, 3);
  EXPECT_EQ(gathered.bytes, kBytes);
}

TEST(MpiCounters, WaitingForALateRankIsTimed) {
  constexpr std::chrono::milliseconds kLate(100);
  MPI_Barrier(MPI_COMM_WORLD);
  const Communication waiting = counted([&] {
    if (my_rank() == 1)
      std::this_thread::sleep_for(kLate);
    MPI_Barrier(MPI_COMM_WORLD);
  });
  if (my_rank() == 0)
    EXPECT_GT(waiting.waited, 0.9 * std::chrono::duration<double>(kLate).count());
}
