// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Convex cores: faces and edges, closest points, support points, least width.
#include "shape/rounded_core.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace eccentra::shape {
namespace {

using Eigen::Vector3d;

/// Part of the size by which a vertex may stand out of a face's plane: coordinates of single precision.
constexpr double flatness = 1e-6;

double size_of(const std::vector<Vector3d>& vertices) {
  Vector3d low = vertices.front(), high = low;
  for (const Vector3d& v : vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).norm();
}

CoreFace make_face(const std::vector<Vector3d>& vertices, const std::vector<int>& corners) {
  const Vector3d& first = vertices[corners[0]];
  Vector3d twice = Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    twice += (vertices[corners[k]] - first).cross(vertices[corners[k + 1]] - first);
  const double length = twice.norm();
  if (!(length > 0))
    throw std::invalid_argument("a face of a convex core has no area");
  CoreFace face{twice / length, 0, length / 2, corners};
  for (const int k : corners)
    face.offset += face.normal.dot(vertices[k]) / static_cast<double>(corners.size());
  return face;
}

/// Closest point of the segment from a to b.
Vector3d closest_on_segment(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
  const Vector3d along = b - a;
  return a + std::clamp((point - a).dot(along) / along.squaredNorm(), 0., 1.) * along;
}

CoreDistance outside(const Vector3d& point, const Vector3d& closest, const Vector3d& if_zero) {
  const Vector3d out = point - closest;
  const double distance = out.norm();
  return {distance, distance > 0 ? Vector3d(out / distance) : if_zero};
}

CoreDistance distance_to_flat_core(const ConvexCore& core, const Vector3d& point) {
  Vector3d closest = core.vertices[0], normal = Vector3d::UnitZ();
  if (!core.faces.empty()) {
    const CoreFace& face = core.faces[0];
    const double height = face.normal.dot(point) - face.offset;
    normal = height < 0 ? Vector3d(-face.normal) : face.normal;
    bool over = true;
    for (std::size_t k = 0; k < face.corners.size() && over; ++k) {
      const Vector3d &a = core.vertices[face.corners[k]],
                     &b = core.vertices[face.corners[(k + 1) % face.corners.size()]];
      over = face.normal.cross(b - a).dot(point - a) >= 0;
    }
    if (over)
      return {std::abs(height), normal};
  }
  double least = (point - closest).squaredNorm();
  for (const CoreEdge& edge : core.edges) {
    const Vector3d on = closest_on_segment(core.vertices[edge.from], core.vertices[edge.to], point);
    if ((point - on).squaredNorm() < least) {
      least = (point - on).squaredNorm();
      closest = on;
    }
  }
  if (core.faces.empty() && !core.edges.empty())
    normal = (core.vertices[1] - core.vertices[0]).unitOrthogonal();
  return outside(point, closest, normal);
}

} // namespace

int ConvexCore::dimension() const {
  return faces.size() > 2 ? 3 : faces.size() == 2 ? 2 : edges.empty() ? 0 : 1;
}

double ConvexCore::turn(const CoreEdge& edge) const {
  if (edge.left < 0)
    return 2 * M_PI;
  if (faces.size() == 2)
    return M_PI;
  const Vector3d along = (vertices[edge.to] - vertices[edge.from]).normalized();
  const Vector3d &from = faces[edge.left].normal, &to = faces[edge.right].normal;
  return std::atan2(to.dot(along.cross(from)), from.dot(to));
}

ConvexCore make_core(std::vector<Vector3d> vertices, const std::vector<std::vector<int>>& faces) {
  ConvexCore core;
  core.vertices = std::move(vertices);
  for (const auto& corners : faces)
    core.faces.push_back(make_face(core.vertices, corners));
  std::map<std::pair<int, int>, int> walked; // from, to -> face
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < faces[f].size(); ++k)
      if (!walked.insert({{faces[f][k], faces[f][(k + 1) % faces[f].size()]}, static_cast<int>(f)}).second)
        throw std::invalid_argument("two faces of a convex core have the same edge the same way round");
  for (const auto& [ends, face] : walked) {
    const auto other = walked.find({ends.second, ends.first});
    if (other == walked.end())
      throw std::invalid_argument("the faces of a convex core leave a hole");
    if (ends.first < ends.second)
      core.edges.push_back({ends.first, ends.second, face, other->second});
  }
  const double tolerance = flatness * size_of(core.vertices);
  for (const CoreFace& face : core.faces)
    for (const Vector3d& v : core.vertices)
      if (face.normal.dot(v) > face.offset + tolerance)
        throw std::invalid_argument("the faces of a core do not enclose a convex body");
  return core;
}

