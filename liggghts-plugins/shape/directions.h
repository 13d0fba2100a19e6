// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Evenly spread directions and orientations, the same in every run.
#pragma once

#include <Eigen/Geometry>

namespace eccentra::shape {

/// Direction `index` of `count` spread evenly over the unit sphere (spherical Fibonacci lattice).
Eigen::Vector3d fibonacci_direction(int index, int count);

/// A direction and an independent uniform rotation, member `index` of a low-discrepancy sequence in five dimensions.
struct DirectionAndRotation {
  Eigen::Vector3d direction;   ///< unit vector
  Eigen::Quaterniond rotation; ///< uniform over all rotations
};
/// Member `index` >= 0 of the sequence.
DirectionAndRotation even_direction_and_rotation(int index);

} // namespace eccentra::shape
