// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangle has which contact; then each triangle as a flat body.
#include "contact/mesh_manifold.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

constexpr int face_feature = 6; // of a triangle
constexpr int edge_feature = 3;

/// Whether a point of a surface belongs to another triangle instead: one that has it and is closer to the body's
/// `point` elsewhere, or one that is as close and comes first.
bool belongs_elsewhere(const Vector3d& on, const Vector3d& point, double near, const MeshTriangle& other,
                       bool other_first) {
  if ((other.closest(on) - on).norm() >= near)
    return false;
  return (other.closest(point) - on).norm() >= near || other_first;
}

/// One surface of a mesh as a solid, and where its features are in the mesh.
struct MeshSurface {
  ContactCore solid;
  std::vector<int> number_of; ///< of a member among the triangles
  /// Of a corner or edge of the solid: its member (-1: at no active edge), and its feature there.
  std::vector<std::array<int, 2>> corner_at, edge_at;

  MeshSurface(const std::vector<MeshTriangle>& triangles, const std::vector<int>& surface, int number)
      : solid(members_of(triangles, surface, number)), corner_at(solid.points, {-1, -1}) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (surface[t] == number)
        number_of.push_back(static_cast<int>(t));
    for (int m = 0; m < static_cast<int>(solid.surface.size()); ++m)
      for (int k = 0; k < 3; ++k)
        if (solid.surface[m].edge_active[k]) {
          const std::array<int, 2>& ends = solid.edges[edge_at.size()];
          edge_at.push_back({m, edge_feature + k});
          for (int end = 0; end < 2; ++end)
            if (corner_at[ends[end]][0] < 0)
              corner_at[ends[end]] = {m, (k + end) % 3};
        }
  }

  /// Member and feature that a contact with the solid has.
  std::array<int, 2> place_of(const Contact& contact) const {
    const int feature = feature_b(contact.id);
    if (feature < solid.points)
      return corner_at[feature];
    if (feature < solid.solid_feature())
      return edge_at[feature - solid.points];
    const Vector3d on = contact.arm - contact.distance * contact.normal;
    return {closest_of(solid.surface, solid.extents, on).number, face_feature + feature - solid.solid_feature()};
  }

 private:
  static std::vector<MeshTriangle> members_of(const std::vector<MeshTriangle>& triangles,
                                              const std::vector<int>& surface, int number) {
    std::vector<MeshTriangle> members;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (surface[t] == number)
        members.push_back(triangles[t]);
    return members;
  }
};

} // namespace

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
  extents_.clear();
  for (const MeshTriangle& triangle : triangles)
    extents_.emplace_back(triangle);
  if (core.is_disk()) {
    touches_of_disk(body, triangles);
    return touches_;
  }
  points_.resize(std::max(points_.size(), count));
  for (std::vector<int>& points : points_)
    points.clear();
  for (int k = 0; k < core.points; ++k) {
    const double reach = (core.solid == SolidKind::none ? core.point_radius[k] : core.radius) + body.extra;
    const Vector3d point = body.posed->point(k);
    for (std::size_t t = 0; t < count; ++t) {
      if (!extents_[t].within(point, reach))
        continue;
      const Vector3d on = triangles[t].closest(point);
      if ((on - point).squaredNorm() < reach * reach && belongs_to(t, on, point, triangles))
        points_[t].push_back(k);
    }
  }
  for (std::size_t t = 0; t < count; ++t)
    take(body, triangles, static_cast<int>(t));
  return touches_;
}

/// Whether a triangle has its point `on` closest to the body's `point` for itself: the first of those with the same
/// closest point has it; one that has this point, but a closer one, has all.
bool MeshManifold::belongs_to(std::size_t triangle, const Vector3d& on, const Vector3d& point,
                              const std::vector<MeshTriangle>& triangles) const {
  const double own = triangles[triangle].same_place();
  for (std::size_t other = 0; other < triangles.size(); ++other) {
    const double near = std::max(own, triangles[other].same_place());
    if (other == triangle || !extents_[other].within(on, 2 * near))
      continue;
    if ((triangles[other].closest(point) - on).norm() < near ? other < triangle
                                                             : (triangles[other].closest(on) - on).norm() < near)
      return false;
  }
  return true;
}

