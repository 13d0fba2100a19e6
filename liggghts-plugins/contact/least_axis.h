// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Separating axes of two cores.
#pragma once

#include "contact/contact_core.h"

namespace eccentra::contact {

/// The cores are `separation` [m] apart along `normal`, which points from B to A. A negative value is the distance by
/// which A must move along the normal until the cores do not overlap.
struct SeparatingAxis {
  double separation;      ///< [m]
  Eigen::Vector3d normal; ///< unit, from B to A
};

/// Separation along a unit vector from B to A; `offset` leads from A's centre to B's.
double separation_along(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset,
                        const Eigen::Vector3d& normal);

/// The axis of greatest separation among the faces' normals (of disks: their axes, and the directions from their axes
/// to the other's centre). The cores' distance is at least the separation.
SeparatingAxis best_face_axis(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset);

/// The same, also with the directions across one edge of each core: the exact separation of polyhedra that overlap.
SeparatingAxis least_axis(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset);

} // namespace eccentra::contact
