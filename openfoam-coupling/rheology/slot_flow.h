// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reynolds number of Metzner and Reed for an annulus taken as a slot. Pure functions
// without OpenFOAM headers.
#pragma once

#include "rheology/herschel_bulkley.h"

#include <cmath>

namespace eccentra::rheology {

/// Mean velocity of the laminar flow of tau = tau0 + k g^n between two plates, given the stress at the plates in excess
/// of tau0 and their distance. mu_y is not used: it belongs to the computation, not to the fluid.
inline double slot_velocity(const HerschelBulkley& fluid, double gap, double excess) {
  const double sheared = excess / (fluid.tau0 + excess); // part of the gap that is not a plug
  const double n = fluid.n;
  return 0.5 * gap * n / (n + 1) * std::pow(excess / fluid.k, 1 / n) * sheared * (1 - n / (2 * n + 1) * sheared);
}

/// The stress at the plates for this mean velocity >= 0; tau0 without flow.
inline double slot_wall_stress(const HerschelBulkley& fluid, double gap, double velocity) {
  if (!(velocity > 0)) {
    return fluid.tau0;
  }
  // That of the power-law fluid falls short by less than 3 tau0; the excess alone lies between a part of it and twice.
  const double power_law = fluid.k * std::pow((2 * fluid.n + 1) / fluid.n * 2 * velocity / gap, fluid.n);
  double low = 0, high = power_law;
  while (slot_velocity(fluid, gap, high) < velocity) {
    low = high;
    high *= 2;
  }
  constexpr int kBisections = 60;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (slot_velocity(fluid, gap, middle) < velocity ? low : high) = middle;
  }
  return fluid.tau0 + 0.5 * (low + high);
}

/// Re = 12 rho U^2/tau_w in a slot of half the hydraulic diameter, such that the laminar friction factor is 24/Re for
/// every fluid (Metzner and Reed 1955, generalised to a yield stress); rho U D_h/mu for a Newtonian one. Kinematic law
/// (over the density).
inline double metzner_reed(const HerschelBulkley& kinematic, double hydraulic_diameter, double velocity) {
  return velocity > 0 ? 12 * velocity * velocity / slot_wall_stress(kinematic, 0.5 * hydraulic_diameter, velocity) : 0;
}

/// Below it the flow is laminar (Dodge and Metzner 1959): 2100 for a Newtonian fluid.
inline double laminar_limit(double flow_index) {
  return 3470 - 1370 * flow_index;
}

} // namespace eccentra::rheology
