// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of shapes of a scene.
#include "shape/rounded_hull.h"
#include "styles/bodies/fix_cluster_bodies.h"

namespace eccentra::styles {
namespace {

bool same_shape(const shape::ClusterShape& a, const shape::ClusterShape& b) {
  // A shape that comes back through a restart file is the same to the last digits.
  constexpr double tolerance = 1e-12;
  if (a.name() != b.name() || a.spheres().size() != b.spheres().size())
    return false;
  const double scale = tolerance * a.bounding_radius();
  if (!a.hull() != !b.hull() || (a.hull() && std::abs(a.hull()->contact_radius() - b.hull()->contact_radius()) > scale))
    return false;
  for (std::size_t k = 0; k < a.spheres().size(); ++k)
    if ((a.spheres()[k].centre - b.spheres()[k].centre).norm() > scale ||
        std::abs(a.spheres()[k].radius - b.spheres()[k].radius) > scale)
      return false;
  return true;
}

} // namespace

ShapeTable::ShapeTable() {
  surfaces_.push_back(std::make_unique<contact::SurfaceSpheres>());
}

int ShapeTable::add(shape::ClusterShape shape) {
  for (int id = 0; id < size(); ++id)
    if (same_shape(*shapes_[id], shape))
      return id;
  surfaces_.push_back(std::make_unique<contact::SurfaceSpheres>(shape));
  rotations_.emplace_back(shape.inertia_per_mass());
  shapes_.push_back(std::make_unique<shape::ClusterShape>(std::move(shape)));
  return size() - 1;
}

} // namespace eccentra::styles
