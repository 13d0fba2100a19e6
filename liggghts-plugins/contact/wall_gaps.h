// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps between all sub-spheres of a body and an analytic wall, in loops that vectorise.
#pragma once

#include "contact/surface_spheres.h"
#include "contact/wall_surface.h"

#include <Eigen/Core>

#include <cmath>

namespace eccentra::contact {

/// gap[k] [m] for k < spheres.count, negative if sub-sphere k overlaps the wall. `x` is the body's centre,
/// `rotation` its row-major matrix from body to world. Directions of the wall are turned into the body frame once, so
/// that a sub-sphere costs one (plane) or two (cylinder) scalar products.
inline void wall_gaps(const WallSurface& wall, const Eigen::Vector3d& x, const Eigen::Matrix3d& rotation,
                      const SurfaceSpheres& spheres, double* __restrict gap) {
  const Eigen::Vector3d from_reference = x - wall.reference();
  const double* __restrict cx = spheres.x.data();
  const double* __restrict cy = spheres.y.data();
  const double* __restrict cz = spheres.z.data();
  const double* __restrict cr = spheres.r.data();
  const int count = spheres.count;
  if (wall.is_plane()) {
    const double base = from_reference.dot(wall.direction());
    const Eigen::Vector3d n = rotation.transpose() * wall.direction();
    const double nx = n.x(), ny = n.y(), nz = n.z();
    for (int k = 0; k < count; ++k)
      gap[k] = std::abs(base + nx * cx[k] + ny * cy[k] + nz * cz[k]) - cr[k];
    return;
  }
  const double radius = wall.radius();
  const double base_u = from_reference.dot(wall.across());
  const double base_v = from_reference.dot(wall.across2());
  const Eigen::Vector3d u = rotation.transpose() * wall.across();
  const Eigen::Vector3d v = rotation.transpose() * wall.across2();
  const double ux = u.x(), uy = u.y(), uz = u.z();
  const double vx = v.x(), vy = v.y(), vz = v.z();
  for (int k = 0; k < count; ++k) {
    const double a = base_u + ux * cx[k] + uy * cy[k] + uz * cz[k];
    const double b = base_v + vx * cx[k] + vy * cy[k] + vz * cz[k];
    gap[k] = std::abs(std::sqrt(a * a + b * b) - radius) - cr[k];
  }
}

} // namespace eccentra::contact
