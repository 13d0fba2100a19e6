// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From candidates to contacts: exact distances in lanes, then each pair's springs and their weights.
#include "contact/manifold.h"

#include "contact/arc_minimum.h"
#include "contact/gjk.h"
#include "contact/hand_over.h"
#include "contact/least_axis.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// A vertex whose distance from an edge is that from the solid, but for this part of the reach, has it as the closest.
constexpr double same_distance = 1e-9;
/// Edges closer than this part of their reach may have passed each other.
constexpr double may_have_crossed = 0.25;
/// Where an arc of a disk's rim is closest and farthest is told apart in pieces of this part of the reach, and in no
/// more than so many.
constexpr double resolved = 0.5;
constexpr int max_pieces = 8;
/// From cores that touch to this part of the reach deep, contacts turn to the least axis.
constexpr double turning_depth = 0.25;

double radius_of(const ContactBody& body, int feature) {
  const ContactCore& core = *body.posed->core;
  return (core.solid == SolidKind::none ? core.point_radius[feature] : core.radius) + body.extra;
}

/// Of the solid, or of a sub-sphere.
double radius_of_other(const ContactBody& body, int other) {
  return radius_of(body, body.posed->core->solid == SolidKind::none ? other : 0);
}

/// The ends of a line, relative to its body's centre: of an edge, or of a disk's axis.
struct Line {
  Vector3d from, along;
  double radius; ///< of the surface about it [m]
};
Line line_of(const PosedCore& posed, int line) {
  const ContactCore& core = *posed.core;
  if (core.is_disk())
    return {-core.half.z() * posed.rotation.col(2), 2 * core.half.z() * posed.rotation.col(2), core.half.x()};
  const auto& edge = core.edges[line];
  const Vector3d from = posed.point(edge[0]);
  return {from, posed.point(edge[1]) - from, 0};
}

} // namespace

void Manifolds::clear() {
  pairs_.clear();
  points_.clear();
  edges_.clear();
  lines_.clear();
  arcs_.clear();
  boxes_.count = edge_lanes_.count = 0;
  contacts_.clear();
  first_.clear();
  gap_.clear();
  sunk_.clear();
}

void Manifolds::add(const BodyPair& bodies, const int* candidates, int count) {
  Pair pair{bodies,
            static_cast<int>(points_.size()),
            static_cast<int>(edges_.size()),
            static_cast<int>(arcs_.size()),
            static_cast<int>(lines_.size()),
            0,
            0,
            0,
            0,
            false};
  const ContactCore &a = *bodies.a.posed->core, &b = *bodies.b.posed->core;
  for (int k = 0; k < count; ++k) {
    const int fa = feature_a(candidates[k]), fb = feature_b(candidates[k]);
    const bool point_a = fa < a.points, point_b = fb < b.points;
    if (fa == a.solid_feature() && fb == b.solid_feature() && !point_a) {
      pair.may_be_sunk = true;
    } else if (point_a) {
      add_point(bodies, fa, fb, false);
    } else if (point_b) {
      add_point(bodies, fb, fa, true);
    } else if (fb == b.solid_feature()) {
      arcs_.push_back({fa - a.points, false});
    } else if (fa == a.solid_feature()) {
      arcs_.push_back({fb - b.points, true});
    } else {
      const int line_a = fa - a.points, line_b = fb - b.points;
      const Line la = line_of(*bodies.a.posed, line_a), lb = line_of(*bodies.b.posed, line_b);
      (a.is_disk() || b.is_disk() ? lines_ : edges_).push_back({line_a, line_b, edge_lanes_.count});
      edge_lanes_.add(la.from, la.along, bodies.offset + lb.from, lb.along);
    }
  }
  pair.last_point = static_cast<int>(points_.size());
  pair.last_edge = static_cast<int>(edges_.size());
  pair.last_arc = static_cast<int>(arcs_.size());
  pair.last_line = static_cast<int>(lines_.size());
  pairs_.push_back(pair);
}

