// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The dimensionless numbers of a particle in a flow.
#pragma once

namespace eccentra::closures {

/// Dimensionless numbers of a particle, in which closures state their ranges of validity.
enum Number : int {
  kReynolds,       ///< Re_HB, eq (23)
  kBingham,        ///< Bi = (tau0/k)(d/U)^n
  kStokesNumber,   ///< (rho_p/rho_f) Re_HB/9
  kShearReynolds,  ///< Re_s = rho d^2 |w_f|/mu
  kSpinReynolds,   ///< Re_r = rho d^2 |Om|/mu
  kShearParameter, ///< beta = Re_s/(2 Re_HB)
  kSpinParameter,  ///< d |Om|/(2 U)
  kDensityRatio,   ///< rho_p/rho_f
  kNumbers
};
constexpr const char* kNumberNames[kNumbers] = {"Re_HB", "Bi",   "Stokes",      "Re_s",
                                                "Re_r",  "beta", "d|Om|/(2 U)", "rho_p/rho_f"};

} // namespace eccentra::closures
