// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From spheres in any frame to a shape in its body frame.
#include "shape/cluster_shape.h"

#include "shape/principal_frame.h"
#include "shape/rounded_hull.h"
#include "shape/union_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// A free area below this part of a sphere is round-off, not something that another body can touch.
constexpr double negligible_exposure = 1e-9;

/// Bounding radii beyond these [m] are mistakes, and their fifth powers would not stay finite.
constexpr double kMinSize = 1e-12, kMaxSize = 1e12;

} // namespace

ClusterShape::ClusterShape(std::string name, std::vector<Sphere> spheres, const MassProperties& properties)
    : name_(std::move(name)), spheres_(std::move(spheres)), volume_(properties.volume), surface_(properties.surface) {
  require_connected(spheres_);
  if (!(volume_ > 0) || !(surface_ > 0) || !std::isfinite(volume_) || !std::isfinite(surface_) ||
      !properties.centre.allFinite() || !properties.inertia_per_mass.allFinite())
    throw std::invalid_argument("shape '" + name_ + "' has no volume or a mass property that is not a finite number");
  const Eigen::Matrix3d axes = principal_axes(properties.inertia_per_mass);
  inertia_per_mass_ = merge_equal_moments((axes * properties.inertia_per_mass * axes.transpose()).diagonal());
  if (!(inertia_per_mass_.minCoeff() > 0))
    throw std::invalid_argument("shape '" + name_ + "' has a moment of inertia that is not greater than 0");
  const Eigen::Vector3d origin = without_round_off(properties.centre, std::cbrt(volume_));
  given_centre_ = origin;
  bounding_radius_ = 0;
  for (Sphere& s : spheres_) {
    s.centre = axes * (s.centre - origin);
    bounding_radius_ = std::max(bounding_radius_, s.centre.norm() + s.radius);
  }
  if (!(bounding_radius_ > kMinSize && bounding_radius_ < kMaxSize))
    throw std::invalid_argument("shape '" + name_ + "' has a bounding radius of " + std::to_string(bounding_radius_) +
                                " m, which is no size of a body; expected 1e-12 to 1e12 m: check diameter and scale");
  const std::vector<double> exposed = measure_union(spheres_).exposed_area;
  smallest_radius_ = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (exposed[i] > negligible_exposure * 4 * M_PI * spheres_[i].radius * spheres_[i].radius) {
      surface_spheres_.push_back(static_cast<int>(i));
      smallest_radius_ = std::min(smallest_radius_, spheres_[i].radius);
    }
}

ClusterShape::ClusterShape(const RoundedHull& hull)
    : name_(hull.name()), volume_(hull.volume()), surface_(hull.surface()), given_centre_(hull.given_centre()),
      inertia_per_mass_(hull.inertia_per_mass()), bounding_radius_(hull.bounding_radius()),
      smallest_radius_(hull.radius()), hull_(std::make_shared<RoundedHull>(hull)) {
  for (const Eigen::Vector3d& point : hull.points()) {
    surface_spheres_.push_back(static_cast<int>(spheres_.size()));
    spheres_.push_back({point, hull.radius()});
  }
}

double ClusterShape::equivalent_radius() const {
  return std::cbrt(3 * volume_ / (4 * M_PI));
}

double ClusterShape::sphericity() const {
  return std::cbrt(36 * M_PI * volume_ * volume_) / surface_;
}

} // namespace eccentra::shape
