// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Moments of rounded bodies, piece by piece.
#include "shape/rounded_moments.h"

#include <Eigen/Geometry>

#include <cmath>

namespace eccentra::shape {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Integrals of 1, x and x x^T.
struct Moments {
  double zeroth = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
};

Matrix3d twice_symmetric(const Vector3d& a, const Vector3d& b) {
  return a * b.transpose() + b * a.transpose();
}

/// Of a face.
Moments over_face(const ConvexCore& core, const CoreFace& face) {
  Moments m;
  const Vector3d& a = core.vertices[face.corners[0]];
  for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
    const Vector3d &b = core.vertices[face.corners[k]], &c = core.vertices[face.corners[k + 1]];
    const double area = (b - a).cross(c - a).norm() / 2;
    const Vector3d sum = a + b + c;
    m.zeroth += area;
    m.first += area / 3 * sum;
    m.second += area / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  return m;
}

/// Of the pyramid between a face and the origin.
void add_pyramid(const ConvexCore& core, const CoreFace& face, Moments& sum) {
  const Vector3d& a = core.vertices[face.corners[0]];
  for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
    const Vector3d &b = core.vertices[face.corners[k]], &c = core.vertices[face.corners[k + 1]];
    const double volume = a.cross(b).dot(c) / 6;
    const Vector3d total = a + b + c;
    sum.zeroth += volume;
    sum.first += volume / 4 * total;
    sum.second += volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + total * total.transpose());
  }
}

void add_prism(const ConvexCore& core, const CoreFace& face, double r, Moments& sum) {
  const Moments m = over_face(core, face);
  const Vector3d& n = face.normal;
  sum.zeroth += r * m.zeroth;
  sum.first += r * m.first + r * r / 2 * m.zeroth * n;
  sum.second += r * m.second + r * r / 2 * twice_symmetric(m.first, n) + r * r * r / 3 * m.zeroth * n * n.transpose();
}

/// What an edge and its two ends share: the arc of its normals on the unit sphere.
struct EdgeArc {
  Vector3d along; ///< unit vector of the edge
  double angle;   ///< [rad]
  Vector3d first; ///< integral of the normal over the angle
  Matrix3d second;
};

EdgeArc arc_of(const ConvexCore& core, const CoreEdge& edge) {
  EdgeArc arc;
  arc.along = (core.vertices[edge.to] - core.vertices[edge.from]).normalized();
  arc.angle = core.turn(edge);
  const Vector3d n = edge.left < 0 ? arc.along.unitOrthogonal() : core.faces[edge.left].normal;
  const Vector3d m = arc.along.cross(n);
  const double t = arc.angle, s = edge.left < 0 ? 0 : std::sin(t), c = edge.left < 0 ? 1 : std::cos(t);
  arc.first = s * n + (1 - c) * m;
  arc.second =
      (t + s * c) / 2 * n * n.transpose() + (t - s * c) / 2 * m * m.transpose() + s * s / 2 * twice_symmetric(n, m);
  return arc;
}

void add_wedge(const ConvexCore& core, const CoreEdge& edge, const EdgeArc& arc, double r, Moments& sum) {
  const Vector3d &a = core.vertices[edge.from], &b = core.vertices[edge.to];
  const double length = (b - a).norm();
  const Vector3d line = length / 2 * (a + b);
  const Matrix3d square = length / 6 * (2 * a * a.transpose() + 2 * b * b.transpose() + twice_symmetric(a, b));
  sum.zeroth += r * r / 2 * arc.angle * length;
  sum.first += r * r / 2 * arc.angle * line + r * r * r / 3 * length * arc.first;
  sum.second += r * r / 2 * arc.angle * square + r * r * r / 3 * twice_symmetric(line, arc.first) +
                r * r * r * r / 4 * length * arc.second;
}

/// The normals of a vertex: a region on the unit sphere that the arcs of its edges bound.
struct Cone {
  double solid_angle = 2 * M_PI;
  Vector3d first = Vector3d::Zero();
  Matrix3d arcs = Matrix3d::Zero();
  /// Adds an arc whose edge leads away from the vertex along `away`. On the sphere the Laplacian of u is -2 u, and
  /// that of u u^T - I/3 is -6 of it, so that integrals over the region are sums over its boundary, where `away` is
  /// the outward normal.
  void add(const EdgeArc& arc, const Vector3d& away) {
    first -= arc.angle / 2 * away;
    arcs -= twice_symmetric(arc.first, away) / 6;
  }
};