void Manifolds::add_point(const BodyPair& pair, int feature, int other, bool of_b) {
  const ContactBody &own = of_b ? pair.b : pair.a, &solid = of_b ? pair.a : pair.b;
  PointState p;
  p.feature = feature;
  p.other = other;
  p.of_b = of_b;
  p.lane = -1;
  p.point = own.posed->point(feature);
  if (of_b)
    p.point += pair.offset;
  p.reach = radius_of(own, feature) + radius_of_other(solid, other);
  const Vector3d from_solid = of_b ? p.point : Vector3d(p.point - pair.offset);
  const ContactCore& core = *solid.posed->core;
  if (core.solid == SolidKind::box) {
    p.lane = boxes_.count;
    boxes_.add(solid.posed->rotation.transpose() * from_solid, core.half);
  } else if (core.solid == SolidKind::none) {
    const Vector3d apart = from_solid - solid.posed->point(other);
    p.distance = apart.norm();
    p.normal = p.distance > 0 ? Vector3d(apart / p.distance) : Vector3d::UnitZ();
  } else {
    const shape::CoreDistance d = distance_to(*solid.posed, from_solid);
    p.distance = d.distance;
    p.normal = d.normal;
  }
  points_.push_back(p);
}

void Manifolds::evaluate() {
  boxes_.evaluate();
  edge_lanes_.evaluate();
  for (const Pair& pair : pairs_) {
    const int first = static_cast<int>(contacts_.size());
    first_.push_back(first);
    double gap = std::numeric_limits<double>::max();
    for (auto& rims : rim_contact_)
      rims[0] = rims[1] = -1;
    take_points(pair, gap);
    for (int k = pair.first_edge; k < pair.last_edge; ++k)
      take_edge(pair, edges_[k], gap);
    for (int k = pair.first_arc; k < pair.last_arc; ++k)
      take_arc(pair, arcs_[k], gap);
    for (int k = pair.first_line; k < pair.last_line; ++k)
      take_line(pair, lines_[k], gap);
    drop_weightless(first);
    sunk_.push_back(pair.may_be_sunk ? soften_sunk(pair.bodies, first) : 0);
    gap_.push_back(gap);
    // Few contacts, nearly in order.
    for (int k = first + 1; k < static_cast<int>(contacts_.size()); ++k)
      for (int j = k; j > first && contacts_[j].id < contacts_[j - 1].id; --j)
        std::swap(contacts_[j], contacts_[j - 1]);
  }
  first_.push_back(static_cast<int>(contacts_.size()));
}

void Manifolds::take_points(const Pair& pair, double& gap) {
  for (int k = pair.first_point; k < pair.last_point; ++k) {
    PointState& p = points_[k];
    if (p.lane >= 0) {
      p.distance = boxes_.at(BoxLanes::distance, p.lane);
      if (p.distance < p.reach)
        p.normal = (p.of_b ? pair.bodies.a : pair.bodies.b).posed->rotation * boxes_.normal(p.lane);
    }
    gap = std::min(gap, p.distance - p.reach);
    if (p.distance >= p.reach)
      continue;
    p.contact = static_cast<int>(contacts_.size());
    const Vector3d arm = p.of_b ? Vector3d(p.point - p.distance * p.normal) : p.point;
    const ContactCore& own = *(p.of_b ? pair.bodies.b : pair.bodies.a).posed->core;
    const double radius_own = radius_of(p.of_b ? pair.bodies.b : pair.bodies.a, p.feature);
    contacts_.push_back({p.of_b ? feature_id(p.other, p.feature) : feature_id(p.feature, p.other), false, arm,
                         p.of_b ? Vector3d(-p.normal) : p.normal, p.distance, p.reach,
                         p.of_b ? p.reach - radius_own : radius_own, 1});
    if (own.is_disk()) {
      int& best = rim_contact_[p.of_b][p.feature / own.ring];
      if (best < 0 || p.distance < contacts_[best].distance)
        best = p.contact;
    }
  }
}

/// The contact of a point that touches the other's solid, or -1.
int Manifolds::contact_of(const Pair& pair, int feature, bool of_b) const {
  for (int k = pair.first_point; k < pair.last_point; ++k)
    if (points_[k].feature == feature && points_[k].of_b == of_b)
      return points_[k].contact;
  return -1;
}

