// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fix style "rolling/limited": after all pair and wall forces, turns the contacts that the rolling model `shape`
// reported into torques that stop the relative spins as far as their caps allow. Made by the model; users never type
// it.
#pragma once

#include "contact/rolling_limiter.h"

#include <mpi.h>

#include "fix.h"

#include <vector>

namespace eccentra::styles {

class FixRollingLimited : public LAMMPS_NS::Fix {
 public:
  FixRollingLimited(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  /// The scene's instance, or null if no pair model made one.
  static FixRollingLimited* find(LAMMPS_NS::LAMMPS* lmp);
  /// The scene's instance, made, or made anew, where it is not the last of all fixes: it needs the assembled torque of
  /// the others. What find() has given before is void then.
  static FixRollingLimited* make_last(LAMMPS_NS::LAMMPS* lmp);

  contact::RollingLimiter& limiter() { return limiter_; }

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup_pre_force(int vflag) override;
  void setup(int vflag) override;
  void pre_force(int vflag) override;
  void post_force(int vflag) override;
  int pack_comm(int n, int* list, double* buffer, int pbc_flag, int* pbc) override;
  void unpack_comm(int n, int first, double* buffer) override;
  double memory_usage() override;

 private:
  bool rotates(int mask) const { return (mask & rotating_groups_) && !(mask & frozen_group_); }

  contact::RollingLimiter limiter_;
  std::vector<contact::TrialSpin> trial_;
  int rotating_groups_ = 0; ///< groups of the fixes that integrate; a particle of no such group has a fixed spin
  int frozen_group_ = 0;
};

} // namespace eccentra::styles
