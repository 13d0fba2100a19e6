// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a rounded body as triangles, for pictures and dumps.
#pragma once

#include "shape/rounded_hull.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace eccentra::shape {

/// A point of the surface, body frame [m].
struct SurfacePoint {
  Eigen::Vector3d position; ///< [m]
  Eigen::Vector3d normal;   ///< unit, outward
  int vertex;               ///< of the core, or the point on a disk's rim, that is nearest
};

/// Triangles whose corners, counter-clockwise from outside, lie on the surface and are shared.
struct TriangleSurface {
  std::vector<SurfacePoint> points;          ///< corners
  std::vector<std::array<int, 3>> triangles; ///< indices of three corners
};

/// Flat faces are as large as they are; curved parts have `steps` >= 1 strips across an edge or a rim, whose
/// triangles lie inside of the body.
TriangleSurface drawn_surface(const RoundedHull& hull, int steps);

} // namespace eccentra::shape
