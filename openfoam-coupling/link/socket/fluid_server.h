// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The fluid's end of the socket link: takes what the DEM job says to the fluid in this one.
#pragma once

#include "link/fluid_peer.h"
#include "link/socket/address.h"
#include "link/socket/channel.h"
#include "link/socket/rank_connections.h"

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace eccentra::link {

/// Rank 0 talks. Each rank takes the particles that come on its rank connections; where there are none, rank 0 deals
/// all out evenly. From there the fluid takes them to their cells.
class FluidServer {
 public:
  /// Collective over `ranks`: binds the address. `cells` of this rank's mesh bound what a cell hint may name. Throws
  /// Refusal on every rank if the address cannot be used.
  FluidServer(MPI_Comm ranks, const Address& address, const Timeout& patience, std::int32_t cells);
  ~FluidServer();

  /// Serves one DEM job until it says farewell. Collective. Throws Refusal on every rank if it does not come, goes
  /// without a word, refuses, or speaks nonsense; passes on what `fluid` throws. Whatever is thrown, the DEM side is
  /// told.
  void serve(FluidPeer& fluid);

 private:
  struct Command;
  Command next_command();
  // Of rank 0.
  DemTerms first_terms();
  wire::Bytes receive_command();
  void decode_command(Command& command);

  void answer_terms(FluidPeer& fluid, const Command& command);
  void answer_coupling_step(FluidPeer& fluid, const Command& command);
  void answer_checkpoint(FluidPeer& fluid, const Command& command);
  void answer_walls(FluidPeer& fluid);
  /// Once, when the first terms have been answered.
  void open_rank_connections(std::uint32_t count);
  /// This rank's particles: on rank 0 those of DEM's rank 0, and of each rank connection.
  std::vector<wire::Rows> rows_of_rank_connections(const Command& command);
  /// This rank's particles: its share of all that have come to rank 0.
  std::vector<wire::Rows> dealt_rows(const Command& command);
  /// Room for `count` samples behind a head.
  static Channel::Message answer(const Command& command, std::size_t count, int signal, const std::string& news = "");
  void refuse(const std::string& sentence) noexcept;

  MPI_Comm ranks_;
  Address address_;
  Timeout timeout_;
  std::unique_ptr<Channel> channel_; ///< of rank 0
  RankConnections rank_connections_;
  bool by_rank_connections_ = false;
  std::uint32_t rank_connections_asked_ = 0;
  std::int64_t coupling_steps_ = 0;
  Channel::Message message_; ///< of rank 0: the present one
  WallDescription walls_;    ///< of rank 0, until they are compared
  std::vector<std::int32_t> cells_of_rank_;
  bool agreed_ = false;
  unsigned offered_ = 0; ///< quantities that the fluid's terms offered
  bool extents_ = false, overlap_ = false;
  wire::ParticlePoints particlePoints_;
  std::vector<std::byte> rows_;  ///< of the ranks that do not talk
  double transport_seconds_ = 0; ///< of the last coupling step; of rank 0
};

} // namespace eccentra::link