void Manifolds::take_edge(const Pair& pair, const EdgePair& edge, double& gap) {
  const EdgeLanes& e = edge_lanes_;
  const int lane = edge.lane;
  const double square = e.at(EdgeLanes::square, lane);
  if (square < 0)
    return; // an end is closest, and bounds the gap
  const ContactBody &a = pair.bodies.a, &b = pair.bodies.b;
  const double radius_a = radius_of(a, 0), reach = radius_a + radius_of(b, 0);
  double distance = std::sqrt(square);
  gap = std::min(gap, distance - reach);
  if (distance >= reach)
    return;
  const Vector3d from_a = e.vector(EdgeLanes::ax, lane), along_a = e.vector(EdgeLanes::ux, lane);
  const Vector3d from_b = e.vector(EdgeLanes::bx, lane), along_b = e.vector(EdgeLanes::vx, lane);
  const Vector3d on_a = from_a + e.at(EdgeLanes::s, lane) * along_a;
  const Vector3d apart = on_a - (from_b + e.at(EdgeLanes::t, lane) * along_b);
  const double length_apart = apart.norm();
  Vector3d normal = length_apart > 0 ? Vector3d(apart / length_apart) : Vector3d(along_a.cross(along_b).normalized());
  // Edges that have passed each other: the normal still leads out of B and into A, from whose centres the edges stand
  // out.
  if (distance < may_have_crossed * reach && normal.dot(from_b + along_b / 2 - pair.bodies.offset) < 0 &&
      normal.dot(from_a + along_a / 2) > 0) {
    normal = -normal;
    distance = -distance;
  }
  const double overlap = reach - distance;
  const auto& ends_a = a.posed->core->edges[edge.line_a];
  const auto& ends_b = b.posed->core->edges[edge.line_b];
  const int feature_line_a = a.posed->core->line_feature(edge.line_a),
            feature_line_b = b.posed->core->line_feature(edge.line_b);
  const int ends[4] = {ends_a[0], ends_a[1], ends_b[0], ends_b[1]};
  double end_distance[4], end_overlap[4];
  for (int k = 0; k < 4; ++k) {
    end_distance[k] = std::sqrt(e.at(EdgeLanes::end0 + k, lane));
    end_overlap[k] = reach - end_distance[k];
  }
  const HandOver<4> share(overlap, end_overlap);
  for (int k = 0; k < 4; ++k) {
    if (share.loss[k] < no_weight)
      continue;
    // An end in reach of the edge is in reach of the solid. Where that edge is what the solid has closest to the
    // vertex, the vertex's own contact loses the weight.
    const bool of_a = k < 2;
    const int own = contact_of(pair, ends[k], !of_a);
    if (own >= 0 && contacts_[own].distance > end_distance[k] - same_distance * reach) {
      contacts_[own].weight -= share.loss[k];
      continue;
    }
    const Vector3d end =
        of_a ? Vector3d(from_a + (k == 1 ? 1 : 0) * along_a) : Vector3d(from_b + (k == 3 ? 1 : 0) * along_b);
    const double where = e.at(EdgeLanes::at0 + k, lane);
    const Vector3d on = of_a ? Vector3d(from_b + where * along_b) : Vector3d(from_a + where * along_a);
    const Vector3d out = of_a ? Vector3d(end - on) : Vector3d(on - end);
    const double length = out.norm();
    contacts_.push_back({of_a ? feature_id(ends[k], feature_line_b) : feature_id(feature_line_a, ends[k]), true,
                         of_a ? end : on, length > 0 ? Vector3d(out / length) : normal, end_distance[k], reach,
                         radius_a, -share.loss[k]});
  }
  const double weight = share.line;
  if (weight > no_weight)
    contacts_.push_back(
        {feature_id(feature_line_a, feature_line_b), false, on_a, normal, distance, reach, radius_a, weight});
}

/// The state of a point on a rim, asked for if it is no candidate.
Manifolds::PointState& Manifolds::state_of(const Pair& pair, int feature, bool of_b) {
  for (int k = pair.first_point; k < pair.last_point; ++k)
    if (points_[k].feature == feature && points_[k].of_b == of_b)
      return points_[k];
  // Behind all pairs' own, where nothing looks for it again.
  add_point(pair.bodies, feature, (of_b ? pair.bodies.a : pair.bodies.b).posed->core->solid_feature(), of_b);
  PointState& p = points_.back();
  if (p.lane >= 0) {
    const shape::CoreDistance d = of_b ? distance_to(*pair.bodies.a.posed, p.point)
                                       : distance_to(*pair.bodies.b.posed, p.point - pair.bodies.offset);
    boxes_.count = p.lane; // its lane is not needed
    p.lane = -1;
    p.distance = d.distance;
    p.normal = d.normal;
  }
  return p;
}