ConvexCore box_core(const Vector3d& half) {
  std::vector<int> axes; // along which the box extends
  for (int k = 0; k < 3; ++k)
    if (half[k] > 0)
      axes.push_back(k);
  ConvexCore core;
  const int corners = 1 << axes.size();
  for (int n = 0; n < corners; ++n) {
    Vector3d v = Vector3d::Zero();
    for (std::size_t k = 0; k < axes.size(); ++k)
      v[axes[k]] = n >> k & 1 ? half[axes[k]] : -half[axes[k]];
    core.vertices.push_back(v);
  }
  if (axes.size() == 3)
    return make_core(core.vertices,
                     {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
  if (axes.size() == 2)
    return make_core(core.vertices, {{0, 1, 3, 2}, {0, 2, 3, 1}});
  if (axes.size() == 1)
    core.edges.push_back({0, 1, -1, -1});
  return core;
}

CoreDistance distance_to_core(const ConvexCore& core, const Vector3d& point) {
  if (core.dimension() < 3)
    return distance_to_flat_core(core, point);
  double deepest = -std::numeric_limits<double>::max(), least = std::numeric_limits<double>::max();
  Vector3d closest = core.vertices[0], normal = core.faces[0].normal;
  for (const CoreFace& face : core.faces) {
    const double height = face.normal.dot(point) - face.offset;
    if (height > deepest) {
      deepest = height;
      normal = face.normal;
    }
    if (height <= 0 || height * height >= least)
      continue;
    bool over = true;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Vector3d &a = core.vertices[face.corners[k]],
                     &b = core.vertices[face.corners[(k + 1) % face.corners.size()]];
      if (face.normal.cross(b - a).dot(point - a) >= 0)
        continue;
      over = false;
      const Vector3d on = closest_on_segment(a, b, point);
      if ((point - on).squaredNorm() < least) {
        least = (point - on).squaredNorm();
        closest = on;
      }
    }
    if (over) {
      least = height * height;
      closest = point - height * face.normal;
    }
  }
  return deepest <= 0 ? CoreDistance{deepest, normal} : outside(point, closest, normal);
}

CoreDistance distance_to_core(const DiskCore& core, const Vector3d& point) {
  const double rho = std::hypot(point.x(), point.y()), beside = rho - core.radius,
               above = std::abs(point.z()) - core.half_height, up = point.z() < 0 ? -1 : 1;
  const Vector3d radial = rho > 0 ? Vector3d(point.x() / rho, point.y() / rho, 0) : Vector3d::UnitX();
  if (beside <= 0 && above <= 0) // inside, or on it
    return beside > above ? CoreDistance{beside, radial} : CoreDistance{above, {0, 0, up}};
  const Vector3d out = std::max(beside, 0.) * radial + Vector3d(0, 0, up * std::max(above, 0.));
  const double distance = out.norm();
  return {distance, out / distance};
}

Vector3d support_of_core(const ConvexCore& core, const Vector3d& direction) {
  const Vector3d* best = &core.vertices[0];
  for (const Vector3d& v : core.vertices)
    if (v.dot(direction) > best->dot(direction))
      best = &v;
  return *best;
}

Vector3d support_of_core(const DiskCore& core, const Vector3d& direction) {
  const double rho = std::hypot(direction.x(), direction.y()), to_rim = rho > 0 ? core.radius / rho : 0;
  return {direction.x() * to_rim, direction.y() * to_rim, direction.z() < 0 ? -core.half_height : core.half_height};
}

double least_width(const ConvexCore& core) {
  if (core.dimension() < 3)
    return 0;
  double least = std::numeric_limits<double>::max();
  const auto ask = [&](const Vector3d& direction) {
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const Vector3d& v : core.vertices) {
      const double along = v.dot(direction);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    least = std::min(least, high - low);
  };
  for (const CoreFace& face : core.faces)
    ask(face.normal);
  // The least width is that of two faces, of a face and a vertex, or of two edges.
  constexpr double parallel = 1e-6;
  std::vector<Vector3d> along;
  for (const CoreEdge& edge : core.edges)
    along.push_back((core.vertices[edge.to] - core.vertices[edge.from]).normalized());
  for (std::size_t i = 0; i < along.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3d across = along[i].cross(along[j]);
      if (across.norm() > parallel)
        ask(across.normalized());
    }
  return least;
}

} // namespace eccentra::shape
