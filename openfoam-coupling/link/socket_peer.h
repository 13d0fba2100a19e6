// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The fluid in another job, as the DEM side sees it.
#pragma once

#include "link/address.h"
#include "link/channel.h"
#include "link/fluid_peer.h"

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace eccentra::link {

/// Rank 0 talks; the particles of the others are gathered there and their samples scattered: time and memory of rank 0
/// grow with all particles.
class SocketPeer : public FluidPeer {
 public:
  /// Collective over `ranks`; returns before the fluid side has come. Throws Refusal on every rank if the address
  /// cannot be used.
  SocketPeer(MPI_Comm ranks, const Address& address, const Patience& patience);
  /// Tells the fluid side that all went well, unless it did not.
  ~SocketPeer() override;

  FluidTerms agree(const DemTerms& dem) override;
  int meet(const Meeting& meeting, const ParticleArrays& particles, const fluid::FluidSamples& samples) override;
  void advance() override;
  std::string checkpoint(const CheckpointMark& mark) override;
  void run_ended() override;
  /// Tells the fluid side in one sentence why this side ends here. Not collective.
  void leave(const std::string& why) noexcept;

 private:
  template <class Work> wire::Bytes on_root_or_leave(Work&& work);

  MPI_Comm ranks_;
  std::unique_ptr<Channel> channel_; ///< of rank 0
  bool extents_ = false;
  std::vector<std::byte> rows_;  ///< of the ranks that do not talk
  double transport_seconds_ = 0; ///< of the last meeting, without the fluid's own time
};

} // namespace eccentra::link
