// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reynolds number of a particle in a Herschel-Bulkley fluid. Pure functions without OpenFOAM headers.
#pragma once

#include "rheology/herschel_bulkley.h"

#include <cmath>

namespace eccentra::rheology {

/// Re = U^2/(k (U/d)^n + (7 pi/24) tau0) with the law over the density (eq 23; Ansley and Smith 1967); U d/nu for a
/// Newtonian fluid. U: slip speed [m/s], d: diameter of the sphere of equal volume [m]. 0 at rest.
inline double particle_reynolds(const HerschelBulkley& kinematic, double slip, double diameter) {
  const double yield_weight = 7 * std::acos(-1.0) / 24;
  return slip > 0 ? slip * slip / (kinematic.k * std::pow(slip / diameter, kinematic.n) + yield_weight * kinematic.tau0)
                  : 0;
}

} // namespace eccentra::rheology
