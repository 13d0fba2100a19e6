// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a sphere's surface that its neighbours do not cover, by circles of latitude.
#pragma once

#include "shape/cluster_shape.h"

#include <cstddef>
#include <vector>

namespace eccentra::shape {

/// Part of a unit sphere that a neighbour covers: the directions n with n . axis > height.
struct Cap {
  Eigen::Vector3d axis; ///< unit vector
  double height;        ///< cosine of the opening angle
};

/// Half-open arc of a circle of latitude, in radians, begin <= end, within [0, 2 pi].
struct Arc {
  double begin, end; ///< [rad]
};

/// The free part of one sphere of a union.
class SphereExposure {
 public:
  /// Sphere `index` of `spheres`.
  SphereExposure(const std::vector<Sphere>& spheres, std::size_t index);

  /// True if a single neighbour contains the whole sphere, which then has no free part.
  bool swallowed() const { return swallowed_; }
  /// Sorted heights in [-1, 1] (unit sphere) between which the free arcs move smoothly; first -1, last 1.
  std::vector<double> break_heights() const;
  /// Free arcs of the circle of latitude at `height` in [-1, 1]; the reference stays valid until the next call.
  const std::vector<Arc>& free_arcs(double height);

 private:
  bool is_free(const Eigen::Vector3d& direction, std::size_t skip1, std::size_t skip2) const;

  bool swallowed_ = false;
  std::vector<Cap> caps_;
  std::vector<double> longitude_; // of each cap's axis
  std::vector<double> tilt_;      // sine of the angle between each cap's axis and the z axis
  std::vector<Arc> covered_, free_;
};

} // namespace eccentra::shape
