// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Convex cores of rounded bodies: a body is its core swept by a ball.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace eccentra::shape {

/// A flat side of a core.
struct CoreFace {
  Eigen::Vector3d normal;   ///< unit, outward
  double offset;            ///< normal . x on the face [m]
  double area;              ///< [m2]
  std::vector<int> corners; ///< counter-clockwise as seen from outside
};

/// A straight edge of a core. The face `left` has it counter-clockwise from `from` to `to`, the face `right` clockwise.
/// A segment's only edge has no faces (-1).
struct CoreEdge {
  int from, to;    ///< vertices
  int left, right; ///< faces
};

/// A convex polyhedron, or a convex polygon (two faces back to back), a segment, or a point. Any frame, metres.
struct ConvexCore {
  std::vector<Eigen::Vector3d> vertices; ///< corners [m]
  std::vector<CoreFace> faces;           ///< flat faces
  std::vector<CoreEdge> edges;           ///< where two faces meet

  /// 3 for a polyhedron, 2 for a polygon, 1 for a segment, 0 for a point.
  int dimension() const;
  /// Angle [rad] by which the outward normal turns across an edge: from the left face's to the right face's.
  double turn(const CoreEdge& edge) const;
};

/// A core from its vertices and the corners of its faces (counter-clockwise from outside; for a polygon both
/// sides). Throws std::invalid_argument if the faces do not enclose a convex polyhedron.
ConvexCore make_core(std::vector<Eigen::Vector3d> vertices, const std::vector<std::vector<int>>& faces);

/// The box with these half edges about the origin; half edges of 0 leave a polygon, a segment or a point.
ConvexCore box_core(const Eigen::Vector3d& half);

/// The core of a disk: a cylinder about the z axis, centred at the origin. A half height of 0 leaves a flat disc, a
/// radius of 0 a segment, both a point.
struct DiskCore {
  double radius;      ///< [m]
  double half_height; ///< [m]
};

/// Closest point of a core.
struct CoreDistance {
  double distance;        ///< [m]; inside a core of three dimensions negative: minus the depth under the nearest face
  Eigen::Vector3d normal; ///< unit, from the closest point to the given point (inside: of the nearest face)
};
/// Of a point in the frame of the core.
CoreDistance distance_to_core(const ConvexCore& core, const Eigen::Vector3d& point);
CoreDistance distance_to_core(const DiskCore& core, const Eigen::Vector3d& point);

/// A point of the core that is farthest in `direction`.
Eigen::Vector3d support_of_core(const ConvexCore& core, const Eigen::Vector3d& direction);
Eigen::Vector3d support_of_core(const DiskCore& core, const Eigen::Vector3d& direction);

/// Smallest distance of two parallel planes that enclose the core [m].
double least_width(const ConvexCore& core);

} // namespace eccentra::shape
