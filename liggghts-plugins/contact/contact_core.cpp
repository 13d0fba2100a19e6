// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cores from shapes; their points in the world; distances from them.
#include "contact/contact_core.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::contact {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// True for the eight corners of a box along the axes about the origin; their half edges.
bool is_box(const shape::ConvexCore& core, Vector3d& half) {
  if (core.vertices.size() != 8 || core.faces.size() != 6)
    return false;
  half = core.vertices[0].cwiseAbs();
  const double tolerance = 1e-12 * half.maxCoeff();
  std::array<bool, 8> found{};
  for (const Vector3d& v : core.vertices) {
    if ((v.cwiseAbs() - half).cwiseAbs().maxCoeff() > tolerance)
      return false;
    found[(v.x() > 0 ? 1 : 0) | (v.y() > 0 ? 2 : 0) | (v.z() > 0 ? 4 : 0)] = true;
  }
  return std::all_of(found.begin(), found.end(), [](bool f) { return f; });
}

shape::CoreDistance distance_to_box(const Vector3d& half, const Vector3d& p) {
  const Vector3d out = p - p.cwiseMax(-half).cwiseMin(half);
  const double square = out.squaredNorm();
  if (square > 0) {
    const double distance = std::sqrt(square);
    return {distance, out / distance};
  }
  int k = 0;
  const double depth = (half - p.cwiseAbs()).minCoeff(&k);
  Vector3d normal = Vector3d::Zero();
  normal[k] = p[k] < 0 ? -1 : 1;
  return {-depth, normal};
}

} // namespace

ContactCore::ContactCore() {
  set_points({Vector3d::Zero()});
  point_radius = {0};
}

ContactCore::ContactCore(const shape::RoundedHull& hull) {
  radius = hull.radius();
  contact_radius = hull.contact_radius();
  bound = hull.bounding_radius();
  if (hull.disk())
    set_disk(hull);
  else
    set_polyhedron(*hull.polyhedron());
}

ContactCore::ContactCore(const shape::ConvexCore& core, double radius) : radius(radius), contact_radius(radius) {
  for (const Vector3d& v : core.vertices)
    bound = std::max(bound, v.norm() + radius);
  set_polyhedron(core);
}

ContactCore::ContactCore(const std::vector<Vector3d>& centres, const std::vector<double>& radii) : point_radius(radii) {
  set_points(centres);
  for (std::size_t k = 0; k < radii.size(); ++k) {
    radius = std::max(radius, radii[k]);
    bound = std::max(bound, centres[k].norm() + radii[k]);
  }
  contact_radius = radius;
}

ContactCore::ContactCore(const std::vector<MeshTriangle>& triangles)
    : solid(SolidKind::surface), surface(triangles), extents(triangles.begin(), triangles.end()) {
  std::vector<Vector3d> corners;
  const auto number = [&](const Vector3d& corner, double near) {
    const auto at =
        std::find_if(corners.begin(), corners.end(), [&](const Vector3d& c) { return (c - corner).norm() < near; });
    if (at != corners.end())
      return static_cast<int>(at - corners.begin());
    corners.push_back(corner);
    return static_cast<int>(corners.size()) - 1;
  };
  for (const MeshTriangle& t : triangles) {
    int corner[3];
    for (int k = 0; k < 3; ++k)
      corner[k] = number(t.corner[k], t.same_place());
    for (int k = 0; k < 3; ++k)
      if (t.edge_active[k])
        edges.push_back({corner[k], corner[(k + 1) % 3]});
  }
  set_points(corners);
  for (const Vector3d& corner : corners)
    bound = std::max(bound, corner.norm());
}

