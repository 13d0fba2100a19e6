// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Copies a shape's surface sub-spheres into arrays.
#include "contact/surface_spheres.h"

#include "shape/rounded_hull.h"

#include <algorithm>

namespace eccentra::contact {

SurfaceSpheres::SurfaceSpheres() : count(1), x(1, 0.), y(1, 0.), z(1, 0.), r(1, 0.) {
  finish();
}

SurfaceSpheres::SurfaceSpheres(const shape::ClusterShape& shape)
    : count(static_cast<int>(shape.surface_spheres().size())) {
  for (int k : shape.surface_spheres()) {
    const shape::Sphere& sphere = shape.spheres()[k];
    x.push_back(sphere.centre.x());
    y.push_back(sphere.centre.y());
    z.push_back(sphere.centre.z());
    r.push_back(sphere.radius);
  }
  finish();
  hull = shape.hull() && !single_at_centre; // a ball is a sphere
  if (hull) {
    core = contact::ContactCore(*shape.hull());
  } else {
    std::vector<Eigen::Vector3d> centres;
    for (int k = 0; k < count; ++k)
      centres.emplace_back(x[k], y[k], z[k]);
    core = contact::ContactCore(centres, r);
  }
  if (single_at_centre)
    return;
  const auto& inertia = shape.inertia_per_mass();
  constexpr double same = 1e-9; // round-off of a cube's moments
  equal_moments = inertia.maxCoeff() - inertia.minCoeff() <= same * inertia.maxCoeff();
  for (int k = 0; k < 3; ++k)
    inverse_inertia[k] = 1 / inertia[k];
}

void SurfaceSpheres::finish() {
  // Far outside any body, yet far from overflow when squared.
  constexpr float nowhere = 1e6f;
  padded = (count + padding - 1) / padding * padding;
  xf.assign(padded, nowhere);
  yf.assign(padded, 0.f);
  zf.assign(padded, 0.f);
  rf.assign(padded, 0.f);
  bounding_radius = 0;
  smallest_radius = largest_radius = r[0];
  for (int k = 0; k < count; ++k) {
    sphere.push_back(Double4{x[k], y[k], z[k], r[k]});
    xf[k] = static_cast<float>(x[k]);
    yf[k] = static_cast<float>(y[k]);
    zf[k] = static_cast<float>(z[k]);
    rf[k] = static_cast<float>(r[k]);
    bounding_radius = std::max(bounding_radius, std::sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]) + r[k]);
    smallest_radius = std::min(smallest_radius, r[k]);
    largest_radius = std::max(largest_radius, r[k]);
  }
  constexpr double centred = 1e-9; // of the radius: round-off of a generated shape
  single_at_centre = count == 1 && bounding_radius <= r[0] * (1 + centred);
}

} // namespace eccentra::contact
