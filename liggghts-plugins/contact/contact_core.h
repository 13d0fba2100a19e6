// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What contacts need of a body's core: points, lines and a solid, laid out for vector loops, and posed in the world.
#pragma once

#include "contact/mesh_triangle.h"
#include "shape/rounded_hull.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace eccentra::contact {

/// Lanes of the vector loops; arrays are padded to whole multiples.
constexpr int lane_width = 8;

/// How the distance of a point from a core is found. `none`: the body is its points, each with a radius of its own.
enum class SolidKind { none, box, polyhedron, flat, disk, surface };

/// Features have one numbering per body, of which contacts make their ids: points first (vertices, points on rims,
/// sub-spheres), then lines (straight edges, or the arcs between points on rims and the axis of a disk), then the
/// solid.
struct ContactCore {
  /// A ball about the centre, of radius 0: a plain sphere, whose atom has the radius.
  ContactCore();
  /// Core of a rounded body, in its body frame.
  explicit ContactCore(const shape::RoundedHull& hull);
  /// Any convex core; a triangle of a mesh is a polygon with radius 0.
  ContactCore(const shape::ConvexCore& core, double radius);
  /// A union of spheres.
  ContactCore(const std::vector<Eigen::Vector3d>& centres, const std::vector<double>& radii);
  /// A surface of triangles, of radius 0, seen from either side: their corners, each once, and the active edges.
  explicit ContactCore(const std::vector<MeshTriangle>& triangles);

  SolidKind solid = SolidKind::none; ///< form of the core
  double radius = 0;                 ///< of the rounding [m]; with `none` the largest of the points'
  double contact_radius = 0;         ///< in Hertz's law [m]
  double bound = 0;                  ///< of the core with its rounding, about the centre [m]

  int points = 0;                        ///< number of points
  std::vector<double> x, y, z;           ///< of the points, body frame, padded with the last
  std::vector<double> point_radius;      ///< with `none`
  std::vector<std::array<int, 2>> edges; ///< pairs of points
  Eigen::Vector3d half = {0, 0, 0};      ///< of a box, its half edges; of a disk, its radius twice and its half height
  shape::ConvexCore polyhedron;          ///< of polyhedra and flat cores
  std::vector<MeshTriangle> surface;     ///< of surfaces
  std::vector<TriangleExtent> extents;   ///< of the triangles of a surface
  int ring = 0;                          ///< points on each rim of a disk
  int rims = 0;                          ///< of a disk: 1 or 2

  /// Rims, faces and side are those of a flat cylinder.
  bool is_disk() const { return solid == SolidKind::disk; }
  /// Number of arcs on all rims.
  int arcs() const { return ring * rims; }
  bool has_axis() const { return rims == 2; } ///< a disk whose side is a surface of its own
  /// Number of line features.
  int lines() const { return is_disk() ? arcs() + has_axis() : static_cast<int>(edges.size()); }
  /// Number of a line among the features.
  int line_feature(int line) const { return points + line; }
  /// Number of a disk's axis among the features.
  int axis_feature() const { return points + arcs(); }
  /// Number of the solid among the features.
  int solid_feature() const { return points + lines(); }
  /// Length of the arrays of points, with their padding.
  int padded() const { return static_cast<int>(x.size()); }

 private:
  void set_points(const std::vector<Eigen::Vector3d>& centres);
  void set_polyhedron(const shape::ConvexCore& core);
  void set_disk(const shape::RoundedHull& hull);
};

/// A core where its body is in a step: points in world axes about the body's centre.
struct PosedCore {
  const ContactCore* core = nullptr;                      ///< in the body frame
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< body to world
  std::vector<double> x, y, z;                            ///< of the points [m]

  /// Turns `of` by `turn`, body to world.
  void pose(const ContactCore& of, const Eigen::Matrix3d& turn);
  /// Point `k` [m].
  Eigen::Vector3d point(int k) const { return {x[k], y[k], z[k]}; }
  /// Greatest `direction` . x over the core.
  double reach_along(const Eigen::Vector3d& direction) const;
  /// A point of the core that reaches furthest along `direction` [m].
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
};

/// Distance of `point` (world axes, from the body's centre) from the core, and the normal there, from core to point.
/// Inside, minus the depth under the nearest face.
shape::CoreDistance distance_to(const PosedCore& posed, const Eigen::Vector3d& point);

/// The same of a polyhedron, a flat core or a surface, in the body frame.
shape::CoreDistance distance_to_faces(const ContactCore& core, const Eigen::Vector3d& point);

/// Features of A and B as one number, ascending first in A's.
constexpr int feature_id(int a, int b) {
  return a << 16 | b;
}
/// A's feature in an id.
inline int feature_a(int id) {
  return id >> 16;
}
/// B's feature in an id.
inline int feature_b(int id) {
  return id & 0xffff;
}

} // namespace eccentra::contact
