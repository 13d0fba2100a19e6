// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rays from the centre of mass to the surface, one for each vertex of an octahedral sphere.
#include "shape/rounded_surface.h"

#include "shape/surface_panels.h"

#include <cmath>

namespace eccentra::shape {
namespace {

/// Halvings of the ray's bracket: to the last digit but a few.
constexpr int kHalvings = 48;

/// Where a ray from inside leaves the body, as a multiple of `ray`.
double length_of(const RoundedHull& body, const Eigen::Vector3d& ray) {
  double inside = 0, outside = 1.01 * body.bounding_radius() / ray.norm();
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (inside + outside);
    (body.distance_to_core(middle * ray).distance < body.radius() ? inside : outside) = middle;
  }
  return outside;
}

} // namespace

Surface surface_of(const RoundedHull& body, int n) {
  Surface surface = octahedral_sphere(n);
  // Rays through an ellipsoid of the body's extents, so that the rim of a flat body has its share of triangles.
  Eigen::Vector3d extent;
  for (int k = 0; k < 3; ++k)
    extent[k] = body.support(Eigen::Vector3d::Unit(k))[k] + body.radius();
  for (Eigen::Vector3d& v : surface.vertices) {
    const Eigen::Vector3d ray = v.cwiseProduct(extent);
    v = ray * length_of(body, ray);
  }
  const double scale = std::cbrt(body.volume() / solid_properties(surface).volume);
  for (Eigen::Vector3d& v : surface.vertices)
    v *= scale;
  return surface;
}

} // namespace eccentra::shape
