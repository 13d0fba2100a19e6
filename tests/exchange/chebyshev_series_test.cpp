// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The polynomial that stands for implicit steps of diffusion.
#include "exchange/chebyshevSeries.H"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using eccentra::exchange::inversePowerSeries;

double valueAt(const std::vector<double>& series, double x) {
  const double angle = std::acos(x);
  double sum = 0;
  for (std::size_t k = 0; k < series.size(); ++k)
    sum += series[k] * std::cos(double(k) * angle);
  return sum;
}

TEST(ChebyshevSeries, DiffersFromTheStepsByNoMoreThanTheTolerance) {
  constexpr int kPlaces = 200;
  for (const double largest : {1.01, 3.0, 60.0, 900.0})
    for (const int power : {1, 2, 3})
      for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-13}) {
        const std::vector<double> series = inversePowerSeries(largest, power, tolerance);
        double worst = 0;
        for (int i = 0; i <= kPlaces; ++i) {
          // Close together at both ends.
          const double x = -std::cos(M_PI * i / kPlaces);
          const double eigenvalue = 0.5 * (largest + 1) + 0.5 * (largest - 1) * x;
          worst = std::max(worst, std::abs(valueAt(series, x) - std::pow(eigenvalue, -power)));
        }
        // An eigenvalue near 1 is known from x to round-off of the largest.
        const double round_off = 1e-13 + 4e-15 * largest;
        // Twice: what is cut off, and the factor that makes it 1 at the eigenvalue 1.
        EXPECT_LE(worst, 2 * tolerance + round_off) << largest << " " << power << " " << tolerance;
        EXPECT_NEAR(valueAt(series, -1), 1, round_off);
      }
}

TEST(ChebyshevSeries, ItsLengthGrowsAsTheRootOfTheLargestEigenvalue) {
  const double few = double(inversePowerSeries(1e2, 2, 1e-9).size());
  const double many = double(inversePowerSeries(1e4, 2, 1e-9).size());
  EXPECT_NEAR(many / few, 10, 2);
}

} // namespace
