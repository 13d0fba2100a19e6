// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fix style "rolling/orientation": gives spheres an orientation, turns it with their spin, and holds the shape that
// rolling_friction eccentric sees in it. Made by the model; users never type it.
#pragma once

#include "contact/support_table.h"

#include <mpi.h>

#include <Eigen/Geometry>

#include "fix.h"
#include "fix_property_atom.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace eccentra::styles {

/// Orientations are the per-atom property `eccentricOrientation` (w x y z, body to world): it migrates, restarts and
/// can be dumped as f_eccentricOrientation[1..4]. A sphere that has none yet gets one at random,
/// which depends on its tag and the seed alone.
class FixSphereOrientation : public LAMMPS_NS::Fix {
 public:
  FixSphereOrientation(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  static FixSphereOrientation* find(LAMMPS_NS::LAMMPS* lmp);
  /// The scene's instance, made if need be, with this shape (arguments as particletemplate/cluster takes them) and
  /// seed.
  static FixSphereOrientation* make(LAMMPS_NS::LAMMPS* lmp, const std::vector<std::string>& shape_keywords, long seed);

  /// Orientation (w x y z, body to world) of an atom of this rank, valid from pre_force on.
  const double* orientation(int i) const { return property_->array_atom[i]; }
  const contact::SupportTable& shape() const { return *shape_; }
  /// Damper [N s/m] of rocking at a contact (contact/rocking_damper.h) of a sphere of this mass [kg]: `factor` times
  /// that of the normal force [N s/m], as far as the step bears it. The end of the run says where it bore less.
  double damper(double normal_damping, double factor, double mass);

  int setmask() override;
  /// Stops with a sentence where no model has made this fix.
  void init() override;
  void setup_pre_force(int vflag) override;
  void post_integrate() override;
  void pre_force(int vflag) override;
  void post_run() override;

 private:
  void orient_new_spheres();

  std::vector<std::string> shape_keywords_;
  std::unique_ptr<contact::SupportTable> shape_;
  LAMMPS_NS::FixPropertyAtom* property_ = nullptr;
  long seed_ = 0;
  double least_factor_ = std::numeric_limits<double>::infinity(); ///< that a bounded damper had on this rank
  double said_factor_ = least_factor_;
};

} // namespace eccentra::styles