void MeshManifold::take(const ContactBody& body, const std::vector<MeshTriangle>& triangles, int number) {
  const MeshTriangle& triangle = triangles[number];
  const ContactCore& core = *body.posed->core;
  candidates_.clear();
  for (const int k : points_[number])
    candidates_.push_back(feature_id(k, core_.solid_feature()));
  if (core.solid != SolidKind::none) {
    for (std::size_t i = 0; i < core.edges.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (triangle.edge_active[k])
          candidates_.push_back(feature_id(core.line_feature(static_cast<int>(i)), core_.line_feature(k)));
    for (int k = 0; k < 3; ++k)
      if ((triangle.edge_active[k] || triangle.edge_active[(k + 2) % 3]) &&
          take_corner(triangle.corner[k], triangle.same_place(), body))
        candidates_.push_back(feature_id(core.solid_feature(), k));
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

/// Whether a corner is in reach of the body and has not been counted before.
bool MeshManifold::take_corner(const Vector3d& corner, double near, const ContactBody& body) {
  if (corner.norm() >= body.posed->core->bound + body.extra ||
      std::any_of(corners_.begin(), corners_.end(), [&](const Vector3d& c) { return (c - corner).norm() < near; }))
    return false;
  corners_.push_back(corner);
  return true;
}

void MeshManifold::touches_of_disk(const ContactBody& disk, const std::vector<MeshTriangle>& triangles) {
  // What is out of reach joins no surfaces: neighbour lists may hold more or less of it.
  std::vector<MeshTriangle> near;
  std::vector<int> number;
  const double reach = disk.posed->core->bound + disk.extra;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (extents_[t].within(Vector3d::Zero(), reach) && triangles[t].closest(Vector3d::Zero()).norm() < reach) {
      near.push_back(triangles[t]);
      number.push_back(static_cast<int>(t));
    }
  const std::vector<int> surface = surfaces_of(near, Vector3d::Zero());
  for (int t = 0; t < static_cast<int>(near.size()); ++t)
    if (surface[t] == t)
      take_surface(disk, near, surface, t);
  for (Touch& touch : touches_)
    touch.triangle = number[touch.triangle];
}

/// A disk against the triangles of one surface, as against one solid.
void MeshManifold::take_surface(const ContactBody& disk, const std::vector<MeshTriangle>& triangles,
                                const std::vector<int>& surface, int number) {
  const ContactCore& core = *disk.posed->core;
  const MeshSurface mesh(triangles, surface, number);
  const ContactCore& solid = mesh.solid;
  posed_.pose(solid, Eigen::Matrix3d::Identity());
  candidates_.clear();
  for (int k = 0; k < core.points + core.arcs(); ++k)
    candidates_.push_back(feature_id(k, solid.solid_feature()));
  if (core.has_axis())
    for (int k = 0; k < solid.lines(); ++k)
      candidates_.push_back(feature_id(core.axis_feature(), solid.line_feature(k)));
  for (int k = 0; k < solid.points; ++k)
    if (const int m = mesh.corner_at[k][0]; m >= 0 && take_corner(posed_.point(k), solid.surface[m].same_place(), disk))
      candidates_.push_back(feature_id(core.solid_feature(), k));
  manifolds_.clear();
  manifolds_.add({disk, {&posed_, 0}, Vector3d::Zero()}, candidates_.data(), static_cast<int>(candidates_.size()));
  manifolds_.evaluate();
  for (Contact c : manifolds_.contacts()) {
    const auto [member, feature] = mesh.place_of(c);
    const double own = solid.surface[member].same_place();
    const auto takes_it = [&, on = Vector3d(c.arm - c.distance * c.normal)](std::size_t t) {
      return surface[t] != number &&
             belongs_elsewhere(on, c.arm, std::max(own, triangles[t].same_place()), triangles[t], surface[t] < number);
    };
    bool elsewhere = false;
    for (std::size_t t = 0; feature >= face_feature && !elsewhere && t < triangles.size(); ++t)
      elsewhere = takes_it(t);
    if (elsewhere)
      continue;
    c.id = feature_id(feature_a(c.id), feature);
    touches_.push_back({mesh.number_of[member], c});
  }
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
