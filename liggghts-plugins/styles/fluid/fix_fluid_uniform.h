// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fix style fluid/uniform: a prescribed flow for fix fluid/force, without any solver.
#pragma once

#include <mpi.h>

#include "fix.h"

#include <string>
#include <vector>

namespace eccentra::styles {

class FixFluidForce;

/// u_f(x) = velocity + velocity_gradient (x - origin), vorticity its curl, and each other quantity of the flow under
/// its own name; each value is a number, an equal-style variable (of time) or an atom-style variable (of place).
class FixFluidUniform : public LAMMPS_NS::Fix {
 public:
  FixFluidUniform(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  int setmask() override;
  void init() override;
  void setup_pre_force(int vflag) override;
  void pre_force(int vflag) override;

 private:
  /// A number or a variable, for all atoms or for each.
  struct Value {
    double number = 0.0;
    std::string variable; ///< name without v_; empty for a number
    bool per_atom = false;
    int index = -1;
    std::vector<double> of_atom;
    double at(int i) const { return per_atom ? of_atom[i] : number; }
  };

  void read(const std::vector<std::string>& arguments);
  void evaluate();
  void fill();

  std::vector<Value> values_;
  FixFluidForce* forces_ = nullptr;
  bool variables_ = false;
};

} // namespace eccentra::styles
