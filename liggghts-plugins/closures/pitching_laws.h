// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Torque that the inertia of the flow exerts on a spheroid that moves at an angle to its axis.
#pragma once

#include <algorithm>
#include <cmath>

namespace eccentra::closures {

/// C' of a spheroid: torque (1/2) rho U^2 (pi/8) d^3 C' sin f cos f with f the angle between axis of symmetry and slip;
/// it turns a rod crosswise and a disk broadside. C' = min(limit, fit): the two meet at Re = 0.3 to 1.3, so that the
/// torque is continuous, and Re C' -> 0 as Re -> 0 (a body with three planes of symmetry feels none in creeping flow).
class PitchingLaw {
 public:
  /// `ratio` of axis of symmetry to equator, > 0; 1 gives no torque.
  explicit PitchingLaw(double ratio = 1.0);

  /// re > 0.
  double operator()(double re) const { return std::min(limit_, fit(re)); }
  /// Limit of Re -> 0, exact: Dabade, Marath & Subramanian (2015), J. Fluid Mech. 778, 133, eq (4.1) and (4.2). For
  /// |ratio - 1| < 0.05, where the formulas lose their digits, linear in ratio - 1.
  double limit() const { return limit_; }
  /// Fit to simulations. Prolate: Froehlich, Meinke & Schroeder (2020), J. Fluid Mech. 901, A5, ratio <= 8, Re <= 100.
  /// Oblate: Ouchene (2020), Phys. Fluids 32, 073303, ratio >= 0.2, Re <= 100. Beyond these it is continued.
  double fit(double re) const { return first_ * std::pow(re, first_power_) + second_ * std::pow(re, second_power_); }

 private:
  double limit_ = 0.0, first_ = 0.0, first_power_ = 0.0, second_ = 0.0, second_power_ = 0.0;
};

constexpr double kPitchingHighestRe = 100.0;

} // namespace eccentra::closures
