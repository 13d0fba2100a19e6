// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The fluid in another job, as the DEM side sees it.
#pragma once

#include "link/fluid_peer.h"
#include "link/socket/address.h"
#include "link/socket/channel.h"
#include "link/socket/rank_connections.h"

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace eccentra::link {

/// Rank 0 talks; the rows of the others travel on rank connections of their own. Where there are none, they are
/// gathered on rank 0 and their samples scattered: its time and memory then grow with all particles.
class SocketPeer : public FluidPeer {
 public:
  enum class Rows { on_rank_connections, over_root }; ///< wanted; on_rank_connections where that is possible

  /// Collective over `ranks`; returns before the fluid side has come. Throws Refusal on every rank if the address
  /// cannot be used.
  SocketPeer(MPI_Comm ranks, const Address& address, const Timeout& patience, Rows rows = Rows::on_rank_connections);
  /// Tells the fluid side that all went well, unless it did not.
  ~SocketPeer() override;

  FluidTerms agree(const DemTerms& dem) override;
  std::string compare_walls(const WallDescription& walls) override;
  StepAnswer couple(const CouplingStep& coupling_step, const ParticleArrays& particles,
                    const link::FluidSamples& samples) override;
  void advance() override;
  std::string checkpoint(const CheckpointMark& mark) override;
  void run_ended() override;
  /// Tells the fluid side in one sentence why this side ends here. Not collective.
  void leave(const std::string& why) noexcept;

  /// After agree(): why all rows travel over rank 0; empty where they do not, or there is no other rank.
  const std::string& why_over_root() const { return why_over_root_; }
  /// That this rank has sent to the fluid side and received from it.
  std::uint64_t bytes();

 private:
  template <class Work> auto or_leave(Work&& work) -> decltype(work());
  template <class Work> wire::Bytes on_root_or_leave(Work&& work);
  /// Once, when terms have been agreed for the first time.
  void open_rank_connections(std::uint32_t count);

  MPI_Comm ranks_;
  Address address_;
  Timeout timeout_;
  std::unique_ptr<Channel> channel_; ///< of rank 0
  RankConnections rank_connections_;
  bool by_rank_connections_ = false;
  bool settled_ = false;                     ///< whether there are rank connections
  std::uint32_t rank_connections_asked_ = 0; ///< in all terms of this connection
  bool left_ = false;
  std::string why_over_root_;
  bool extents_ = false;
  std::int64_t coupling_steps_ = 0;
  std::vector<std::byte> rows_;  ///< of the ranks that do not talk
  double transport_seconds_ = 0; ///< of the last coupling step, without the fluid's own time
};

} // namespace eccentra::link
