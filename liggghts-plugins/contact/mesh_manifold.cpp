// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangle has which contact; then each triangle as a flat body.
#include "contact/mesh_manifold.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// Points of two triangles that are closer than this part of an edge are one.
constexpr double same_place = 1e-7;

double size_of(const MeshTriangle& t) {
  return (t.corner[1] - t.corner[0]).norm();
}

} // namespace

Vector3d MeshTriangle::normal() const {
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
}

Vector3d MeshTriangle::closest(const Vector3d& point) const {
  const Vector3d n = normal();
  bool over = true;
  double least = 0;
  Vector3d best = point;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &a = corner[k], along = corner[(k + 1) % 3] - a;
    if (n.cross(along).dot(point - a) >= 0)
      continue;
    const Vector3d on = a + std::clamp((point - a).dot(along) / along.squaredNorm(), 0., 1.) * along;
    const double square = (point - on).squaredNorm();
    if (over || square < least) {
      least = square;
      best = on;
    }
    over = false;
  }
  return over ? Vector3d(point - n.dot(point - corner[0]) * n) : best;
}

MeshManifold::MeshManifold()
    : core_(shape::make_core({Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 0)}, {{0, 1, 2}, {0, 2, 1}}), 0.) {
  core_.edges = {{0, 1}, {1, 2}, {2, 0}};
}

const std::vector<MeshManifold::Touch>& MeshManifold::touches(const ContactBody& body,
                                                              const std::vector<MeshTriangle>& triangles) {
  const ContactCore& core = *body.posed->core;
  const std::size_t count = triangles.size();
  touches_.clear();
  corners_.clear();
  closest_.resize(count);
  points_.resize(std::max(points_.size(), count));
  for (std::vector<int>& points : points_)
    points.clear();
  for (int k = 0; k < core.points; ++k) {
    const double reach = (core.solid == SolidKind::none ? core.point_radius[k] : core.radius) + body.extra;
    const Vector3d point = body.posed->point(k);
    for (std::size_t t = 0; t < count; ++t)
      closest_[t] = triangles[t].closest(point);
    for (std::size_t t = 0; t < count; ++t) {
      if ((closest_[t] - point).squaredNorm() >= reach * reach)
        continue;
      bool counts = true;
      for (std::size_t other = 0; counts && other < count; ++other) {
        if (other == t)
          continue;
        const double near = same_place * std::max(size_of(triangles[t]), size_of(triangles[other]));
        const bool same = (closest_[other] - closest_[t]).norm() < near;
        // The first of those with the same closest point has it; one that has this point, but a closer one, has all.
        if (same ? other < t : (triangles[other].closest(closest_[t]) - closest_[t]).norm() < near)
          counts = false;
      }
      if (counts)
        points_[t].push_back(k);
    }
  }
  for (std::size_t t = 0; t < count; ++t)
    take(body, triangles, static_cast<int>(t));
  return touches_;
}

void MeshManifold::take(const ContactBody& body, const std::vector<MeshTriangle>& triangles, int number) {
  const MeshTriangle& triangle = triangles[number];
  const ContactCore& core = *body.posed->core;
  candidates_.clear();
  for (const int k : points_[number])
    candidates_.push_back(feature_id(k, core_.solid_feature()));
  if (core.solid != SolidKind::none && !core.is_disk()) {
    for (std::size_t i = 0; i < core.edges.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (triangle.edge_active[k])
          candidates_.push_back(feature_id(core.line_feature(static_cast<int>(i)), core_.line_feature(k)));
    for (int k = 0; k < 3; ++k) {
      const Vector3d& corner = triangle.corner[k];
      if (!(triangle.edge_active[k] || triangle.edge_active[(k + 2) % 3]) || corner.norm() >= core.bound + body.extra)
        continue;
      const double near = same_place * size_of(triangle);
      if (std::any_of(corners_.begin(), corners_.end(), [&](const Vector3d& c) { return (c - corner).norm() < near; }))
        continue;
      corners_.push_back(corner);
      candidates_.push_back(feature_id(core.solid_feature(), k));
    }
  }
  if (candidates_.empty())
    return;
  std::sort(candidates_.begin(), candidates_.end());
  const Vector3d middle = (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]) / 3;
  pose_triangle(triangle, middle);
  manifolds_.clear();
  manifolds_.add({body, {&posed_, 0}, middle}, candidates_.data(), static_cast<int>(candidates_.size()));
  manifolds_.evaluate();
  for (const Contact& c : manifolds_.contacts())
    touches_.push_back({number, c});
}

void MeshManifold::pose_triangle(const MeshTriangle& triangle, const Vector3d& middle) {
  core_.bound = 0;
  for (int k = 0; k < core_.padded(); ++k) {
    const Vector3d corner = triangle.corner[std::min(k, 2)] - middle;
    core_.x[k] = corner.x();
    core_.y[k] = corner.y();
    core_.z[k] = corner.z();
    core_.bound = std::max(core_.bound, corner.norm());
    if (k < 3)
      core_.polyhedron.vertices[k] = corner;
  }
  const Vector3d normal = triangle.normal();
  for (shape::CoreFace& face : core_.polyhedron.faces) {
    face.normal = face.corners[1] == 1 ? normal : Vector3d(-normal);
    face.offset = 0; // the middle lies in the plane
  }
  posed_.pose(core_, Eigen::Matrix3d::Identity());
}

} // namespace eccentra::contact
