// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One time step of a particle against a resistance that grows with its slip: backward Euler, so slip never reverses.
#pragma once

#include "closures/rheology.h"

#include <cmath>
#include <limits>

namespace eccentra::closures {

/// A resistance R(U) = area * X(U/length) * G(Re), Re = inertia * U^2 / X: drag (U a slip speed) with area (pi/8) d^2,
/// or rotational drag (U a relative spin). `Stress` is X, `Law` is the reduced coefficient G = C_D Re with slope
/// dG/dRe. The form has no 0/0: at rest R = area * X(0) * G(0), the yield resistance. A law with kAffine has G =
/// viscous() + plateau() Re and needs no Re.
template <class Stress, class Law> struct Resistance {
  Stress stress;         ///< X
  Law law;               ///< G
  double area;           ///< [m2] for a force, [m3] for a torque
  double inverse_length; ///< [1/m] for a force, 1 for a torque
  double inertia;        ///< [kg/m3] for a force, [kg/m] for a torque

  /// R(0): what the yield stress holds; 0 without one.
  double at_rest() const {
    const double yield = stress.at_rest();
    return yield > 0.0 ? area * yield * law(0.0).value : 0.0;
  }
  /// speed > 0.
  ValueAndSlope operator()(double speed) const {
    const ValueAndSlope x = stress(speed, inverse_length);
    const double inertial = inertia * speed * speed;
    const double inertial_slope = 2.0 * inertia * speed;
    if constexpr (Law::kAffine) {
      return {area * (law.viscous() * x.value + law.plateau() * inertial),
              area * (law.viscous() * x.slope + law.plateau() * inertial_slope)};
    } else {
      // X G(I/X) is homogeneous in X and I.
      const double re = inertial / x.value;
      const ValueAndSlope g = law(re);
      return {area * x.value * g.value, area * ((g.value - re * g.slope) * x.slope + g.slope * inertial_slope)};
    }
  }
};

/// Relative change below which Newton's iteration ends. The error left in speed and resistance is of the order of its
/// square, far below that of the time step; what is exchanged is exact for any tolerance.
constexpr double kNewtonTolerance = 1e-3;
constexpr int kNewtonLimit = 100;
/// If a Newton step leaves its bracket and there is no lower bound, the next trial is this part of the upper bound.
constexpr double kBracketShrink = 0.1;

/// Slip speed after a step and the resistance that acted during it.
struct ImplicitSlip {
  double speed;      ///< at the end of the step [m/s, or rad/s]
  double resistance; ///< [N, or N m]
};

/// Solves speed + compliance * R(speed) = free_slip for speed >= 0. Exactly 0 where the yield resistance holds the
/// particle (compliance * R(0) >= free_slip): the return mapping of a yield stress.
/// free_slip > 0: speed without the resistance; compliance: dt/m, 0 for a body that nothing can move; guess: any value,
/// best the previous speed. Always inlined, because a call costs much in the short loops around it.
template <class R>
[[gnu::always_inline]] inline ImplicitSlip implicit_slip(const R& resistance, double free_slip, double compliance,
                                                         double guess) {
  if (compliance == 0.0)
    return {free_slip, resistance(free_slip).value};
  if (compliance * resistance.at_rest() >= free_slip)
    return {0.0, free_slip / compliance};
  double low = 0.0;
  double high = free_slip;
  double q = guess > 0.0 && guess < free_slip ? guess : free_slip;
  for (int i = 0; i < kNewtonLimit; ++i) {
    const ValueAndSlope r = resistance(q);
    const double excess = q + compliance * r.value - free_slip;
    (excess > 0.0 ? high : low) = q;
    const double change = -excess / (1.0 + compliance * r.slope);
    if (std::abs(change) <= kNewtonTolerance * q)
      return {q + change, r.value + r.slope * change};
    q += change;
    if (!(q > low && q < high))
      // A stiff resistance is a power of the speed, so the mean is geometric.
      q = low > 0.0 ? std::sqrt(low * high) : kBracketShrink * high;
    if (q < std::numeric_limits<double>::min())
      break;
  }
  return {0.0, free_slip / compliance};
}

} // namespace eccentra::closures
