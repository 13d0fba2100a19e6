// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of a quantity over all directions; its extremes are found by a search from the best samples.
#pragma once

#include "shape/directions.h"
#include "shape/eccentricity.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace eccentra::shape {

/// Largest `value` that a search from `start` finds. Steps go in rotating directions and become shorter when none of
/// them increases the value.
template <typename Value> double climb(const Value& value, Eigen::Vector3d start, double best) {
  constexpr double first_step = 0.02, last_step = 1e-9; // [rad]
  constexpr int directions_per_step = 12;
  int turn = 0;
  for (double step = first_step; step > last_step; ++turn) {
    const Eigen::Vector3d side = start.unitOrthogonal(), up = start.cross(side);
    bool higher = false;
    for (int k = 0; k < directions_per_step && !higher; ++k) {
      const double angle = 2 * M_PI * k / directions_per_step + turn;
      const Eigen::Vector3d trial = (start + step * (std::cos(angle) * side + std::sin(angle) * up)).normalized();
      const double found = value(trial);
      if (found > best) {
        best = found;
        start = trial;
        higher = true;
      }
    }
    step = std::min(step * (higher ? 1.5 : 0.5), first_step);
  }
  return best;
}

/// Largest `sign` * value over the sphere, from the best of the samples taken at the Fibonacci directions.
template <typename Value> double extreme(const Value& value, const std::vector<double>& samples, double sign) {
  constexpr std::size_t starts = 24;
  std::vector<int> order(samples.size());
  std::iota(order.begin(), order.end(), 0);
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(std::min(starts, order.size()));
  std::partial_sort(order.begin(), middle, order.end(),
                    [&](int a, int b) { return sign * samples[a] > sign * samples[b]; });
  double best = -std::numeric_limits<double>::max();
  for (auto it = order.begin(); it != middle; ++it)
    best = std::max(best, climb([&](const Eigen::Vector3d& n) { return sign * value(n); },
                                fibonacci_direction(*it, static_cast<int>(samples.size())), sign * samples[*it]));
  return sign * best;
}

/// Distribution of `value` with every direction equally likely.
template <typename Value> EccentricityDistribution over_directions(const Value& value) {
  constexpr int count = 50000; // mean good to 1e-4, spacing of directions 0.016 rad
  std::vector<double> samples(count);
  for (int k = 0; k < count; ++k)
    samples[k] = value(fibonacci_direction(k, count));
  const double most = extreme(value, samples, 1), least = extreme(value, samples, -1);
  return {std::move(samples), least, most};
}

} // namespace eccentra::shape
