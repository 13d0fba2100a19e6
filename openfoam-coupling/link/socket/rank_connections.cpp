// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Opens rank connections, on both sides.
#include "link/socket/rank_connections.h"

#include "link/ranks.h"

namespace eccentra::link {
namespace {

/// Both sides are there when their rank connections are opened: a part of the time after which a silent peer is lost is
/// enough.
constexpr double kComesWithin = 0.9;

Timeout timeout_of_rank_connection(const Timeout& main) {
  return {main.silence, kComesWithin * main.silence};
}

bool is_unix_socket(const Address& address) {
  return endpoint_of(address).compare(0, 3, "ipc") == 0;
}

bool are_on_one_host(MPI_Comm ranks) {
  MPI_Comm host = MPI_COMM_NULL;
  MPI_Comm_split_type(ranks, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
  int one = size_of(host) == size_of(ranks) ? 1 : 0;
  MPI_Comm_free(&host);
  MPI_Allreduce(MPI_IN_PLACE, &one, 1, MPI_INT, MPI_MIN, ranks);
  return one == 1;
}

} // namespace

std::string why_no_rank_connections(MPI_Comm ranks, Channel::Side side, const Address& main, std::uint32_t count) {
  const bool one_host = are_on_one_host(ranks);
  if (side == Channel::Side::fluid && !one_host)
    return "the ranks of the fluid are on several hosts";
  if (side == Channel::Side::dem && !one_host && is_of_this_machine(main))
    return "the ranks of DEM are on several hosts and '" + main.arguments + "' is an address of one of them";
  if (count > wire::kMaxRankConnections)
    return "DEM has more ranks than the " + std::to_string(wire::kMaxRankConnections) +
           " that may have a connection of their own";
  try {
    endpoint_of(Address(main, count));
  } catch (const Refusal&) {
    return "'" + main.arguments + "' is too long to be the beginning of the other ranks' addresses";
  }
  return "";
}

std::vector<std::uint32_t> RankConnections::bind(MPI_Comm ranks, const Address& main, const Timeout& patience,
                                                 std::uint32_t count) {
  const auto own = static_cast<std::uint32_t>(rank_of(ranks)), size = static_cast<std::uint32_t>(size_of(ranks));
  std::vector<std::uint32_t> mine(count, 0), numbers(count, 0);
  on_all(ranks, [&](const Look&) {
    const bool unix_socket = is_unix_socket(main);
    for (std::uint32_t rank = 1; rank <= count; ++rank) {
      if (rank % size != own)
        continue;
      const Address address(main, unix_socket ? rank : 0);
      rank_connections_.push_back(
          {rank, std::make_unique<Channel>(Channel::Side::fluid, address, timeout_of_rank_connection(patience)), {}});
      mine[rank - 1] = unix_socket ? rank : rank_connections_.back().channel->port();
    }
    return 0;
  });
  MPI_Reduce(mine.data(), numbers.data(), static_cast<int>(count), MPI_UINT32_T, MPI_MAX, 0, ranks);
  return numbers;
}

void RankConnections::greet(MPI_Comm ranks, bool extents) {
  on_all(ranks, [&](const Look& look) {
    for (RankConnection& connection : rank_connections_) {
      for (bool is_the_rank = false; !is_the_rank;) {
        connection.message = connection.channel->receive(look);
        try {
          if (wire::decode_rows(connection.message.view(), extents, {connection.rank, 0}).count != 0)
            throw Refusal("the DEM side spoke out of turn: install the same release of Eccentra on both sides");
          is_the_rank = true;
        } catch (const Refusal& why) {
          connection.channel->dismiss(why.what());
        }
      }
      connection.channel->settle();
    }
    return 0;
  });
}

void RankConnections::connect(MPI_Comm ranks, const Address& main, const Timeout& patience,
                              const std::vector<std::uint32_t>& numbers, bool extents) {
  on_all(ranks, [&](const Look&) {
    const auto rank = static_cast<std::uint32_t>(rank_of(ranks));
    if (rank == 0)
      return 0;
    const Address address(main, numbers.at(rank - 1));
    rank_connections_.push_back(
        {rank, std::make_unique<Channel>(Channel::Side::dem, address, timeout_of_rank_connection(patience)), {}});
    // The fluid side holds with the first comer: it shall know this one at once.
    Channel::Message hello(wire::kHeaderBytes + wire::kRowsBytes);
    wire::write_rows_head(hello.data(), {rank, 0}, 0, extents);
    rank_connections_.back().channel->send(std::move(hello));
    return 0;
  });
}

void RankConnections::refuse(const std::string& sentence) noexcept {
  for (RankConnection& connection : rank_connections_)
    connection.channel->refuse(sentence);
  close();
}

} // namespace eccentra::link
