// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Connections beside the one between the two ranks 0: each further rank of the DEM side has one for its rows.
#pragma once

#include "link/socket/address.h"
#include "link/socket/channel.h"

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace eccentra::link {

/// The reason for which the ranks of this side cannot have `count` rank connections beside the address `main`, as a
/// clause for the message that all rows pass over rank 0; empty if they can. Collective.
std::string why_no_rank_connections(MPI_Comm ranks, Channel::Side side, const Address& main, std::uint32_t count);

/// One end of a rank connection.
struct RankConnection {
  std::uint32_t rank = 0;           ///< of DEM, from 1 on
  std::unique_ptr<Channel> channel; ///< open
  Channel::Message message;         ///< the last one received
};

/// The rank connections of this rank: of rank r of DEM, if it is not 0, the one to rank r mod F of the fluid's F ranks.
class RankConnections {
 public:
  /// The fluid side: binds rank connections for ranks 1 to `count` of DEM and returns, on rank 0, their numbers
  /// (Address::rank connection). Collective; throws Refusal on every rank if an address cannot be used.
  std::vector<std::uint32_t> bind(MPI_Comm ranks, const Address& main, const Timeout& patience, std::uint32_t count);
  /// The fluid side, after the DEM side has received the numbers: waits until all have connected. Collective; throws
  /// Refusal on every rank if one does not, or is another program. `extents` is that of the terms of the DEM side.
  void greet(MPI_Comm ranks, bool extents);
  /// The DEM side: connects. Collective; throws Refusal on every rank if an address cannot be used.
  void connect(MPI_Comm ranks, const Address& main, const Timeout& patience, const std::vector<std::uint32_t>& numbers,
               bool extents);
  /// As Channel::refuse, on all rank connections of this rank. Not collective.
  void refuse(const std::string& sentence) noexcept;
  /// Closes all of this rank's.
  void close() noexcept { rank_connections_.clear(); }

  /// First of this rank's.
  std::vector<RankConnection>::iterator begin() { return rank_connections_.begin(); }
  /// Behind the last.
  std::vector<RankConnection>::iterator end() { return rank_connections_.end(); }

 private:
  std::vector<RankConnection> rank_connections_;
};

} // namespace eccentra::link
