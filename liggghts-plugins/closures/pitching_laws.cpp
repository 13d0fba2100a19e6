// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas of the pitching torque.
#include "closures/pitching_laws.h"

#include "closures/rheology.h"

#include <cmath>

namespace eccentra::closures {

namespace {

/// Within this of the sphere the closed forms are differences of large terms: beyond, they keep six digits.
constexpr double kNearlyRound = 0.05;

/// F of a_max^3 rho U^2, prolate; its sign is left out.
double dabade_prolate(double ratio) {
  const double e = std::sqrt(1.0 - 1.0 / (ratio * ratio)), t = std::atanh(e);
  const double e2 = e * e, e3 = e2 * e, e4 = e2 * e2, e5 = e4 * e, e6 = e4 * e2, e7 = e6 * e;
  const double top = -(420.0 * e + 2240.0 * e3 + 4249.0 * e5 - 2152.0 * e7) +
                     (420.0 + 3360.0 * e2 + 1890.0 * e4 - 1470.0 * e6) * t -
                     (1260.0 * e - 1995.0 * e3 + 2730.0 * e5 - 1995.0 * e7) * t * t;
  const double side = (e2 + 1.0) * t - e;
  return std::abs(kPi * e2 * top / (315.0 * side * side * ((1.0 - 3.0 * e2) * t - e)));
}

double dabade_oblate(double ratio) {
  const double e = std::sqrt(1.0 - ratio * ratio), q = ratio, t = std::asin(e);
  const double e2 = e * e, e4 = e2 * e2, e6 = e4 * e2, e8 = e4 * e4;
  const double top = e * (-420.0 + 3500.0 * e2 - 9989.0 * e4 + 4757.0 * e6) +
                     210.0 * (2.0 - 24.0 * e2 + 69.0 * e4 - 67.0 * e6 + 20.0 * e8) * t / q +
                     105.0 * e * (12.0 - 17.0 * e2 + 24.0 * e4) * t * t;
  const double side = e * q + (2.0 * e2 - 1.0) * t;
  return std::abs(kPi * e2 * top / (315.0 * (-e * q + (1.0 + 2.0 * e2) * t) * side * side));
}

/// C' as Re -> 0.
double limit_of(double ratio) {
  if (ratio > 1.0 + kNearlyRound)
    return 2.0 * dabade_prolate(ratio) * ratio * ratio / kPi;
  if (ratio < 1.0 - kNearlyRound)
    return 2.0 * dabade_oblate(ratio) / (kPi * ratio);
  const double edge = ratio > 1.0 ? 1.0 + 1.0001 * kNearlyRound : 1.0 - 1.0001 * kNearlyRound;
  return std::abs(ratio - 1.0) / kNearlyRound * limit_of(edge);
}

} // namespace

PitchingLaw::PitchingLaw(double ratio) {
  if (ratio == 1.0)
    return;
  limit_ = limit_of(ratio);
  if (ratio > 1.0) {
    const double l = std::log(ratio);
    first_ = 2.0 * 0.931 * std::pow(l, 0.675);
    first_power_ = -0.162;
    second_ = 2.0 * 0.657 * std::pow(l, 2.77);
    second_power_ = -(0.178 + 0.177 * l);
  } else {
    first_ = 1.85 * std::pow((1.0 - ratio) / ratio, 0.832);
    first_power_ = -0.146;
  }
}

} // namespace eccentra::closures
