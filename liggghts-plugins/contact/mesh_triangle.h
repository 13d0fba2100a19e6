// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle of a mesh, and several of them as one surface.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <vector>

namespace eccentra::contact {

/// Corners from the body's centre [m]; edge k joins corners k and k + 1. An edge is active in one of the triangles that
/// share it, and in none where a plane goes on across it.
struct MeshTriangle {
  std::array<Eigen::Vector3d, 3> corner; ///< from the body's centre [m]
  std::array<bool, 3> edge_active;       ///< by the number of an edge
  /// Unit, by the order of the corners.
  Eigen::Vector3d normal() const;
  /// The point closest to another.
  Eigen::Vector3d closest(const Eigen::Vector3d& point) const;
  /// Points closer than this are one [m].
  double same_place() const;
};

/// Plane of a triangle and ball about it: what is out of reach of them is out of reach of the triangle.
class TriangleExtent {
 public:
  /// Of a triangle whose corners are apart.
  explicit TriangleExtent(const MeshTriangle& triangle);
  /// Whether the triangle may have a point closer than `reach` [m] to `point`.
  bool within(const Eigen::Vector3d& point, double reach) const {
    const Eigen::Vector3d from = point - middle_;
    return std::abs(normal_.dot(from)) < reach && from.squaredNorm() < (radius_ + reach) * (radius_ + reach);
  }

 private:
  Eigen::Vector3d middle_, normal_;
  double radius_;
};

/// A triangle of several, and the way from its closest point to another.
struct ClosestTriangle {
  int number;           ///< among them
  Eigen::Vector3d away; ///< from the triangle to the point [m]
};
/// The closest of one or more triangles, whose extents are given; the first of those as close as each other.
ClosestTriangle closest_of(const std::vector<MeshTriangle>& triangles, const std::vector<TriangleExtent>& extents,
                           const Eigen::Vector3d& point);

/// The surface to which each triangle belongs, by the number of its first one. Neighbours belong to one where the edge
/// between them is flat or stands out to the side of `seen_from`, and to two where it is the bottom of a corner.
std::vector<int> surfaces_of(const std::vector<MeshTriangle>& triangles, const Eigen::Vector3d& seen_from);

} // namespace eccentra::contact
