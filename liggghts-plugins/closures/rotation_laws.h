// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Torque of the fluid on a particle that spins relative to it: eq (24) and (25).
#pragma once

#include "closures/rheology.h"

#include <algorithm>
#include <cmath>

namespace eccentra::closures {

/// Dennis, Singh & Ingham (1980), eq (25): C_DR = 64 pi/Re_r below 32 (exact for Re_r -> 0: Kirchhoff, T = pi mu d^3
/// Om), 12.9/sqrt(Re_r) + 128.4/Re_r to 1000 (a jump of 0.155 %); above, C_DR stays at its value at 1000. Torque:
/// (rho/2)(d/2)^5 C_DR |Om| Om. As a Resistance: reduced coefficient C_DR Re_r, area d^3/64, inertia rho d^2.
struct Dennis {
  static constexpr double kSwitchRe = 32.0, kHighestRe = 1000.0;
  static constexpr double kStokes = 64.0 * kPi, kRoot = 12.9, kLinear = 128.4;
  static constexpr bool kAffine = false;
  static constexpr double kAreaPart = 1.0 / 64.0;

  ValueAndSlope operator()(double re) const {
    if (re < kSwitchRe)
      return {kStokes, 0.0};
    const double root = kRoot * std::sqrt(std::min(re, kHighestRe));
    if (re <= kHighestRe)
      return {root + kLinear, 0.5 * root / re};
    const double coefficient = (root + kLinear) / kHighestRe;
    return {coefficient * re, coefficient};
  }
  static double coefficient(double re) { return Dennis()(re).value / re; }
};

/// mu(rate) |Om| with the shear rate that slip and spin make together: what yields the fluid for one yields it for
/// both.
template <class Stress> struct SpinStress {
  Stress stress;
  double slip_rate; ///< U/d [1/s]

  double at_rest() const { return slip_rate > 0.0 ? 0.0 : stress.at_rest(); }
  ValueAndSlope operator()(double spin, double) const {
    const double rate = std::sqrt(slip_rate * slip_rate + spin * spin);
    const ValueAndSlope x = stress(rate, 1.0);
    const double viscosity = x.value / rate;
    return {viscosity * spin, viscosity + spin * spin * (x.slope - viscosity) / (rate * rate)};
  }
};
/// The same without a power: the viscosity does not depend on the slip.
template <> struct SpinStress<NewtonianStress> {
  NewtonianStress stress;
  double slip_rate;

  double at_rest() const { return 0.0; }
  ValueAndSlope operator()(double spin, double) const { return stress(spin, 1.0); }
};

} // namespace eccentra::closures
