// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The damper of a sphere that rocks as a shape (docs/rolling_friction_eccentric.md). Pure formulas.
#pragma once

#include <algorithm>

namespace eccentra::contact {

/// Part of the spin that the damper of one contact takes in a step at most, where it is stronger than that of the
/// contact. An explicit step is stable while all contacts of a sphere together take less than 2: five at this limit.
constexpr double kMostSpinInAStep = 0.4;

/// Damper [N s/m] of the sub-spheres of a contact: `factor` (at least 0) times that of its normal force [N s/m], as far
/// as the step dt [s] bears it; never less than that of the contact for a factor above 1. `mass` [kg]: of the sphere,
/// a solid one; `arm`: longest distance of a sub-sphere from its centre, in units of its radius.
inline double rocking_damper(double normal_damping, double factor, double mass, double arm, double dt) {
  if (factor <= 1)
    return factor * normal_damping;
  const double inertia = 0.4 * mass; // over the radius squared
  return std::min(factor * normal_damping, std::max(normal_damping, kMostSpinInAStep * inertia / (arm * arm * dt)));
}

} // namespace eccentra::contact
