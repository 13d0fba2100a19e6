// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fibonacci lattice on the sphere; additive recurrence in five dimensions.
#include "shape/directions.h"

#include <array>
#include <cmath>

namespace eccentra::shape {
namespace {

/// Root of x^6 = x + 1; its inverse powers drive the additive recurrence of least discrepancy known in five dimensions.
constexpr double plastic_root_5d = 1.1347241384015194;

} // namespace

Eigen::Vector3d fibonacci_direction(int index, int count) {
  static const double golden_angle = M_PI * (3 - std::sqrt(5.0));
  const double z = 1 - (2 * index + 1.0) / count, ring = std::sqrt((1 - z) * (1 + z)), angle = golden_angle * index;
  return {ring * std::cos(angle), ring * std::sin(angle), z};
}

DirectionAndRotation even_direction_and_rotation(int index) {
  std::array<double, 5> u{};
  double step = 1;
  for (double& value : u) {
    step /= plastic_root_5d;
    const double x = 0.5 + (index + 1) * step;
    value = x - std::floor(x);
  }
  const double z = 2 * u[0] - 1, ring = std::sqrt((1 - z) * (1 + z));
  // Uniform quaternion after Shoemake (1992).
  const double a = std::sqrt(1 - u[2]), b = std::sqrt(u[2]);
  return {Eigen::Vector3d(ring * std::cos(2 * M_PI * u[1]), ring * std::sin(2 * M_PI * u[1]), z),
          Eigen::Quaterniond(b * std::cos(2 * M_PI * u[4]), a * std::sin(2 * M_PI * u[3]),
                             a * std::cos(2 * M_PI * u[3]), b * std::sin(2 * M_PI * u[4]))};
}

} // namespace eccentra::shape
