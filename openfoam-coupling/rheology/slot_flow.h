// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reynolds number of Metzner and Reed for an annulus taken as one slot, or as slots of its local gaps side by side.
// Pure functions without OpenFOAM headers.
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

/// Above it the flow is turbulent throughout (Dodge and Metzner 1959): 2900 for a Newtonian fluid.
inline double turbulent_limit(double flow_index) {
  return 4270 - 1370 * flow_index;
}

/// Two cylinders with parallel axes, the pipe inside the hole [m].
struct AnnulusGap {
  double pipe_radius;
  double hole_radius;
  double offset; ///< of the axes, 0 <= offset < hole_radius - pipe_radius

  /// Width at this angle from the widest place [m].
  double at(double angle) const { return hole_radius - pipe_radius + offset * std::cos(angle); }
  double widest() const { return at(0); }
};

/// Mean velocity of slots of the local gaps side by side, none of which turns, under one gradient over the density
/// [m/s2].
inline double slots_velocity(const HerschelBulkley& kinematic, const AnnulusGap& annulus, double gradient) {
  constexpr int kSlots = 90;
  const double half_turn = std::acos(-1.0);
  double flow = 0, width = 0;
  for (int i = 0; i < kSlots; ++i) {
    const double gap = annulus.at(half_turn * (i + 0.5) / kSlots);
    const double excess = 0.5 * gradient * gap - kinematic.tau0;
    flow += excess > 0 ? gap * slot_velocity(kinematic, gap, excess) : 0;
    width += gap;
  }
  return flow / width;
}

/// The gradient over the density that drives this mean velocity > 0 through them [m/s2].
inline double slots_gradient(const HerschelBulkley& kinematic, const AnnulusGap& annulus, double velocity) {
  double low = 0, high = 2 * slot_wall_stress(kinematic, annulus.widest(), velocity) / annulus.widest();
  while (slots_velocity(kinematic, annulus, high) < velocity) {
    low = high;
    high *= 2;
  }
  constexpr int kBisections = 60;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (slots_velocity(kinematic, annulus, middle) < velocity ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Mean velocity in the widest of the slots while that of all of them is `velocity`: an estimate without a bed.
inline double wide_gap_velocity(const HerschelBulkley& kinematic, const AnnulusGap& annulus, double velocity) {
  if (!(velocity > 0)) {
    return 0;
  }
  const double wall = 0.5 * slots_gradient(kinematic, annulus, velocity) * annulus.widest();
  return slot_velocity(kinematic, annulus.widest(), wall - kinematic.tau0);
}

} // namespace eccentra::rheology
