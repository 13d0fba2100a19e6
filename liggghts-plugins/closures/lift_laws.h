// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lift of a particle by shear (Saffman, Mei) and by its own rotation (Oesterle & Bui Dinh): eq (26)-(30).
#pragma once

#include "base/vectors.h"
#include "closures/rheology.h"

#include <algorithm>
#include <cmath>

namespace eccentra::closures {

/// Saffman (1965): C_LS = 4.1126 Re_s^-0.5 as Re -> 0, force 1.615 d^2 sqrt(rho mu/|w|) (u x w).
constexpr double kSaffman = 4.1126;

/// Mei (1992), eq (28): the lift relative to Saffman's; range 0.005 < beta < 0.4 (clamped to it), Re_p <= 100.
/// Jumps by 13.5 % at Re_p = 40, as published. Above Re_p = 100 the formula is used as it stands (C_LS is constant
/// there).
struct Mei {
  static constexpr double kLowestBeta = 0.005, kHighestBeta = 0.4, kHighestRe = 100.0;
  static constexpr double kSwitchRe = 40.0, kShear = 0.3314, kDecayRe = 10.0, kFast = 0.0524;

  /// re_s = rho d^2 |w_f|/mu, re_p = rho d U/mu > 0.
  static double factor(double re_s, double re_p) {
    const double beta = std::clamp(0.5 * re_s / re_p, kLowestBeta, kHighestBeta);
    if (re_p > kSwitchRe)
      return kFast * std::sqrt(beta * re_p);
    const double shear = kShear * std::sqrt(beta);
    return (1.0 - shear) * std::exp(-re_p / kDecayRe) + shear;
  }
};

/// C_LS of eq (27); re_s, re_p > 0.
inline double saffman_mei_coefficient(double re_s, double re_p) {
  return kSaffman / std::sqrt(re_s) * Mei::factor(re_s, re_p);
}

/// Oesterle & Bui Dinh (1998), eq (30): C_LM = 0.45 + (Re_r/Re_p - 0.45) exp(-0.05684 Re_r^0.4 Re_p^0.3);
/// measured for 10 < Re_p < 140 and spin 1 <= d|Om|/(2U) <= 6. Towards Re -> 0: Rubinow & Keller (1961), C_LM =
/// Re_r/Re_p. Above Re_p = 140 the formula is used as it stands (it tends to 0.45).
struct OesterleBuiDinh {
  static constexpr double kLowestRe = 10.0, kHighestRe = 140.0;
  static constexpr double kLowestSpin = 1.0, kHighestSpin = 6.0;
  static constexpr double kPlateau = 0.45, kDecay = 0.05684, kSpinExponent = 0.4, kSlipExponent = 0.3;

  /// re_r = rho d^2 |Om|/mu, re_p = rho d U/mu > 0.
  static double coefficient(double re_r, double re_p) {
    const double decay = std::exp(-kDecay * std::pow(re_r, kSpinExponent) * std::pow(re_p, kSlipExponent));
    return kPlateau + (re_r / re_p - kPlateau) * decay;
  }
};

/// Ratio of |w_f| d (or |Om| d) to the slip below which a lift is set to zero: the force tends to zero with it.
constexpr double kNegligibleShear = 1e-12;

/// Eq (26): F_S = (pi/8) rho d^3 C_LS (u x w_f) [N]; u = u_f - u_p slip, vorticity w_f = curl u_f, viscosity mu_p of
/// rheology.h. A particle that is slower than the fluid moves to the faster side.
inline void shear_lift_force(double density, double viscosity, double d, const double* slip, const double* vorticity,
                             double* force) {
  const double speed = base::norm(slip);
  const double w = base::norm(vorticity);
  if (!(w * d > kNegligibleShear * speed) || speed == 0.0) {
    force[0] = force[1] = force[2] = 0.0;
    return;
  }
  const double scale = kPi / 8.0 * density * d * d * d *
                       saffman_mei_coefficient(density * d * d * w / viscosity, density * d * speed / viscosity);
  base::cross(slip, vorticity, force);
  for (int k = 0; k < 3; ++k)
    force[k] *= scale;
}

/// Eq (29): F_M = (pi/8) rho d^2 C_LM U (Om x u)/|Om| [N]; spin Om = curl(u_f)/2 - omega_p.
/// Re -> 0: (pi/8) rho d^3 Om x u.
inline void rotational_lift_force(double density, double viscosity, double d, const double* slip, const double* spin,
                                  double* force) {
  const double speed = base::norm(slip);
  const double rate = base::norm(spin);
  if (!(rate * d > kNegligibleShear * speed) || speed == 0.0) {
    force[0] = force[1] = force[2] = 0.0;
    return;
  }
  const double coefficient =
      OesterleBuiDinh::coefficient(density * d * d * rate / viscosity, density * d * speed / viscosity);
  const double scale = kPi / 8.0 * density * d * d * coefficient * speed / rate;
  base::cross(spin, slip, force);
  for (int k = 0; k < 3; ++k)
    force[k] *= scale;
}

} // namespace eccentra::closures
