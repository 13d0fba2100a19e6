// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements the projection of unions of spheres.
#include "closures/projected_area.h"

#include "closures/rheology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace eccentra::closures {

double projected_area(const std::vector<shape::Sphere>& spheres, const Eigen::Vector3d& direction, int lines) {
  const Eigen::Vector3d n = direction.normalized();
  const Eigen::Vector3d e1 = n.unitOrthogonal();
  const Eigen::Vector3d e2 = n.cross(e1);
  struct Disc {
    double x, y, r;
  };
  std::vector<Disc> discs;
  double low = 0.0, high = 0.0;
  for (const shape::Sphere& sphere : spheres) {
    discs.push_back({sphere.centre.dot(e1), sphere.centre.dot(e2), sphere.radius});
    low = std::min(low, discs.back().y - sphere.radius);
    high = std::max(high, discs.back().y + sphere.radius);
  }
  const double step = (high - low) / lines;
  std::vector<std::pair<double, double>> intervals;
  double length = 0.0;
  for (int line = 0; line < lines; ++line) {
    const double y = low + (line + 0.5) * step;
    intervals.clear();
    for (const Disc& disc : discs) {
      const double half2 = disc.r * disc.r - (y - disc.y) * (y - disc.y);
      if (half2 > 0.0)
        intervals.emplace_back(disc.x - std::sqrt(half2), disc.x + std::sqrt(half2));
    }
    std::sort(intervals.begin(), intervals.end());
    double covered = -1e300;
    for (const auto& [begin, end] : intervals) {
      if (end > covered)
        length += end - std::max(begin, covered);
      covered = std::max(covered, end);
    }
  }
  return length * step;
}

ProjectedAreaTable::ProjectedAreaTable(const std::vector<shape::Sphere>& spheres) {
  constexpr int kTableLines = 200;
  for (int p = 0; p <= kPolar; ++p)
    for (int a = 0; a < kAzimuth; ++a) {
      const double theta = 0.5 * kPi * p / kPolar;
      const double phi = 2.0 * kPi * a / kAzimuth;
      areas_.push_back(projected_area(
          spheres, {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}, kTableLines));
    }
}

double ProjectedAreaTable::at(const Eigen::Vector3d& direction) const {
  // Opposite directions show the same area.
  const Eigen::Vector3d n = direction.z() < 0.0 ? Eigen::Vector3d(-direction) : direction;
  const double p = std::atan2(std::hypot(n.x(), n.y()), n.z()) / (0.5 * kPi) * kPolar;
  double a = std::atan2(n.y(), n.x()) / (2.0 * kPi) * kAzimuth;
  if (a < 0.0)
    a += kAzimuth;
  const int p0 = std::min(static_cast<int>(p), kPolar - 1);
  const int a0 = static_cast<int>(a) % kAzimuth;
  const int a1 = (a0 + 1) % kAzimuth;
  const double fp = p - p0;
  const double fa = a - std::floor(a);
  const auto area = [this](int polar, int azimuth) { return areas_[std::size_t(polar) * kAzimuth + azimuth]; };
  return (1.0 - fp) * ((1.0 - fa) * area(p0, a0) + fa * area(p0, a1)) +
         fp * ((1.0 - fa) * area(p0 + 1, a0) + fa * area(p0 + 1, a1));
}

} // namespace eccentra::closures
