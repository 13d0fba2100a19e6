// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// GJK with the sub-distances by regions (Ericson, Real-Time Collision Detection, 2005, section 5.1).
#include "contact/gjk.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// Points of the difference of two cores; closest() keeps those that the point closest to the origin needs.
class Simplex {
 public:
  int count = 0;
  Vector3d point[4];

  bool has(const Vector3d& p) const {
    for (int k = 0; k < count; ++k)
      if (point[k] == p)
        return true;
    return false;
  }
  void add(const Vector3d& p) { point[count++] = p; }

  Vector3d closest() {
    switch (count) {
    case 1:
      return point[0];
    case 2:
      return of_segment();
    case 3:
      return of_triangle(0, 1, 2);
    default:
      return of_tetrahedron();
    }
  }

 private:
  Vector3d keep(int i) {
    point[0] = Vector3d(point[i]);
    count = 1;
    return point[0];
  }
  Vector3d keep(int i, int j, double t) {
    const Vector3d a = point[i], b = point[j];
    point[0] = a;
    point[1] = b;
    count = 2;
    return a + t * (b - a);
  }
  Vector3d of_segment() {
    const Vector3d along = point[1] - point[0];
    const double t = -along.dot(point[0]), length = along.squaredNorm();
    return t <= 0 ? keep(0) : t >= length ? keep(1) : keep(0, 1, t / length);
  }
  Vector3d of_triangle(int i, int j, int k) {
    const Vector3d a = point[i], b = point[j], c = point[k], ab = b - a, ac = c - a;
    const double d1 = -ab.dot(a), d2 = -ac.dot(a);
    if (d1 <= 0 && d2 <= 0)
      return keep(i);
    const double d3 = -ab.dot(b), d4 = -ac.dot(b);
    if (d3 >= 0 && d4 <= d3)
      return keep(j);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
      return keep(i, j, d1 / (d1 - d3));
    const double d5 = -ab.dot(c), d6 = -ac.dot(c);
    if (d6 >= 0 && d5 <= d6)
      return keep(k);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
      return keep(i, k, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6)
      return keep(j, k, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    point[0] = a;
    point[1] = b;
    point[2] = c;
    count = 3;
    const Vector3d normal = ab.cross(ac); // an exact direction, where combining the points would cancel
    return normal.dot(a) / normal.squaredNorm() * normal;
  }
  Vector3d of_tetrahedron() {
    static constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};
    Simplex best;
    Vector3d result = Vector3d::Zero();
    double least = std::numeric_limits<double>::max();
    for (const auto& f : faces) {
      const Vector3d normal = (point[f[1]] - point[f[0]]).cross(point[f[2]] - point[f[0]]);
      if (-normal.dot(point[f[0]]) * normal.dot(point[f[3]] - point[f[0]]) > 0)
        continue; // the origin is on the inner side
      Simplex face = *this;
      const Vector3d p = face.of_triangle(f[0], f[1], f[2]);
      if (p.squaredNorm() < least) {
        least = p.squaredNorm();
        best = face;
        result = p;
      }
    }
    if (least < std::numeric_limits<double>::max())
      *this = best; // else the origin is inside: four points stay
    return result;
  }
};

/// Projections onto one core and the other in turn, which come to the closest points from anywhere: slow and sure, for
/// smooth rims whose simplices have become too flat.
double distance_by_projections(const PosedCore& a, const PosedCore& b, const Vector3d& offset, double size) {
  constexpr int limit = 20000;
  constexpr double precision = 1e-13;
  Vector3d on_b = offset;
  double before = std::numeric_limits<double>::max();
  for (int k = 0; k < limit; ++k) {
    const shape::CoreDistance to_a = distance_to(a, on_b);
    if (to_a.distance <= 0)
      return 0;
    const Vector3d on_a = on_b - to_a.distance * to_a.normal;
    const shape::CoreDistance to_b = distance_to(b, on_a - offset);
    if (to_b.distance <= 0)
      return 0;
    on_b = on_a - to_b.distance * to_b.normal;
    if (before - to_b.distance < precision * size)
      return to_b.distance;
    before = to_b.distance;
  }
  return before;
}

} // namespace

double gjk_distance(const PosedCore& a, const PosedCore& b, const Vector3d& offset) {
  constexpr int limit = 200; // polyhedra take 4 to 7, two smooth rims 20
  constexpr double tolerance = 1e-14, closed = 1e-9;
  const double size = a.core->bound + b.core->bound;
  Simplex simplex;
  Vector3d v = -offset;
  if (v.squaredNorm() == 0)
    v = Vector3d::UnitX();
  double best = std::numeric_limits<double>::max(), at_least = 0;
  for (int k = 0; k < limit; ++k) {
    const Vector3d w = a.support(-v) - b.support(v) - offset;
    if (simplex.count > 0)
      at_least =
          std::max(at_least, v.dot(w) / v.norm()); // the planes across v through both supports separate the cores
    if (simplex.count > 0 && (v.squaredNorm() - v.dot(w) <= tolerance * v.squaredNorm() || simplex.has(w)))
      break; // nothing is closer
    simplex.add(w);
    const Vector3d next = simplex.closest();
    const double square = next.squaredNorm();
    if (simplex.count == 4 || square <= tolerance * tolerance * size * size) {
      if (at_least > closed * size)
        break; // a plane separates them: the tetrahedron is too flat to tell
      return 0;
    }
    if (!(square < best))
      break; // round-off, or a simplex too flat for a closest point
    best = square;
    v = next;
  }
  const double distance = v.norm();
  if (distance - at_least < closed * size || a.core->solid == SolidKind::none || b.core->solid == SolidKind::none)
    return distance;
  return std::min(distance, distance_by_projections(a, b, offset, size));
}

} // namespace eccentra::contact
