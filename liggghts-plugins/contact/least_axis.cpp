// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Separating axes: faces first, then pairs of edges.
#include "contact/least_axis.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// Sines of angles between edges below this give no direction.
constexpr double parallel = 1e-6;
/// An axis across two edges has to be better by so much of the size: faces' normals hold steadier.
constexpr double clearly = 1e-9;

/// Collects the best axis.
class Best {
 public:
  Best(const PosedCore& a, const PosedCore& b, const Vector3d& offset) : a_(a), b_(b), offset_(offset) {
    margin_ = clearly * (a.core->bound + b.core->bound);
  }
  SeparatingAxis best{-std::numeric_limits<double>::max(), Vector3d::UnitX()};

  void ask(const Vector3d& normal, double margin = 0) {
    const double s = separation_along(a_, b_, offset_, normal);
    if (s > best.separation + margin)
      best = {s, normal};
  }
  /// Either way round: the one that leads from B's centre to A's.
  void ask_line(const Vector3d& direction, double margin = 0) {
    ask(direction.dot(offset_) > 0 ? Vector3d(-direction) : direction, margin);
  }
  void ask_across(const Vector3d& u, const Vector3d& v) {
    const Vector3d n = u.cross(v);
    const double length = n.norm();
    if (length > parallel)
      ask_line(n / length, margin_);
  }
  /// Along the part of `to` across the axis.
  void ask_radial(const Vector3d& axis, const Vector3d& to) {
    const Vector3d radial = to - to.dot(axis) * axis;
    const double length = radial.norm();
    if (length > parallel * margin_)
      ask_line(radial / length);
  }
  /// The normals of faces; `sign` -1 for A's, whose outward normals lead to B.
  void ask_faces(const PosedCore& of, double sign, const Vector3d& to_other) {
    const ContactCore& core = *of.core;
    if (core.solid == SolidKind::box) {
      for (int k = 0; k < 3; ++k)
        ask_line(of.rotation.col(k));
    } else if (core.is_disk()) {
      ask_line(of.rotation.col(2));
      ask_radial(of.rotation.col(2), to_other);
    } else {
      for (const shape::CoreFace& face : core.polyhedron.faces)
        ask(sign * (of.rotation * face.normal));
      if (core.polyhedron.dimension() == 1)
        ask_radial(edge_of(of, 0), to_other);
    }
    if (core.solid == SolidKind::none || core.solid == SolidKind::flat)
      if (const double length = to_other.norm(); length > 0)
        ask_line(to_other / length);
  }
  static Vector3d edge_of(const PosedCore& of, int k) {
    const auto& e = of.core->edges[k];
    return (of.point(e[1]) - of.point(e[0])).normalized();
  }

 private:
  const PosedCore &a_, &b_;
  const Vector3d& offset_;
  double margin_;
};

/// Directions of the edges: three of a box, its axis of a disk.
std::vector<Vector3d> edge_directions(const PosedCore& of) {
  std::vector<Vector3d> directions;
  const ContactCore& core = *of.core;
  if (core.solid == SolidKind::box)
    for (int k = 0; k < 3; ++k)
      directions.push_back(of.rotation.col(k));
  else if (core.is_disk())
    directions.push_back(of.rotation.col(2));
  else
    for (std::size_t k = 0; k < core.edges.size(); ++k)
      directions.push_back(Best::edge_of(of, static_cast<int>(k)));
  return directions;
}

/// Outward normals of the faces at an edge.
std::array<Vector3d, 2> normals_at(const PosedCore& of, int edge) {
  const shape::ConvexCore& core = of.core->polyhedron;
  return {of.rotation * core.faces[core.edges[edge].left].normal,
          of.rotation * core.faces[core.edges[edge].right].normal};
}

/// Whether the arcs of two edges' normals cross on the unit sphere (B's turned round): only then is there a face of
/// the two bodies' difference across both.
bool arcs_cross(const std::array<Vector3d, 2>& a, const std::array<Vector3d, 2>& b) {
  const Vector3d c = -b[0], d = -b[1], ab = a[1].cross(a[0]), cd = d.cross(c);
  const double ca = c.dot(ab), da = d.dot(ab), ac = a[0].dot(cd), bc = a[1].dot(cd);
  return ca * da < 0 && ac * bc < 0 && ca * bc > 0;
}

} // namespace

