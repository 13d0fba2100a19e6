// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The search, from coarse to fine: bounding spheres, faces' axes, edges' axes, depths behind support planes, distances.
#include "contact/feature_search.h"

#include "contact/least_axis.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// Greatest radius of a body's points, with what is added to it.
double rounding_of(const ContactBody& body) {
  return body.posed->core->radius + body.extra;
}

/// Depths of the points behind the plane that supports the core on the side of `direction`, at `reach` along it.
void depths(const PosedCore& posed, const Vector3d& direction, std::vector<double>& depth) {
  const int n = posed.core->padded();
  depth.resize(n);
  const double *x = posed.x.data(), *y = posed.y.data(), *z = posed.z.data(), reach = posed.reach_along(direction);
  const double u = direction.x(), v = direction.y(), w = direction.z();
  double* d = depth.data();
#pragma GCC ivdep
  for (int k = 0; k < n; ++k)
    d[k] = reach - (u * x[k] + v * y[k] + w * z[k]);
}

/// Whether two segments a + s u and b + t v, s and t in [0, 1], are closer than `limit`.
bool segments_closer(const Vector3d& a, const Vector3d& u, const Vector3d& b, const Vector3d& v, double limit) {
  const Vector3d r = a - b;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ur = u.dot(r), vr = v.dot(r),
               det = uu * vv - uv * uv;
  double s = det > 1e-9 * uu * vv ? std::clamp((uv * vr - ur * vv) / det, 0., 1.) : 0.5;
  double t = (uv * s + vr) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0., 1.);
    s = std::clamp((uv * t - ur) / uu, 0., 1.);
  }
  return (r + s * u - t * v).squaredNorm() < limit * limit;
}

/// Whether two edges that are near each other may come to touch in the inside of both.
bool may_cross(const Vector3d& a, const Vector3d& u, const Vector3d& b, const Vector3d& v, double skin) {
  const Vector3d r = a - b;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ur = u.dot(r), vr = v.dot(r),
               det = uu * vv - uv * uv;
  constexpr double nearly_parallel = 0.01; // squared sine: closest points run fast
  const double sine2 = det / (uu * vv);
  if (sine2 <= nearly_parallel)
    return true;
  // An end that is closest by far stays so: the vertex has that contact.
  const double su = (uv * vr - ur * vv) / det, tu = (uu * vr - uv * ur) / det, margin = 4 * skin / sine2;
  const double lu = std::sqrt(uu), lv = std::sqrt(vv);
  return su * lu >= -margin && (su - 1) * lu <= margin && tu * lv >= -margin && (tu - 1) * lv <= margin;
}

/// An edge, or the axis of a disk, relative to its body's centre.
struct CoreLine {
  Vector3d from, along;
};
CoreLine core_line(const PosedCore& posed, int line) {
  const ContactCore& core = *posed.core;
  if (core.is_disk())
    return {-core.half.z() * posed.rotation.col(2), 2 * core.half.z() * posed.rotation.col(2)};
  const auto& edge = core.edges[line];
  const Vector3d from = posed.point(edge[0]);
  return {from, posed.point(edge[1]) - from};
}

} // namespace

double FeatureSearch::search(const BodyPair& pair, double skin) {
  found_.clear();
  const PosedCore &a = *pair.a.posed, &b = *pair.b.posed;
  const double room = pair.offset.norm() - (a.core->bound + pair.a.extra) - (b.core->bound + pair.b.extra);
  if (room >= skin)
    return room;
  const double reach = rounding_of(pair.a) + rounding_of(pair.b), limit = reach + skin;
  const bool solids = a.core->solid != SolidKind::none && b.core->solid != SolidKind::none;
  double budget = std::numeric_limits<double>::max();
  if (solids) {
    SeparatingAxis axis;
    if (a.core->solid == SolidKind::box && b.core->solid == SolidKind::box) {
      BoxesApart boxes(a, b, pair.offset);
      if (boxes.separation() < limit)
        boxes.ask_edges();
      if (boxes.separation() >= limit)
        return boxes.separation() - reach;
      axis = {boxes.separation(), boxes.normal()};
    } else {
      axis = best_face_axis(a, b, pair.offset);
      if (axis.separation < skin) // the axes across edges of other polyhedra are too many
        axis = least_axis(a, b, pair.offset);
    }
    if (axis.separation >= limit)
      return axis.separation - reach;
    if (axis.separation < skin)
      found_.push_back(feature_id(a.core->solid_feature(), b.core->solid_feature()));
    // Along an axis points within `limit` of each other lie together no deeper behind the support planes than
    // limit - separation: few features remain.
    budget = limit - axis.separation;
    depths(a, -axis.normal, depth_a_);
    depths(b, axis.normal, depth_b_);
  }
  if (!solids && a.core->solid == b.core->solid) {
    for (int i = 0; i < a.core->points; ++i)
      for (int j = 0; j < b.core->points; ++j) {
        const double touch = a.core->point_radius[i] + pair.a.extra + b.core->point_radius[j] + pair.b.extra + skin;
        if ((a.point(i) - b.point(j) - pair.offset).squaredNorm() < touch * touch)
          found_.push_back(feature_id(i, j));
      }
    return skin;
  }
  if (solids)
    find_edges(pair, limit, skin, budget);
  for (const bool of_b : {false, true}) {
    if ((of_b ? a : b).core->solid == SolidKind::none)
      continue;
    if (solids && (of_b ? b : a).core->is_disk())
      find_rims(pair, of_b, limit);
    else
      find_points(pair, of_b, skin, solids ? (of_b ? depth_b_ : depth_a_).data() : nullptr, budget);
  }
  std::sort(found_.begin(), found_.end());
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  return skin;
}

