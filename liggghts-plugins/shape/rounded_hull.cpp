// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a core and a ball to a body in its body frame; its shadows.
#include "shape/rounded_hull.h"

#include "shape/principal_frame.h"
#include "shape/rounded_moments.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void move(ConvexCore& core, const Matrix3d& axes, const Vector3d& origin) {
  for (Vector3d& v : core.vertices)
    v = axes * (v - origin);
  for (CoreFace& face : core.faces) {
    face.offset -= face.normal.dot(origin);
    face.normal = axes * face.normal;
  }
}
void move(DiskCore& core, const Matrix3d& axes, const Vector3d& origin) {
  (void)core; // a disk is given in its body frame
  (void)axes;
  (void)origin;
}

double farthest(const ConvexCore& core) {
  double most = 0;
  for (const Vector3d& v : core.vertices)
    most = std::max(most, v.norm());
  return most;
}
double farthest(const DiskCore& core) {
  return std::hypot(core.radius, core.half_height);
}

/// Area and circumference of a core's shadow along the unit vector `u`.
struct Shadow {
  double area, circumference;
};

Shadow shadow(const ConvexCore& core, const Vector3d& u) {
  Shadow s{0, 0};
  for (const CoreFace& face : core.faces)
    s.area += face.area * std::abs(face.normal.dot(u)) / 2;
  const auto seen = [&](int face) { return core.faces[face].normal.dot(u) > 0; };
  for (const CoreEdge& edge : core.edges) {
    const double across = u.cross(core.vertices[edge.to] - core.vertices[edge.from]).norm();
    if (edge.left < 0)
      s.circumference += 2 * across;
    else if (core.dimension() == 2 || seen(edge.left) != seen(edge.right))
      s.circumference += across;
  }
  return s;
}

Shadow shadow(const DiskCore& core, const Vector3d& u) {
  const double tilt = std::min(1., std::hypot(u.x(), u.y())); // sine of the angle to the axis
  return {M_PI * core.radius * core.radius * std::abs(u.z()) + 4 * core.radius * core.half_height * tilt,
          4 * core.radius * std::comp_ellint_2(tilt) + 4 * core.half_height * tilt};
}

} // namespace

RoundedHull::RoundedHull(std::string name, const Core& core, double radius)
    : name_(std::move(name)), core_(core), radius_(radius), contact_radius_(radius) {
  const MassProperties p = std::visit([&](const auto& c) { return rounded_mass(c, radius); }, core_);
  volume_ = p.volume;
  surface_ = p.surface;
  if (!(radius > 0) || !(volume_ > 0) || !std::isfinite(volume_) || !p.inertia_per_mass.allFinite())
    throw std::invalid_argument("shape '" + name_ + "' has no volume or a mass property that is not a finite number");
  const Matrix3d axes = principal_axes(p.inertia_per_mass);
  inertia_per_mass_ = merge_equal_moments((axes * p.inertia_per_mass * axes.transpose()).diagonal());
  given_centre_ = without_round_off(p.centre, std::cbrt(volume_));
  std::visit([&](auto& c) { move(c, axes, given_centre_); }, core_);
  bounding_radius_ = std::visit([](const auto& c) { return farthest(c); }, core_) + radius;
}

RoundedHull::RoundedHull(std::string name, const Core& core, double radius, const Properties& p)
    : name_(std::move(name)), core_(core), radius_(radius), contact_radius_(p.contact_radius), volume_(p.volume),
      surface_(p.surface), given_centre_(Vector3d::Zero()), inertia_per_mass_(p.inertia_per_mass),
      bounding_radius_(std::visit([](const auto& c) { return farthest(c); }, core) + radius) {}

std::vector<Vector3d> RoundedHull::points() const {
  if (const ConvexCore* core = polyhedron())
    return core->vertices;
  const DiskCore& core = *disk();
  std::vector<Vector3d> points;
  for (const double height : {core.half_height, -core.half_height}) {
    for (int k = 0; k < points_on_rim; ++k) {
      const double angle = 2 * M_PI * k / points_on_rim;
      points.emplace_back(core.radius * std::cos(angle), core.radius * std::sin(angle), height);
    }
    if (core.half_height == 0)
      break;
  }
  return points;
}

double RoundedHull::equivalent_radius() const {
  return std::cbrt(3 * volume_ / (4 * M_PI));
}

double RoundedHull::sphericity() const {
  return std::cbrt(36 * M_PI * volume_ * volume_) / surface_;
}

Vector3d RoundedHull::support(const Vector3d& direction) const {
  return std::visit([&](const auto& c) { return support_of_core(c, direction); }, core_);
}

CoreDistance RoundedHull::distance_to_core(const Vector3d& point) const {
  return std::visit([&](const auto& c) { return shape::distance_to_core(c, point); }, core_);
}

double RoundedHull::projected_area(const Vector3d& direction) const {
  const Shadow s = std::visit([&](const auto& c) { return shadow(c, direction.normalized()); }, core_);
  return s.area + radius_ * s.circumference + M_PI * radius_ * radius_;
}

RoundedHull::Core scaled(const RoundedHull::Core& core, double scale) {
  if (const auto* disk = std::get_if<DiskCore>(&core))
    return DiskCore{scale * disk->radius, scale * disk->half_height};
  ConvexCore c = std::get<ConvexCore>(core);
  if (scale == 0) { // the core has shrunk to a point
    ConvexCore point;
    point.vertices.push_back(Vector3d::Zero());
    return point;
  }
  for (Vector3d& v : c.vertices)
    v *= scale;
  for (CoreFace& face : c.faces) {
    face.offset *= scale;
    face.area *= scale * scale;
  }
  return c;
}

} // namespace eccentra::shape
