// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A plane or cylinder as plain numbers, for inner loops: small vectors cost more to move than to compute with.
#pragma once

#include "contact/surface_spheres.h"
#include "contact/wall_surface.h"

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

/// A primitive wall as plain numbers.
struct PlainWall {
  /// Copies what the kernels read of `surface`.
  explicit PlainWall(const WallSurface& surface) : plane(surface.is_plane()), radius(surface.radius()) {
    const Eigen::Vector3d at_reference = surface.velocity_at(surface.reference());
    for (int k = 0; k < 3; ++k) {
      reference[k] = surface.reference()[k];
      direction[k] = surface.direction()[k];
      across[k] = surface.across()[k];
      across2[k] = surface.across2()[k];
      velocity[k] = at_reference[k];
      omega[k] = surface.angular_velocity()[k];
    }
  }

  bool plane;    ///< else a cylinder
  double radius; ///< of the cylinder [m]
  /// World frame [m, m/s, rad/s], as WallSurface has them; `velocity` is that of the material at `reference`.
  double reference[3], direction[3], across[3], across2[3], velocity[3], omega[3];
};

/// Distance of x from the wall; n becomes the unit normal from the wall to x, `from` the vector from the wall's
/// reference.
inline double nearest(const PlainWall& wall, const double* x, double* n, double* from) {
  for (int k = 0; k < 3; ++k)
    from[k] = x[k] - wall.reference[k];
  const double* d = wall.direction;
  const double along = from[0] * d[0] + from[1] * d[1] + from[2] * d[2];
  if (wall.plane) {
    const double side = along < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k)
      n[k] = side * d[k];
    return std::fabs(along);
  }
  double radial[3];
  for (int k = 0; k < 3; ++k)
    radial[k] = from[k] - along * d[k];
  const double r = std::sqrt(radial[0] * radial[0] + radial[1] * radial[1] + radial[2] * radial[2]);
  // On the axis there is no normal; only a sphere wider than the hole could touch there.
  const double scale = r > 0 ? (r > wall.radius ? 1 : -1) / r : 0;
  for (int k = 0; k < 3; ++k)
    n[k] = scale * radial[k];
  return std::fabs(r - wall.radius);
}

/// Writes to place m of a block how the normal turns where a sphere moves past a wall that is round; `normal`, `from`
/// and `distance` as nearest() has them.
template <class Block>
inline void set_curvature(const PlainWall& wall, const double* normal, const double* from, double distance, Block& c,
                          int m) {
  c.curvature[m] = 0;
  if (wall.plane)
    return;
  for (int k = 0; k < 3; ++k)
    c.separation[k][m] = wall.direction[k];
  const bool outside = normal[0] * from[0] + normal[1] * from[1] + normal[2] * from[2] > 0;
  c.curvature[m] = outside ? 1 / (wall.radius + distance) : -1 / (wall.radius - distance);
}

/// Writes to `hits` (room for spheres.padded) the sub-spheres that may touch the wall, ascending; returns how many.
/// Single precision: this only preselects. `from`: from the wall's reference to the body's centre [m]; `rotation`: of
/// the body, row-major. Directions of the wall are turned into the body frame once, so that a sub-sphere costs one
/// (plane) or two (cylinder) scalar products and no root.
inline int spheres_at_wall(const PlainWall& wall, const double* from, const double* rotation,
                           const SurfaceSpheres& spheres, int* hits) {
  constexpr float round_off = 2e-6f; // of the coordinates
  constexpr int width = SurfaceSpheres::padding;
  const auto in_body = [rotation](const double* d, float* out) {
    for (int k = 0; k < 3; ++k)
      out[k] = static_cast<float>(rotation[k] * d[0] + rotation[3 + k] * d[1] + rotation[6 + k] * d[2]);
  };
  const auto along = [from](const double* d) {
    return static_cast<float>(from[0] * d[0] + from[1] * d[1] + from[2] * d[2]);
  };
  const float *x = spheres.xf.data(), *y = spheres.yf.data(), *z = spheres.zf.data(), *r = spheres.rf.data();
  const float wall_radius = static_cast<float>(wall.radius);
  const float margin = round_off * (wall_radius + static_cast<float>(spheres.bounding_radius));
  float u[3], v[3] = {0, 0, 0}, base_u, base_v = 0;
  if (wall.plane) {
    in_body(wall.direction, u);
    base_u = along(wall.direction);
  } else {
    in_body(wall.across, u);
    in_body(wall.across2, v);
    base_u = along(wall.across);
    base_v = along(wall.across2);
  }
  int kept = 0;
  for (int start = 0; start < spheres.padded; start += width) {
    float gap[width]; // its sign is all that counts
    if (wall.plane)
      for (int k = 0; k < width; ++k) {
        const int s = start + k;
        gap[k] = std::fabs(base_u + u[0] * x[s] + u[1] * y[s] + u[2] * z[s]) - (r[s] + margin);
      }
    else
      for (int k = 0; k < width; ++k) {
        const int s = start + k;
        const float a = base_u + u[0] * x[s] + u[1] * y[s] + u[2] * z[s];
        const float b = base_v + v[0] * x[s] + v[1] * y[s] + v[2] * z[s];
        const float reach = r[s] + margin, square = a * a + b * b;
        const float low = std::max(wall_radius - reach, 0.f), high = wall_radius + reach;
        gap[k] = std::max(low * low - square, square - high * high);
      }
    int any = 0;
    for (int k = 0; k < width; ++k)
      any |= gap[k] <= 0;
    if (!any)
      continue;
    const int last = std::min(width, spheres.count - start);
    for (int k = 0; k < last; ++k) {
      hits[kept] = start + k;
      kept += gap[k] <= 0;
    }
  }
  return kept;
}

} // namespace eccentra::contact
