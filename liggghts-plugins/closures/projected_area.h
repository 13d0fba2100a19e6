// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Projected area of a cluster by direction, for oriented drag laws.
#pragma once

#include "shape/cluster_shape.h"

#include <vector>

namespace eccentra::closures {

/// Area of the projection of a union of spheres onto the plane normal to `direction` (any length, body frame) [m2].
/// Scan lines with exact intervals; relative error below 1e-3 at this many lines.
double projected_area(const std::vector<shape::Sphere>& spheres, const Eigen::Vector3d& direction, int lines = 400);

/// The same, tabulated once per shape over the half sphere of directions and interpolated.
class ProjectedAreaTable {
 public:
  /// `spheres` in the body frame [m].
  explicit ProjectedAreaTable(const std::vector<shape::Sphere>& spheres);
  /// direction: body frame, any length > 0 [m2].
  double at(const Eigen::Vector3d& direction) const;

 private:
  static constexpr int kPolar = 24;   ///< intervals from the z axis to the equator
  static constexpr int kAzimuth = 64; ///< intervals around it
  std::vector<double> areas_;
};

} // namespace eccentra::closures