void FeatureSearch::find_points(const BodyPair& pair, bool of_b, double skin, const double* depth, double budget) {
  const ContactBody &own = of_b ? pair.b : pair.a, &solid = of_b ? pair.a : pair.b;
  const ContactCore& core = *own.posed->core;
  const Vector3d shift = of_b ? pair.offset : Vector3d(-pair.offset);
  const int other = solid.posed->core->solid_feature();
  const double outer = solid.posed->core->bound + solid.extra;
  for (int k = 0; k < core.points; ++k) {
    if (depth && depth[k] > budget)
      continue;
    const double radius = (core.solid == SolidKind::none ? core.point_radius[k] : core.radius) + own.extra;
    const Vector3d p = own.posed->point(k) + shift;
    if (!depth && p.norm() - radius - outer > skin)
      continue;
    if (distance_to(*solid.posed, p).distance < radius + rounding_of(solid) + skin)
      found_.push_back(of_b ? feature_id(other, k) : feature_id(k, other));
  }
}

void FeatureSearch::find_edges(const BodyPair& pair, double limit, double skin, double budget) {
  const PosedCore &a = *pair.a.posed, &b = *pair.b.posed;
  const bool axis_a = a.core->is_disk(), axis_b = b.core->is_disk();
  // A disk's side: its axis with each edge, or with the other's axis.
  if ((axis_a && !a.core->has_axis()) || (axis_b && !b.core->has_axis()))
    return;
  if (axis_a || axis_b) {
    const int count_a = axis_a ? 1 : static_cast<int>(a.core->edges.size()),
              count_b = axis_b ? 1 : static_cast<int>(b.core->edges.size());
    const double far = limit + (axis_a ? a.core->half.x() : 0) + (axis_b ? b.core->half.x() : 0);
    for (int i = 0; i < count_a; ++i) {
      const CoreLine la = core_line(a, i);
      for (int j = 0; j < count_b; ++j) {
        const CoreLine lb = core_line(b, j);
        if (segments_closer(la.from, la.along, pair.offset + lb.from, lb.along, far))
          found_.push_back(feature_id(axis_a ? a.core->axis_feature() : a.core->line_feature(i),
                                      axis_b ? b.core->axis_feature() : b.core->line_feature(j)));
      }
    }
    return;
  }
  const auto depth_of = [](const std::vector<double>& depth, const std::array<int, 2>& edge) {
    return std::min(depth[edge[0]], depth[edge[1]]);
  };
  edge_of_.clear();
  const int all = static_cast<int>(b.core->edges.size());
  edges_.reserve(all);
  for (int j = 0; j < all; ++j) {
    const auto& edge = b.core->edges[j];
    const double depth = depth_of(depth_b_, edge);
    if (depth > budget)
      continue;
    const int n = static_cast<int>(edge_of_.size());
    const Vector3d from = pair.offset + b.point(edge[0]), along = b.point(edge[1]) - b.point(edge[0]);
    for (int d = 0; d < 3; ++d) {
      edges_.row(fx + d)[n] = from[d];
      edges_.row(ux + d)[n] = along[d];
    }
    edges_.row(square)[n] = along.squaredNorm();
    edges_.row(behind)[n] = depth;
    edge_of_.push_back(j);
  }
  const int count = static_cast<int>(edge_of_.size());
  for (std::size_t i = 0; i < a.core->edges.size() && count > 0; ++i) {
    const auto& edge_a = a.core->edges[i];
    const double left = budget - depth_of(depth_a_, edge_a);
    if (left < 0)
      continue;
    const Vector3d from = a.point(edge_a[0]), along = a.point(edge_a[1]) - from;
    measure_edges(from, along, count);
    for (int n = 0; n < count; ++n) {
      if (edges_.row(behind)[n] > left || edges_.row(apart)[n] >= limit * limit)
        continue;
      const Vector3d from_b(edges_.row(fx)[n], edges_.row(fy)[n], edges_.row(fz)[n]),
          along_b(edges_.row(ux)[n], edges_.row(uy)[n], edges_.row(uz)[n]);
      if (may_cross(from, along, from_b, along_b, skin))
        found_.push_back(feature_id(a.core->line_feature(static_cast<int>(i)), b.core->line_feature(edge_of_[n])));
    }
  }
}

