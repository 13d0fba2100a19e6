// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The body frame: principal axes near the axes in which a body is given.
#pragma once

#include <Eigen/Core>

namespace eccentra::shape {

/// Rows are the body axes in the given frame: principal, right-handed, and as near to the given axes as the inertia
/// allows. Moments that differ by less than 1e-6 of the largest count as equal: files carry few digits, and a body
/// frame must not hang on the last of them.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& inertia);

/// Makes moments that are equal within that tolerance exactly equal.
Eigen::Vector3d merge_equal_moments(Eigen::Vector3d moments);

/// The centre of mass of a body of this size [m], each coordinate 0 where it is so but for round-off.
Eigen::Vector3d without_round_off(Eigen::Vector3d centre, double size);

} // namespace eccentra::shape