void Manifolds::take_arc(const Pair& pair, const ArcState& state, double& gap) {
  const bool of_b = state.of_b;
  const ContactBody &own = of_b ? pair.bodies.b : pair.bodies.a, &solid = of_b ? pair.bodies.a : pair.bodies.b;
  const ContactCore& core = *own.posed->core;
  const int rim_number = state.arc / core.ring, index = state.arc % core.ring;
  const int first = state.arc, second = rim_number * core.ring + (index + 1) % core.ring;
  PointState from = state_of(pair, first, of_b), to = state_of(pair, second, of_b);
  const double reach = from.reach, step = 2 * M_PI / core.ring, length = core.half.x() * step;
  const double least =
      (from.distance + to.distance - length) / 2 - reach; // distances change no faster than points move
  if (least >= 0) {
    gap = std::min(gap, least);
    return;
  }
  const Rim rim(*own.posed, rim_number);
  const Vector3d shift = of_b ? pair.bodies.offset : Vector3d(-pair.bodies.offset);
  // Where its distance was all that was needed, the normal is still in the solid's frame.
  const auto normal_at = [&](const PointState& p) {
    return p.distance < p.reach || p.lane < 0 ? p.normal : Vector3d(solid.posed->rotation * boxes_.normal(p.lane));
  };
  const double angle = index * step, unit = core.half.x();
  const double slope_from = normal_at(from).dot(rim.tangent(angle)) / unit,
               slope_to = normal_at(to).dot(rim.tangent(angle + step)) / unit;
  const auto distance = [&](const Vector3d& p) { return distance_to(*solid.posed, p + shift); };
  const int pieces = std::clamp(static_cast<int>(std::ceil(length / (resolved * reach))), 1, max_pieces);
  extremes_.clear();
  extremes_on_arc(rim, angle, slope_from, angle + step, slope_to, pieces, distance, extremes_);
  if (extremes_.empty())
    return; // an end is closest
  for (const ArcExtreme& e : extremes_)
    gap = std::min(gap, e.point.at.distance - reach);
  const ArcSpring spring({reach - from.distance, reach - to.distance}, {slope_from, slope_to}, extremes_, reach);
  const int touching[2] = {from.contact, to.contact};
  for (int k = 0; k < 2; ++k)
    if (touching[k] >= 0)
      contacts_[touching[k]].weight -= spring.loss[k];
  if (spring.share <= no_weight)
    return;
  const double radius_own = radius_of(own, 0), radius_a = of_b ? reach - radius_own : radius_own;
  const int own_feature = core.line_feature(state.arc);
  int other = solid.posed->core->solid_feature();
  for (const ArcExtreme& e : extremes_) {
    const shape::CoreDistance& at = e.point.at;
    if (at.distance >= reach)
      continue;
    const Vector3d on = of_b ? Vector3d(pair.bodies.offset + e.point.point) : e.point.point;
    int& closest = rim_contact_[of_b][rim_number];
    if (e.closest && (closest < 0 || at.distance < contacts_[closest].distance))
      closest = static_cast<int>(contacts_.size());
    // Further ones on the same arc have the numbers behind the solid's.
    contacts_.push_back({of_b ? feature_id(other, own_feature) : feature_id(own_feature, other), !e.closest,
                         of_b ? Vector3d(on - at.distance * at.normal) : on, of_b ? Vector3d(-at.normal) : at.normal,
                         at.distance, reach, radius_a, e.closest ? spring.share : -spring.share});
    ++other;
  }
}

