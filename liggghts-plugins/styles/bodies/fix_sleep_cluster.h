// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix sleep/cluster: bodies at rest are held where they are until the forces on them are out of balance.
#pragma once

#include <mpi.h>

#include "fix.h"

#include <string>
#include <vector>

namespace eccentra::styles {

class FixClusterBodies;

/// What a user types after the style.
struct SleepArguments {
  double tolerance = 0.01; ///< force out of balance that wakes a body, in units of its weight
  double speed = 1e-3;     ///< below which a body counts as at rest, in units of sqrt(g d)
  int window = 500;        ///< steps for which it must
  int every = 10;          ///< steps between two looks at bodies that are awake
  int recheck = 100000;    ///< steps after which all bodies are woken; 0: never
};

/// Throws std::invalid_argument with one sentence.
SleepArguments read_sleep_arguments(const std::vector<std::string>& arguments);

/// Fix style "sleep/cluster". A body that sleeps has velocity and spin 0; nve/cluster leaves it alone, and pairs of
/// such bodies are not evaluated (RestingPairs). All forces on it are there in every step, so what is out of balance is
/// known. Scalar: bodies asleep now. Vector: (1) bodies asleep now, (2) share of all bodies and steps since the run
/// began that were asleep, (3) wake-ups since then, (4) largest force out of balance on a sleeper over its weight, (5)
/// sum of these forces over the sum of the sleepers' weights. Per atom: 1 if asleep.
class FixSleepCluster : public LAMMPS_NS::Fix {
 public:
  FixSleepCluster(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixSleepCluster() override;

  /// The scene's instance, or null.
  static FixSleepCluster* find(LAMMPS_NS::LAMMPS* lmp);

  /// Whether local atom i sleeps.
  bool asleep(int i) const { return state_[i][0] != 0; }

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void post_run() override;
  double compute_scalar() override;
  double compute_vector(int n) override;

  void grow_arrays(int nmax) override;
  void copy_arrays(int i, int j, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buf) override;
  int unpack_exchange(int i, double* buf) override;
  int pack_restart(int i, double* buf) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  double memory_usage() override;

 private:
  static constexpr int columns = 2; ///< asleep; looks in a row that found the body at rest

  [[noreturn]] void fail(const std::string& sentence) const;
  double gravity() const;
  /// Whether force and torque on local atom i are within `part` of its weight (times its radius).
  bool balanced(int i, double part, double gravity) const;
  bool moves(int i) const;
  void fall_asleep(int i);
  void wake(int i);

  SleepArguments arguments_;
  FixClusterBodies* bodies_ = nullptr;
  double** state_ = nullptr;            ///< [nmax][columns]
  double steps_asleep_ = 0, steps_ = 0; ///< of all local bodies since the run began
  double wake_ups_ = 0;
};

} // namespace eccentra::styles
