// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The convex hull of points, with a limited number of vertices.
#pragma once

#include "shape/rounded_core.h"

#include <vector>

namespace eccentra::shape {

/// Largest number of vertices of a hull. Each vertex costs a distance in every contact that it may take part in, and a
/// face with many vertices is stiffer than one with few.
constexpr int max_hull_vertices = 64;

/// Polyhedron of the points' convex hull; coplanar triangles form one face. Throws std::invalid_argument if the
/// points lie in a plane.
ConvexCore convex_hull(const std::vector<Eigen::Vector3d>& points);

/// The hull of at most `vertices` of the points. Each point taken is the one farthest outside of the hull of the
/// earlier ones.
struct ThinnedHull {
  ConvexCore core; ///< the hull, in the frame of the points
  double error;    ///< largest distance of a point outside of the hull [m]
};
/// Of fewer than four points the hull of all; else `vertices` >= 4. Throws as convex_hull().
ThinnedHull thinned_hull(const std::vector<Eigen::Vector3d>& points, int vertices = max_hull_vertices);

} // namespace eccentra::shape
