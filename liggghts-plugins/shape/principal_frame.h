// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The body frame: principal axes near the axes in which a body is given.
#pragma once

#include <Eigen/Core>

namespace eccentra::shape {

/// Rows are the body axes in the given frame: principal, right-handed, and as near to the given axes as the inertia
/// allows. Moments that differ by less than 1e-6 of the largest count as equal, because files have few digits and the
/// body frame must not depend on the last of them.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& inertia);

/// Makes moments exactly equal that are equal within this tolerance.
Eigen::Vector3d merge_equal_moments(Eigen::Vector3d moments);

/// The centre of mass of a body of this size [m]; a coordinate that is 0 to round-off becomes 0.
Eigen::Vector3d without_round_off(Eigen::Vector3d centre, double size);

} // namespace eccentra::shape
