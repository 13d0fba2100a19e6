// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contacts of a rounded body with a plane, in a hole and on a pipe.
#pragma once

#include "contact/manifold.h"

#include <vector>

namespace eccentra::contact {

/// Each function adds the contacts of a body with a wall, the body as A: normals lead from the wall into the body, ids
/// are features of the body, ascending, and reaches are the body's own radii. A triangle of a mesh is a ContactCore of
/// radius 0 at rest, for Manifolds.

/// `normal` unit, out of the wall; `height` of the body's centre above it [m]. Vertices touch, of disks the points on
/// rims and the deepest point of each rim.
void plane_contacts(const ContactBody& body, const Eigen::Vector3d& normal, double height,
                    std::vector<Contact>& contacts);

/// A cylinder; its axis passes at `to_axis` from the body's centre.
struct CylinderWall {
  Eigen::Vector3d to_axis;   ///< from the body's centre to some point of the axis [m]
  Eigen::Vector3d direction; ///< of the axis, unit
  double radius;             ///< [m]
};
/// Inside it, where the wall is hollow: the same features touch as on a plane.
void hole_contacts(const ContactBody& body, const CylinderWall& wall, std::vector<Contact>& contacts);
/// Outside it: edges touch it with their middles, too, and disks with their sides.
void pipe_contacts(const ContactBody& body, const CylinderWall& wall, std::vector<Contact>& contacts);

} // namespace eccentra::contact