/// The squared distances of edges of B from the segment a + s u.
void FeatureSearch::measure_edges(const Vector3d& a, const Vector3d& u, int count) {
  const double a0 = a.x(), a1 = a.y(), a2 = a.z(), u0 = u.x(), u1 = u.y(), u2 = u.z(), uu = u.squaredNorm();
  const double *b0 = edges_.row(fx), *b1 = edges_.row(fy), *b2 = edges_.row(fz), *v0 = edges_.row(ux),
               *v1 = edges_.row(uy), *v2 = edges_.row(uz), *squares = edges_.row(square);
  double* found = edges_.row(apart);
  const int padded = (count + lane_width - 1) / lane_width * lane_width;
#pragma GCC ivdep
  for (int n = 0; n < padded; ++n) {
    const double r0 = a0 - b0[n], r1 = a1 - b1[n], r2 = a2 - b2[n], vv = squares[n];
    const double uv = u0 * v0[n] + u1 * v1[n] + u2 * v2[n], ur = u0 * r0 + u1 * r1 + u2 * r2,
                 vr = v0[n] * r0 + v1[n] * r1 + v2[n] * r2, det = uu * vv - uv * uv;
    const bool skew = det > 1e-9 * uu * vv;
    const double across = (uv * vr - ur * vv) / (skew ? det : 1.);
    double s = skew ? (across < 0 ? 0. : across > 1 ? 1. : across) : 0.5;
    const double along = (uv * s + vr) / vv, t = along < 0 ? 0. : along > 1 ? 1. : along;
    const double back = (uv * t - ur) / uu, clamped = back < 0 ? 0. : back > 1 ? 1. : back;
    s = t == along ? s : clamped;
    const double d0 = r0 + s * u0 - t * v0[n], d1 = r1 + s * u1 - t * v1[n], d2 = r2 + s * u2 - t * v2[n];
    found[n] = d0 * d0 + d1 * d1 + d2 * d2;
  }
}

void FeatureSearch::find_rims(const BodyPair& pair, bool of_b, double limit) {
  const ContactBody &own = of_b ? pair.b : pair.a, &solid = of_b ? pair.a : pair.b;
  const ContactCore &core = *own.posed->core, &of_solid = *solid.posed->core;
  constexpr int ring = shape::points_on_rim;
  const int other = of_solid.solid_feature();
  const Vector3d to_disk = of_b ? pair.offset : Vector3d(-pair.offset);
  const auto note = [&](int feature) {
    found_.push_back(of_b ? feature_id(other, feature) : feature_id(feature, other));
  };
  for (int number = 0; number < core.rims; ++number) {
    const RimOnSolid rim(*own.posed, number, *solid.posed, to_disk);
    rims_.count = 0;
    for (int k = 0; k < ring; ++k)
      rims_.add(rim, k);
    if (of_solid.is_disk())
      rims_.on_disks();
    else if (of_solid.solid == SolidKind::box)
      rims_.on_boxes();
    else
      rims_.on_polyhedra(std::vector<const ContactCore*>(ring, &of_solid));
    bool listed[ring] = {};
    for (int k = 0; k < ring; ++k) {
      const int next = (k + 1) % ring;
      listed[k] |= rims_.at(RimLanes::distance, k) < limit;
      if (rim.least_between(rims_.end(k), rims_.end(next)) >= limit)
        continue;
      note(core.line_feature(number * ring + k));
      listed[k] = listed[next] = true;
    }
    for (int k = 0; k < ring; ++k)
      if (listed[k])
        note(number * ring + k);
  }
}

} // namespace eccentra::contact
