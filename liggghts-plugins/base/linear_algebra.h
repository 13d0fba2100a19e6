// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Decompositions by Eigen that many files use, compiled once: each costs every file that includes it ten seconds.
#pragma once

#include <Eigen/Geometry>

namespace eccentra::base {

/// What symmetric_modes returns.
struct SymmetricModes {
  Eigen::Vector3d values;  ///< in ascending order
  Eigen::Matrix3d vectors; ///< of length 1, as columns
};

/// Of a symmetric matrix, whose lower triangle is read.
SymmetricModes symmetric_modes(const Eigen::Matrix3d& matrix);

/// The shortest rotation that turns the direction of `from` to that of `to`; neither may be zero.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

} // namespace eccentra::base
