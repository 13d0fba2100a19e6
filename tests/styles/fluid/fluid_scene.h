// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Particles of the reference case (d 6.35 mm, 2619 kg/m3) in a periodic box with a prescribed flow, for tests.
#pragma once

#include "styles/fluid/fix_fluid_force.h"
#include "support/granular_script.h"
#include "support/liggghts_session.h"

#include <string>

namespace eccentra::test {

constexpr double kDiameter = 6.35e-3;
constexpr double kSolidDensity = 2619.0;
constexpr double kGravity = 9.81;
constexpr double kFluidDensity = 1000.0;

/// Box, materials, contacts; no atoms yet.
inline std::string scene_head(const std::string& boundary = "p p p") {
  return granular_box("0 0.1 0 0.1 0 0.4", boundary) + granular_material({}, "0.002") + sphere_contacts();
}

/// One sphere in the middle.
inline std::string one_sphere(double density = kSolidDensity) {
  return "create_atoms 1 single 0.05 0.05 0.2 units box\nset group all diameter " + std::to_string(kDiameter) +
         " density " + std::to_string(density) + "\n";
}

inline std::string gravity() {
  return "fix gravity all gravity " + std::to_string(kGravity) + " vector 0 0 -1\n";
}

/// The only atom's velocity component, the same on every rank.
inline double velocity_of(LiggghtsSession& session, int tag, int k) {
  const int i = session.local(tag);
  double mine = i >= 0 ? session.atom().v[i][k] : 0.0;
  double all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

} // namespace eccentra::test