void add_sector(const Vector3d& v, const Cone& cone, double r, Moments& sum) {
  const double r3 = r * r * r / 3, r4 = r * r * r * r / 4, r5 = r * r * r * r * r / 5;
  sum.zeroth += r3 * cone.solid_angle;
  sum.first += r3 * cone.solid_angle * v + r4 * cone.first;
  sum.second += r3 * cone.solid_angle * v * v.transpose() + r4 * twice_symmetric(v, cone.first) +
                r5 * (cone.solid_angle / 3 * Matrix3d::Identity() + cone.arcs);
}

MassProperties properties(const Moments& m, double surface, const Vector3d& origin) {
  const Vector3d centre = m.first / m.zeroth;
  const Matrix3d second = m.second / m.zeroth - centre * centre.transpose();
  return {m.zeroth, surface, origin + centre, second.trace() * Matrix3d::Identity() - second};
}

} // namespace

MassProperties rounded_mass(const ConvexCore& given, double radius) {
  ConvexCore core = given;
  Vector3d origin = Vector3d::Zero(); // amid the vertices, for the sake of the digits
  for (const Vector3d& v : core.vertices)
    origin += v / static_cast<double>(core.vertices.size());
  for (Vector3d& v : core.vertices)
    v -= origin;

  Moments sum;
  double surface = 4 * M_PI * radius * radius;
  std::vector<Cone> cones(core.vertices.size());
  if (core.dimension() == 0)
    cones[0].solid_angle = 4 * M_PI;
  for (const CoreFace& face : core.faces) {
    if (core.dimension() == 3)
      add_pyramid(core, face, sum);
    add_prism(core, face, radius, sum);
    surface += face.area;
    const std::size_t corners = face.corners.size();
    for (std::size_t k = 0; k < corners; ++k) {
      const Vector3d& v = core.vertices[face.corners[k]];
      const Vector3d before = core.vertices[face.corners[(k + corners - 1) % corners]] - v,
                     after = core.vertices[face.corners[(k + 1) % corners]] - v;
      cones[face.corners[k]].solid_angle -= std::atan2(after.cross(before).norm(), after.dot(before));
    }
  }
  for (const CoreEdge& edge : core.edges) {
    const EdgeArc arc = arc_of(core, edge);
    add_wedge(core, edge, arc, radius, sum);
    surface += radius * arc.angle * (core.vertices[edge.to] - core.vertices[edge.from]).norm();
    cones[edge.from].add(arc, arc.along);
    cones[edge.to].add(arc, -arc.along);
  }
  for (std::size_t k = 0; k < cones.size(); ++k)
    add_sector(core.vertices[k], cones[k], radius, sum);
  return properties(sum, surface, origin);
}

MassProperties rounded_mass(const DiskCore& core, double r) {
  const double c = core.radius, k = core.half_height, outer = c + r;
  const double r2 = r * r, r3 = r2 * r, r4 = r2 * r2, r5 = r4 * r, c2 = c * c;
  // Over the rounded part of height r, at t above the core, where the slice's radius is q = c + sqrt(r^2 - t^2):
  const double q2 = c2 * r + c * M_PI * r2 / 2 + 2 * r3 / 3;         // integral of q^2
  const double tq2 = c2 * r2 / 2 + 2 * c * r3 / 3 + r4 / 4;          // of t q^2
  const double t2q2 = c2 * r3 / 3 + c * M_PI * r4 / 8 + 2 * r5 / 15; // of t^2 q^2
  const double q4 = c2 * c2 * r + c2 * c * M_PI * r2 + 4 * c2 * r3 + 3 * M_PI / 4 * c * r4 + 8 * r5 / 15; // of q^4
  const double outer2 = outer * outer;
  Moments m;
  m.zeroth = 2 * M_PI * (k * outer2 + q2);
  const double across = M_PI / 2 * (k * outer2 * outer2 + q4),
               along = 2 * M_PI * (outer2 * k * k * k / 3 + k * k * q2 + 2 * k * tq2 + t2q2);
  m.second.diagonal() = Vector3d(across, across, along);
  const double surface = 2 * M_PI * c2 + 4 * M_PI * outer * k + 2 * M_PI * M_PI * r * c + 4 * M_PI * r2;
  return properties(m, surface, Vector3d::Zero());
}

} // namespace eccentra::shape