/// A disk's side against an edge or another's side.
void Manifolds::take_line(const Pair& pair, const EdgePair& line, double& gap) {
  const EdgeLanes& e = edge_lanes_;
  const int lane = line.lane;
  const double square = e.at(EdgeLanes::square, lane);
  if (square <= 0)
    return;
  const ContactBody &a = pair.bodies.a, &b = pair.bodies.b;
  const ContactCore &core_a = *a.posed->core, &core_b = *b.posed->core;
  const double side_a = core_a.is_disk() ? core_a.half.x() : 0, side_b = core_b.is_disk() ? core_b.half.x() : 0;
  const double radius_a = radius_of(a, 0), reach = radius_a + radius_of(b, 0);
  const double apart = std::sqrt(square), distance = apart - side_a - side_b;
  gap = std::min(gap, distance - reach);
  if (distance >= reach)
    return;
  const Vector3d on_a = e.vector(EdgeLanes::ax, lane) + e.at(EdgeLanes::s, lane) * e.vector(EdgeLanes::ux, lane);
  const Vector3d on_b = e.vector(EdgeLanes::bx, lane) + e.at(EdgeLanes::t, lane) * e.vector(EdgeLanes::vx, lane);
  const Vector3d normal = (on_a - on_b) / apart;
  // The ends: vertices of an edge, rims of an axis.
  int ends[4];
  for (int k = 0; k < 2; ++k) {
    ends[k] = core_a.is_disk() ? rim_contact_[0][k] : contact_of(pair, core_a.edges[line.line_a][k], false);
    ends[2 + k] = core_b.is_disk() ? rim_contact_[1][k] : contact_of(pair, core_b.edges[line.line_b][k], true);
  }
  const double overlap = reach - distance;
  double end_overlap[4];
  for (int k = 0; k < 4; ++k)
    end_overlap[k] = ends[k] < 0 ? 0 : contacts_[ends[k]].overlap();
  const HandOver<4, 2> share(overlap, end_overlap);
  for (int k = 0; k < 4; ++k)
    if (share.loss[k] > 0)
      contacts_[ends[k]].weight -= share.loss[k];
  const double weight = share.line;
  if (weight > no_weight)
    contacts_.push_back({feature_id(core_a.line_feature(line.line_a), core_b.line_feature(line.line_b)), false,
                         on_a - side_a * normal, normal, distance, reach, radius_a, weight});
}

/// Drops contacts that have handed all of their spring over; those that owe more are elastic corrections.
void Manifolds::drop_weightless(int first) {
  std::size_t kept = first;
  for (std::size_t k = first; k < contacts_.size(); ++k) {
    Contact c = contacts_[k];
    if (std::abs(c.weight) < no_weight)
      continue;
    c.elastic |= c.weight < 0;
    contacts_[kept++] = c;
  }
  contacts_.resize(kept);
}

/// Normals of cores that overlap lead in all directions, some of them deeper in, and hold the bodies together. There
/// all contacts act along the axis of least overlap, each with its own depth along it; from cores that touch to
/// `turning_depth` contacts turn to it. Returns the overlap of the cores.
double Manifolds::soften_sunk(const BodyPair& pair, int first) {
  const PosedCore &a = *pair.a.posed, &b = *pair.b.posed;
  const double radius_a = radius_of(pair.a, 0), reach = radius_a + radius_of(pair.b, 0);
  const SeparatingAxis axis = least_axis(a, b, pair.offset);
  if (axis.separation >= 0)
    return 0;
  // Of flat and smooth cores not all axes are asked: that none of them separates does not mean that cores overlap.
  const auto all_axes = [](const PosedCore& of) {
    return of.core->solid == SolidKind::box || of.core->solid == SolidKind::polyhedron;
  };
  if (!(all_axes(a) && all_axes(b)) && gjk_distance(a, b, pair.offset) > 0)
    return 0;
  const double depth = -axis.separation, turned = std::min(1., depth / (turning_depth * reach));
  const double front_b = pair.offset.dot(axis.normal) + b.reach_along(axis.normal),
               front_a = -a.reach_along(-axis.normal);
  std::size_t kept = first;
  for (std::size_t k = first; k < contacts_.size(); ++k) {
    Contact c = contacts_[k];
    if (c.weight < 0)
      continue;
    const Vector3d on_b = c.arm - c.distance * c.normal;
    const bool of_a = feature_a(c.id) < a.core->points, of_b = feature_b(c.id) < b.core->points;
    const double along = of_a   ? axis.normal.dot(c.arm) - front_b
                         : of_b ? front_a - axis.normal.dot(on_b)
                                : axis.normal.dot(c.arm - on_b);
    const Vector3d middle = (c.arm + on_b) / 2;
    c.distance = (1 - turned) * c.distance + turned * along;
    if (c.distance >= c.reach)
      continue;
    const Vector3d turning = (1 - turned) * c.normal + turned * axis.normal;
    c.normal = turning.norm() > 0.1 ? Vector3d(turning.normalized()) : axis.normal;
    c.arm = middle + c.distance / 2 * c.normal;
    contacts_[kept++] = c;
  }
  contacts_.resize(kept);
  if (kept == static_cast<std::size_t>(first)) {
    contacts_.push_back({feature_id(a.core->solid_feature(), b.core->solid_feature()), false,
                         pair.offset / 2 - depth / 2 * axis.normal, axis.normal, -depth, reach, radius_a, 1});
  }
  return depth;
}

} // namespace eccentra::contact
