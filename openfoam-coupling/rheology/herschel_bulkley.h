// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity of a Herschel-Bulkley fluid, regularised in two ways. Pure functions without OpenFOAM headers.
#pragma once

#include <algorithm>
#include <cmath>

namespace eccentra::rheology {

/// tau = tau0 + k g^n in yielded fluid. Any consistent units: dynamic (Pa, Pa s^n) or over density (m2/s2, m2/s^(2-n)).
struct HerschelBulkley {
  double tau0; ///< yield stress >= 0
  double k;    ///< consistency > 0
  double n;    ///< flow index > 0
  double mu_y; ///< viscosity of the unyielded fluid > 0, upper bound of both laws
};

/// Eq (4): mu = mu_y up to gc = tau0/mu_y, then (tau0 + k (g^n - gc^n))/g, continuous at gc. No value exceeds mu_y: eq
/// (4) alone has no bound for tau0 = 0 and n < 1, nor a useful one for tau0 << mu_y. g = sqrt(2 D:D) >= 0 [1/s]. Error
/// of a flow rate falls as mu_y^-n: all stress of the sheared fluid is lowered by k gc^n.
inline double regularised_viscosity(const HerschelBulkley& fluid, double g) {
  const double gc = fluid.tau0 / fluid.mu_y;
  if (!(g > gc)) {
    return fluid.mu_y;
  }
  const double stress = fluid.tau0 + fluid.k * (std::pow(g, fluid.n) - std::pow(gc, fluid.n));
  // Compare the products, so that a vanishing rate never divides.
  return stress >= fluid.mu_y * g ? fluid.mu_y : stress / g;
}

/// min(mu_y, (tau0 + k g^n)/g). The yielded fluid is exact; error of a flow rate falls as 1/mu_y.
inline double capped_viscosity(const HerschelBulkley& fluid, double g) {
  const double stress = fluid.tau0 + fluid.k * std::pow(g, fluid.n);
  return stress >= fluid.mu_y * g ? fluid.mu_y : stress / g;
}

} // namespace eccentra::rheology
