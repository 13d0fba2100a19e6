// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/mesh_triangle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// Points of two triangles that are closer than this part of an edge are one.
constexpr double same_part = 1e-7;
/// A neighbour that rises by no more than this part of its height across the edge lies in the plane.
constexpr double flat = 1e-6;

/// Whether a neighbour rises out of the plane of a triangle to the side of a point.
bool rises(const MeshTriangle& neighbour, const MeshTriangle& triangle, const Vector3d& seen_from) {
  const Vector3d normal = triangle.normal(), at = triangle.corner[0];
  const double side = normal.dot(seen_from - at) < 0 ? -1 : 1;
  double most = 0, size = 0;
  for (const Vector3d& corner : neighbour.corner) {
    most = std::max(most, side * normal.dot(corner - at));
    size = std::max(size, (corner - neighbour.corner[0]).norm());
  }
  return most > flat * size;
}

bool share_an_edge(const MeshTriangle& a, const MeshTriangle& b) {
  const double near = std::max(a.same_place(), b.same_place());
  int shared = 0;
  for (const Vector3d& corner : a.corner)
    shared +=
        std::any_of(b.corner.begin(), b.corner.end(), [&](const Vector3d& c) { return (c - corner).norm() < near; });
  return shared == 2;
}

} // namespace

Vector3d MeshTriangle::normal() const {
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
}

Vector3d MeshTriangle::closest(const Vector3d& point) const {
  const Vector3d n = (corner[1] - corner[0]).cross(corner[2] - corner[0]); // of any length: this is called most
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
  return over ? Vector3d(point - n.dot(point - corner[0]) / n.squaredNorm() * n) : best;
}

double MeshTriangle::same_place() const {
  return same_part * (corner[1] - corner[0]).norm();
}

TriangleExtent::TriangleExtent(const MeshTriangle& triangle)
    : middle_((triangle.corner[0] + triangle.corner[1] + triangle.corner[2]) / 3), normal_(triangle.normal()),
      radius_(0) {
  for (const Vector3d& corner : triangle.corner)
    radius_ = std::max(radius_, (corner - middle_).norm());
}

ClosestTriangle closest_of(const std::vector<MeshTriangle>& triangles, const std::vector<TriangleExtent>& extents,
                           const Vector3d& point) {
  ClosestTriangle closest{0, Vector3d::Zero()};
  double least = std::numeric_limits<double>::max(), distance = least;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!extents[t].within(point, distance))
      continue;
    const Vector3d from = point - triangles[t].closest(point);
    if (const double square = from.squaredNorm(); square < least) {
      least = square;
      distance = std::sqrt(square);
      closest = {static_cast<int>(t), from};
    }
  }
  return closest;
}

std::vector<int> surfaces_of(const std::vector<MeshTriangle>& triangles, const Vector3d& seen_from) {
  std::vector<int> surface(triangles.size());
  std::iota(surface.begin(), surface.end(), 0);
  for (std::size_t t = 1; t < triangles.size(); ++t)
    for (std::size_t s = 0; s < t; ++s) {
      if (surface[s] == surface[t] || !share_an_edge(triangles[s], triangles[t]) ||
          (rises(triangles[t], triangles[s], seen_from) && rises(triangles[s], triangles[t], seen_from)))
        continue;
      const int from = std::max(surface[s], surface[t]), to = std::min(surface[s], surface[t]);
      std::replace(surface.begin(), surface.end(), from, to);
    }
  return surface;
}

} // namespace eccentra::contact
