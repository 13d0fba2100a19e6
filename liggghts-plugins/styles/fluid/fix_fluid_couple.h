// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fix style fluid/couple: every N steps particles and flow are exchanged, inside one LIGGGHTS run.
#pragma once

#include "link/fluid_peer.h"
#include "link/load_sums.h"
#include "link/socket/socket_peer.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/dem_checkpoint.h"
#include "styles/entry/error_reports.h"
#include "styles/fluid/fix_fluid_force.h"

#include <mpi.h>

#include "fix.h"

#include <memory>
#include <string>
#include <vector>

namespace eccentra::styles {

/// Own particles of one coupling step.
struct PackedParticles {
  std::vector<int> tags;
  std::vector<double> position; ///< rows of three, inside a periodic box
};

/// Hands positions, volumes and the impulses that fix fluid/force has gathered to the fluid, and puts what the flow is
/// at each particle into fix fluid/force. Knows the fluid only as a link::FluidPeer.
class FixFluidCouple : public LAMMPS_NS::Fix {
 public:
  FixFluidCouple(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixFluidCouple() override;

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup(int vflag) override;
  void pre_initial_integrate() override;
  void end_of_step() override;
  void post_run() override;

  void grow_arrays(int rows) override;
  void copy_arrays(int from, int to, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int row, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int row, int nth) override;
  int size_restart(int row) override;
  int maxsize_restart() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  double memory_usage() override;

 private:
  enum class Checkpoints { by_clock, counted, off }; ///< off: only when a signal asks to stop
  [[noreturn]] void refuse(const std::string& text);
  void connect();
  void announce_rank_connections() const;
  void read(const std::vector<std::string>& arguments);
  link::DemTerms terms() const;
  void couple(double elapsed);
  /// Compares the script's walls with the mesh, unless they are those of the last comparison.
  void compare_walls(bool running);
  /// Prints sentences of the fluid side, with the ids of the particles of which they give the place.
  void announce(const std::string& news) const;
  /// Puts the ids into "particle at (x y z)". Collective.
  std::string with_ids(std::string text) const;
  /// Which particles have left the box since the last coupling step, unless that has been said before; empty if none
  /// has. Collective.
  std::string departures(const link::DemTotals& now);
  /// Which particles have come or gone. Collective.
  std::string changes() const;
  /// Sees to it that the atoms are sorted and listed anew in the step of the next exchange, if a checkpoint may be
  /// written there: the run that reads it begins with just that.
  void plan_checkpoint();
  void sort_with_neighbours();
  /// Before the two sides agree.
  void begin_checkpoints();
  void write_checkpoint();
  void look_for_signals();
  [[noreturn]] void stop_for_signal();
  /// After the link has failed: what this side alone can keep.
  void keep_particles();
  void pack();
  void pack_extent(int i, double* extent);
  /// `computed`: seconds of this rank since the last coupling step, without waiting.
  void add_totals(double computed, const link::Communication& between, link::CouplingStep& coupling_step) const;
  void begin_interval();
  void leave_fluid();

  std::string link_;
  std::string address_; ///< of link socket
  std::string keys_;    ///< folder
  link::Timeout timeout_;
  int interval_ = 0;
  int countdown_ = 0;
  bool overlap_ = false;
  bool rank_connections_ = true; ///< ranks send their particles themselves where that is possible
  bool ahead_ = false;           ///< with overlap: the fluid takes the step of the present interval
  bool agreed_ = false;
  bool began_ = false;
  Checkpoints checkpoints_ = Checkpoints::by_clock;
  CheckpointClock clock_;
  int checkpoint_every_ = 0;        ///< coupling steps, if counted
  bool due_ = false;                ///< a checkpoint, at the end of this interval
  std::int64_t coupling_steps_ = 0; ///< since the beginning, also of earlier runs
  int stop_ = 0;                    ///< signal that asks one of the sides to stop
  link::CheckpointMark mark_;       ///< while a checkpoint is written, or until the run that goes on from it has begun
  std::uint64_t layout_ = 0;        ///< for which the cell hint hold
  bool resuming_ = false;           ///< until the first step
  link::FluidPeer* peer_ = nullptr;
  std::unique_ptr<link::SocketPeer> own_peer_; ///< null with link solver
  FixFluidForce* forces_ = nullptr;
  FixClusterBodies* bodies_ = nullptr; ///< null where all particles are spheres

  std::vector<link::CellHint> cell_hints_;    ///< per atom; migrates
  PackedParticles packed_, before_, earlier_; ///< of the last three coupling steps; `earlier_` with overlap only
  std::vector<double> volume_;
  std::vector<double> extent_; ///< packed rows of link::kExtentDoubles; empty where all particles are spheres
  std::int64_t staying_ = -1;  ///< particles less those inserted, at the last coupling step
  bool told_of_departure_ = false;
  link::wire::Bytes compared_walls_;
  bool walls_move_ = false; ///< and their velocities are still to be compared
  std::unique_ptr<LastWords> last_words_;
  double left_fluid_at_ = 0;           ///< wall-clock time when the last coupling step ended [s]
  link::Communication counted_before_; ///< link::communication() at that time
  link::LoadSums load_;                ///< of the present run
  double pack_seconds_ = 0;
};

} // namespace eccentra::styles