void ContactCore::set_points(const std::vector<Vector3d>& centres) {
  points = static_cast<int>(centres.size());
  const int length = (points + lane_width - 1) / lane_width * lane_width;
  for (int k = 0; k < length; ++k) {
    const Vector3d& p = centres[std::min(k, points - 1)];
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
}

void ContactCore::set_polyhedron(const shape::ConvexCore& core) {
  set_points(core.vertices);
  polyhedron = core;
  for (const shape::CoreEdge& edge : core.edges)
    edges.push_back({edge.from, edge.to});
  if (core.dimension() == 0) // a ball is its one point
    point_radius = {radius};
  else if (core.dimension() < 3)
    solid = SolidKind::flat;
  else
    solid = is_box(core, half) ? SolidKind::box : SolidKind::polyhedron;
}

void ContactCore::set_disk(const shape::RoundedHull& hull) {
  const shape::DiskCore& core = *hull.disk();
  solid = SolidKind::disk;
  half = {core.radius, core.radius, core.half_height};
  ring = shape::points_on_rim;
  set_points(hull.points());
  rims = points / ring;
}

void PosedCore::pose(const ContactCore& of, const Matrix3d& turn) {
  core = &of;
  rotation = turn;
  const int length = of.padded();
  x.resize(length);
  y.resize(length);
  z.resize(length);
  const double *bx = of.x.data(), *by = of.y.data(), *bz = of.z.data();
  double *wx = x.data(), *wy = y.data(), *wz = z.data();
  double r[9];
  Eigen::Map<Matrix3d>(r, 3, 3) = turn; // column-major
#pragma GCC ivdep
  for (int k = 0; k < length; ++k) {
    wx[k] = r[0] * bx[k] + r[3] * by[k] + r[6] * bz[k];
    wy[k] = r[1] * bx[k] + r[4] * by[k] + r[7] * bz[k];
    wz[k] = r[2] * bx[k] + r[5] * by[k] + r[8] * bz[k];
  }
}

double PosedCore::reach_along(const Vector3d& direction) const {
  if (core->solid == SolidKind::box)
    return core->half.dot((rotation.transpose() * direction).cwiseAbs());
  if (core->is_disk()) {
    const Vector3d d = rotation.transpose() * direction;
    return core->half.x() * std::sqrt(d.x() * d.x() + d.y() * d.y()) + core->half.z() * std::abs(d.z());
  }
  double most = -std::numeric_limits<double>::max();
  for (int k = 0; k < core->padded(); ++k)
    most = std::max(most, direction.x() * x[k] + direction.y() * y[k] + direction.z() * z[k]);
  return most;
}

Vector3d PosedCore::support(const Vector3d& direction) const {
  if (core->is_disk())
    return rotation *
           shape::support_of_core(shape::DiskCore{core->half.x(), core->half.z()}, rotation.transpose() * direction);
  int best = 0;
  double most = -std::numeric_limits<double>::max();
  for (int k = 0; k < core->points; ++k) {
    const double along = direction.x() * x[k] + direction.y() * y[k] + direction.z() * z[k];
    if (along > most) {
      most = along;
      best = k;
    }
  }
  return point(best);
}

shape::CoreDistance distance_to(const PosedCore& posed, const Vector3d& point) {
  const ContactCore& core = *posed.core;
  const Vector3d local = posed.rotation.transpose() * point;
  shape::CoreDistance d;
  if (core.solid == SolidKind::box)
    d = distance_to_box(core.half, local);
  else if (core.is_disk())
    d = shape::distance_to_core(shape::DiskCore{core.half.x(), core.half.z()}, local);
  else
    d = distance_to_faces(core, local);
  d.normal = (posed.rotation * d.normal).eval();
  return d;
}

shape::CoreDistance distance_to_faces(const ContactCore& core, const Vector3d& point) {
  if (core.solid != SolidKind::surface)
    return shape::distance_to_core(core.polyhedron, point);
  const ClosestTriangle closest = closest_of(core.surface, core.extents, point);
  const double distance = closest.away.norm();
  return {distance, distance > 0 ? Vector3d(closest.away / distance) : core.surface[closest.number].normal()};
}

} // namespace eccentra::contact
