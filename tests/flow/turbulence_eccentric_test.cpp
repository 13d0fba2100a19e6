// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure drop of turbulent flow in eccentric annuli over that of the concentric one (docs/turbulence.md).
#include "flow/turbulent_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace eccentra::test {
namespace {

constexpr double kPipe = 0.02413, kHole = 0.0635, kVelocity = 2;

/// Haciislamoglu and Cartalos (1994), turbulent.
double expected_ratio(double e, double n) {
  const double k = kPipe / kHole;
  return 1 - 0.048 * e / n * std::pow(k, 0.8454) - 2.0 / 3 * e * e * std::sqrt(n) * std::pow(k, 0.1852) +
         0.285 * e * e * e * std::sqrt(n) * std::pow(k, 0.2527);
}

double gradient(double eccentricity, const PowerLaw& law) {
  TurbulentCase run("eccentric", "kEpsilon");
  run.annulus(eccentricity, 12, 32);
  run.fluid(law, kVelocity, 2 * (kHole - kPipe));
  return run.gradient();
}

TEST(Eccentric, RatioOfHaciislamogluAndCartalos) {
  ASSERT_NEAR(expected_ratio(0.5, 0.65), 0.8939, 1e-4);
  ASSERT_NEAR(expected_ratio(0.8, 0.65), 0.7785, 1e-4);
  const double width = kHole - kPipe;
  const PowerLaw fluids[] = {{kVelocity * 2 * width / 1e5, 1}, {2.8e-5, 0.65}};
  for (const PowerLaw& law : fluids) {
    const double concentric = gradient(0, law);
    for (const double e : {0.5, 0.8}) {
      const double found = gradient(e, law) / concentric, expected = expected_ratio(e, law.n);
      std::printf("eccentricity %.1f n %.2f  ratio %.4f  correlation %.4f  %+5.1f %%\n", e, law.n, found, expected,
                  100 * (found / expected - 1));
      // Measured within 12.3 %, as the page states.
      EXPECT_NEAR(found, expected, 0.13 * expected) << "e " << e << " n " << law.n;
    }
  }
}

} // namespace
} // namespace eccentra::test
