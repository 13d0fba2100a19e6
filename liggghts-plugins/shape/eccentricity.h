// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shape eccentricity delta_e: distance by which the line of a contact's normal misses the centre of mass.
#pragma once

#include "shape/cluster_shape.h"

#include <vector>

namespace eccentra::shape {

/// Values of delta_e / R_eq over all contacts of a shape with a partner. delta_e = |c x n| for the centre c of
/// the sub-sphere that is touched and the contact normal n, eq (32); R_eq is the shape's own equivalent radius, eq
/// (34).
class EccentricityDistribution {
 public:
  /// `samples` of equal weight [-]; `least` and `largest` are the extremes, which may lie beyond the samples'.
  EccentricityDistribution(std::vector<double> samples, double least, double largest);

  /// Least value over all contacts.
  double min() const { return min_; }
  /// Mean over all contacts.
  double mean() const { return mean_; }
  /// Largest value over all contacts.
  double max() const { return max_; }
  /// Value that the part `probability` in [0, 1] of all contacts does not exceed.
  double quantile(double probability) const;

 private:
  std::vector<double> sorted_;
  double min_, mean_, max_;
};

/// Against a plane. Every orientation is equally likely; the plane touches the sub-sphere that reaches farthest.
EccentricityDistribution eccentricity_plane(const ClusterShape& shape);

/// Against a sphere of radius `radius` [m] that moves towards the centre of mass; every direction is equally likely.
EccentricityDistribution eccentricity_sphere(const ClusterShape& shape, double radius);

/// Against a small body that touches every part of the surface of the union with equal probability, along its normal.
EccentricityDistribution eccentricity_surface(const ClusterShape& shape);

/// Against another cluster that moves towards the centre of mass; direction and both orientations are equally likely.
/// The values are those of `shape`.
EccentricityDistribution eccentricity_cluster(const ClusterShape& shape, const ClusterShape& other);

} // namespace eccentra::shape
