// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The convex hull of points, with no more vertices than contacts can afford.
#pragma once

#include "shape/rounded_core.h"

#include <vector>

namespace eccentra::shape {

/// Most vertices of a hull: each costs a distance in every contact that it may take part in, and a face that many
/// vertices carry is stiffer than one that few carry.
constexpr int max_hull_vertices = 64;

/// Polyhedron of the points' convex hull; coplanar triangles are one face. Throws std::invalid_argument where the
/// points lie in a plane.
ConvexCore convex_hull(const std::vector<Eigen::Vector3d>& points);

/// The hull of at most `vertices` of the points: those that stand out farthest from the hull of the ones taken before.
struct ThinnedHull {
  ConvexCore core;
  double error; ///< how far at most a point stands out of it [m]
};
ThinnedHull thinned_hull(const std::vector<Eigen::Vector3d>& points, int vertices = max_hull_vertices);

} // namespace eccentra::shape
