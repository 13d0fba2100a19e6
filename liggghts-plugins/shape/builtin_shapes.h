// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sphere lists of the built-in shapes, before they get a size.
#pragma once

#include "shape/cluster_shape.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// A built-in shape as a user types it, e.g. "cube 64".
struct BuiltinShape {
  std::string family; ///< sphere, cube, disk
  int count;          ///< number of spheres
  std::string description;
};

/// The shapes that have a name in the literature; cubes exist for every other n^3 up to largest_cube^3, too.
const std::vector<BuiltinShape>& builtin_shapes();
/// Spheres along an edge of the largest cube.
constexpr int largest_cube = 16;

/// Spheres of a built-in shape about the origin, axes of symmetry along the coordinate axes (disks: z), spacing 1
/// (lattice spacing of cubes, outermost ring's radius of disks, distance of the centres from the origin of sphere 6,
/// radius of sphere 1). Throws std::invalid_argument where family or count is unknown, with the counts that exist.
std::vector<Sphere> builtin_spheres(const std::string& family, long count);

} // namespace eccentra::shape