double separation_along(const PosedCore& a, const PosedCore& b, const Vector3d& offset, const Vector3d& normal) {
  return -a.reach_along(-normal) - normal.dot(offset) - b.reach_along(normal);
}

BoxesApart::BoxesApart(const PosedCore& a, const PosedCore& b, const Vector3d& offset)
    : a_(a), b_(b), to_b_(a.rotation.transpose() * offset), to_b_in_b_(b.rotation.transpose() * offset) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      cosine_[i][j] = a.rotation.col(i).dot(b.rotation.col(j));
      size_[i][j] = std::abs(cosine_[i][j]);
    }
  const Vector3d &half_a = a.core->half, &half_b = b.core->half;
  double best = -std::numeric_limits<double>::max();
  for (int k = 0; k < 3; ++k) {
    const double s =
        std::abs(to_b_[k]) - half_a[k] - (size_[k][0] * half_b[0] + size_[k][1] * half_b[1] + size_[k][2] * half_b[2]);
    if (s > best) {
      best = s;
      axis_ = k;
    }
  }
  for (int k = 0; k < 3; ++k) {
    const double s = std::abs(to_b_in_b_[k]) - half_b[k] -
                     (size_[0][k] * half_a[0] + size_[1][k] * half_a[1] + size_[2][k] * half_a[2]);
    if (s > best) {
      best = s;
      axis_ = 3 + k;
    }
  }
  separation_ = best;
}

void BoxesApart::ask_edges() {
  const Vector3d &half_a = a_.core->half, &half_b = b_.core->half;
  const double margin = clearly * (a_.core->bound + b_.core->bound);
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double square = cosine_[i1][j] * cosine_[i1][j] + cosine_[i2][j] * cosine_[i2][j];
      if (!(square > parallel * parallel))
        continue;
      const double apart = std::abs(to_b_[i2] * cosine_[i1][j] - to_b_[i1] * cosine_[i2][j]);
      const double reach =
          half_a[i1] * size_[i2][j] + half_a[i2] * size_[i1][j] + half_b[j1] * size_[i][j2] + half_b[j2] * size_[i][j1];
      const double s = (apart - reach) / std::sqrt(square);
      if (s > separation_ + margin) {
        separation_ = s;
        axis_ = 6 + 3 * i + j;
      }
    }
  }
}

Vector3d BoxesApart::normal() const {
  Vector3d n;
  if (axis_ < 3)
    n = a_.rotation.col(axis_);
  else if (axis_ < 6)
    n = b_.rotation.col(axis_ - 3);
  else
    n = Vector3d(a_.rotation.col((axis_ - 6) / 3)).cross(Vector3d(b_.rotation.col((axis_ - 6) % 3))).normalized();
  return n.dot(a_.rotation * to_b_) > 0 ? Vector3d(-n) : n;
}

SeparatingAxis best_face_axis(const PosedCore& a, const PosedCore& b, const Vector3d& offset) {
  Best best(a, b, offset);
  best.ask_faces(a, -1, offset);
  best.ask_faces(b, 1, offset);
  return best.best;
}

SeparatingAxis least_axis(const PosedCore& a, const PosedCore& b, const Vector3d& offset) {
  if (a.core->solid == SolidKind::box && b.core->solid == SolidKind::box) {
    BoxesApart boxes(a, b, offset);
    boxes.ask_edges();
    return {boxes.separation(), boxes.normal()};
  }
  Best best(a, b, offset);
  best.ask_faces(a, -1, offset);
  best.ask_faces(b, 1, offset);
  if (a.core->solid == SolidKind::polyhedron && b.core->solid == SolidKind::polyhedron) {
    for (std::size_t i = 0; i < a.core->edges.size(); ++i) {
      const auto normals = normals_at(a, static_cast<int>(i));
      for (std::size_t j = 0; j < b.core->edges.size(); ++j)
        if (arcs_cross(normals, normals_at(b, static_cast<int>(j))))
          best.ask_across(Best::edge_of(a, static_cast<int>(i)), Best::edge_of(b, static_cast<int>(j)));
    }
    return best.best;
  }
  const std::vector<Vector3d> of_b = edge_directions(b);
  for (const Vector3d& u : edge_directions(a))
    for (const Vector3d& v : of_b)
      best.ask_across(u, v);
  return best.best;
}

} // namespace eccentra::contact
