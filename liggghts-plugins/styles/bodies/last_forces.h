// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of the last step of a run, with which the next run or a restarted one goes on.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

class FixClusterBodies;

/// The set-up of a run computes forces anew from whole-step velocities, and it cannot know which contacts slid. Where
/// contacts are damped that is not what the last step had, so that a run in pieces would differ from one in one piece.
/// This class keeps force and torque of each atom, together with the state that they belong to. They are used again if
/// no command has changed any atom, the time step, or the fixes that act on forces.
class LastForces {
 public:
  static constexpr int kept_values = 6; ///< force and torque, as restart files keep them
  static constexpr int columns = kept_values + 13;

  /// True while forces wait for the first step of the next run.
  bool pending() const { return pending_; }
  /// Expects kept forces of a restart file; each atom's come with set().
  void expect(int atoms);
  /// Keeps present forces and state of all local atoms: a run has ended.
  void keep(LAMMPS_NS::LAMMPS& lmp, const FixClusterBodies& bodies);
  /// Gives local atom i these forces and torques, which belong to its present state.
  void set(LAMMPS_NS::LAMMPS& lmp, const FixClusterBodies& bodies, int i, const double* values);
  /// The set-up of a run: looks whether the fixes are those of the run before.
  void compare_fixes(LAMMPS_NS::LAMMPS& lmp);
  /// The first step of a run: puts the kept forces back if nothing has changed. Collective.
  void put_back(LAMMPS_NS::LAMMPS& lmp, const FixClusterBodies& bodies);

  // Rows follow their atoms; all of these do nothing unless forces are pending.
  void grow(int atoms);
  void copy(int from, int to);
  void forget(int i);
  int pack(int i, double* buffer) const;
  int unpack(int i, const double* buffer);
  const double* row(int i) const { return rows_[i].data(); }

 private:
  using Row = std::array<double, columns>;
  static Row state_of(LAMMPS_NS::LAMMPS& lmp, const FixClusterBodies& bodies, int i);

  bool pending_ = false;
  bool same_process_ = false; ///< kept by a run of this process, not read from a restart file
  bool fixes_changed_ = false;
  double step_ = 0;  ///< of time [s]
  double atoms_ = 0; ///< of all ranks
  std::vector<std::string> fixes_;
  std::vector<Row> rows_; ///< values are NaN where an atom has none
};

} // namespace eccentra::styles
