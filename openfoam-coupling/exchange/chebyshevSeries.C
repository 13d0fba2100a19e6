// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation in Chebyshev nodes, cut where the rest is below the tolerance.
#include "exchange/chebyshevSeries.H"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace eccentra::exchange {
namespace {

/// Coefficients of the interpolation in `nodes` nodes (Gauss-Chebyshev quadrature).
std::vector<double> interpolation(double largest, int power, int nodes) {
  std::vector<double> c(nodes, 0.0);
  for (int j = 0; j < nodes; ++j) {
    const double angle = M_PI * (j + 0.5) / nodes;
    const double x = std::cos(angle);
    const double f = std::pow(0.5 * (largest + 1) + 0.5 * (largest - 1) * x, -power);
    // T_k(x) = cos(k angle) by its recurrence
    double previous = x, now = 1;
    for (int k = 0; k < nodes; ++k) {
      c[k] += (k == 0 ? 1.0 : 2.0) / nodes * f * now;
      const double next = 2 * x * now - previous;
      previous = now;
      now = next;
    }
  }
  return c;
}

} // namespace

std::vector<double> inversePowerSeries(double largest, int power, double tolerance) {
  constexpr int kFewest = 16, kMost = 1 << 15;
  // The peak at the eigenvalue 1 is 1/sqrt(largest) wide, as an angle: fewer nodes miss it.
  constexpr int kNodesPerPeak = 8;
  // The coefficients fall by (sqrt(largest) - 1)/(sqrt(largest) + 1) each: what all after the k-th sum up to, over it.
  const double restOverLast = 0.5 * power * (std::sqrt(largest) + 1);
  for (int nodes = kFewest;; nodes *= 2) {
    if (nodes < kNodesPerPeak * std::sqrt(largest) && nodes < kMost)
      continue;
    std::vector<double> c = interpolation(largest, power, nodes);
    const auto count =
        std::find_if(c.begin(), c.end(), [&](double last) { return std::abs(last) * restOverLast <= tolerance; }) -
        c.begin();
    // Once half of the coefficients are enough, what aliases to them is far below the tolerance.
    if (count > nodes / 2 && nodes < kMost)
      continue;
    c.resize(count);
    double atOne = 0;
    for (std::ptrdiff_t k = 0; k < count; ++k)
      atOne += (k % 2 ? -1 : 1) * c[k];
    for (double& coefficient : c)
      coefficient /= atOne;
    return c;
  }
}

} // namespace eccentra::exchange
