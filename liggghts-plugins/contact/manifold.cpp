// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From candidates to contacts: exact distances in lanes, then each pair's springs and their weights.
#include "contact/manifold.h"

#include "contact/gjk.h"
#include "contact/hand_over.h"
#include "contact/least_axis.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// A vertex whose distance from an edge is that from the solid, but for this part of the reach, has it as the closest.
constexpr double same_distance = 1e-9;
/// Edges closer than this part of their reach may have passed each other.
constexpr double may_have_crossed = 0.25;
/// Where an arc of a disk's rim is closest and farthest is told apart in pieces of this part of the reach.
constexpr double resolved = 0.5;
/// Centres closer than this part of the bounding radii: one body may have passed through the other without a contact.
constexpr double passed_through = 0.25;
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

bool boxes_sunk(const PosedCore& a, const PosedCore& b, const Vector3d& offset, const int* candidates, int count) {
  if (count == 0 || candidates[count - 1] != feature_id(a.core->solid_feature(), b.core->solid_feature()))
    return false;
  BoxesApart boxes(a, b, offset);
  if (boxes.separation() < 0)
    boxes.ask_edges();
  return boxes.separation() < 0;
}

void Manifolds::clear() {
  pairs_.clear();
  points_.clear();
  edges_.clear();
  lines_.clear();
  rims_.clear();
  rim_points_.clear();
  arcs_.clear();
  boxes_.count = disks_.count = edge_lanes_.count = 0;
  for (RimLanes& lanes : rim_lanes_)
    lanes.count = 0;
  rim_polyhedra_.clear();
  two_boxes_.forget_cores();
  of_boxes_.clear();
  contacts_.clear();
  first_.clear();
  gap_.clear();
  sunk_.clear();
}

/// Two boxes whose cores do not overlap: takes their contacts down at once. False for other pairs.
bool Manifolds::add_boxes(const BodyPair& bodies, const int* candidates, int count) {
  const PosedCore &a = *bodies.a.posed, &b = *bodies.b.posed;
  if (a.core->solid != SolidKind::box || b.core->solid != SolidKind::box ||
      boxes_sunk(a, b, bodies.offset, candidates, count))
    return false;
  Double4 column_a[3], column_b[3];
  for (int k = 0; k < 3; ++k) {
    column_a[k] = Double4{a.rotation(0, k), a.rotation(1, k), a.rotation(2, k), 0};
    column_b[k] = Double4{b.rotation(0, k), b.rotation(1, k), b.rotation(2, k), 0};
  }
  const double radius_a = radius_of(bodies.a, 0), reach = radius_a + radius_of(bodies.b, 0);
  two_boxes_.find({a.core, column_a}, {b.core, column_b},
                  Double4{bodies.offset.x(), bodies.offset.y(), bodies.offset.z(), 0}, reach, candidates, count);
  Pair pair = {};
  pair.bodies = bodies;
  pair.first_box = static_cast<int>(of_boxes_.size());
  for (const BoxTouch& t : two_boxes_)
    of_boxes_.push_back(contact::contact_of(t, reach, radius_a));
  pair.last_box = static_cast<int>(of_boxes_.size());
  pair.box_gap = two_boxes_.gap();
  pairs_.push_back(pair);
  return true;
}

void Manifolds::add(const BodyPair& bodies, const int* candidates, int count) {
  if (add_boxes(bodies, candidates, count))
    return;
  Pair pair;
  pair.bodies = bodies;
  pair.first_point = static_cast<int>(points_.size());
  pair.first_rim = static_cast<int>(rims_.size());
  pair.first_rim_point = static_cast<int>(rim_points_.size());
  pair.first_edge = static_cast<int>(edges_.size());
  pair.first_arc = static_cast<int>(arcs_.size());
  pair.first_line = static_cast<int>(lines_.size());
  pair.may_be_sunk = false;
  const ContactCore &a = *bodies.a.posed->core, &b = *bodies.b.posed->core;
  constexpr int ring = shape::points_on_rim;
  std::array<int, 2 * ring> at[2]; // of A's and B's rims: into rim_points_
  const auto add_arc = [&](int arc, bool of_b) {
    const int from = at[of_b][arc], to = at[of_b][arc / ring * ring + (arc + 1) % ring];
    arcs_.push_back({rim_points_[from].rim, arc % ring, from, to});
  };
  for (int k = 0; k < count; ++k) {
    const int fa = feature_a(candidates[k]), fb = feature_b(candidates[k]);
    const bool point_a = fa < a.points, point_b = fb < b.points;
    if (fa == a.solid_feature() && fb == b.solid_feature() && !point_a) {
      pair.may_be_sunk = true;
    } else if (point_a && a.is_disk() && b.solid != SolidKind::none) {
      at[0][fa] = add_rim_point(bodies, fa, false, pair.first_rim);
    } else if (point_a) {
      add_point(bodies, fa, fb, false);
    } else if (point_b && b.is_disk() && a.solid != SolidKind::none) {
      at[1][fb] = add_rim_point(bodies, fb, true, pair.first_rim);
    } else if (point_b) {
      add_point(bodies, fb, fa, true);
    } else if (fb == b.solid_feature()) {
      add_arc(fa - a.points, false);
    } else if (fa == a.solid_feature()) {
      add_arc(fb - b.points, true);
    } else {
      const int line_a = fa - a.points, line_b = fb - b.points;
      const Line la = line_of(*bodies.a.posed, line_a), lb = line_of(*bodies.b.posed, line_b);
      (a.is_disk() || b.is_disk() ? lines_ : edges_).push_back({line_a, line_b, edge_lanes_.count});
      edge_lanes_.add(la.from, la.along, bodies.offset + lb.from, lb.along);
    }
  }
  pair.last_point = static_cast<int>(points_.size());
  pair.last_rim = static_cast<int>(rims_.size());
  pair.last_rim_point = static_cast<int>(rim_points_.size());
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
  } else if (core.is_disk()) {
    p.lane = disks_.count;
    disks_.add(solid.posed->rotation.transpose() * from_solid, core.half);
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

int Manifolds::add_rim_point(const BodyPair& pair, int feature, bool of_b, int first_rim) {
  const PosedCore &own = *(of_b ? pair.b : pair.a).posed, &solid = *(of_b ? pair.a : pair.b).posed;
  const int number = feature / shape::points_on_rim, k = feature % shape::points_on_rim;
  // Points of one rim follow one another.
  if (static_cast<int>(rims_.size()) == first_rim || rims_.back().of_b != of_b || rims_.back().number != number)
    rims_.push_back({RimOnSolid(own, number, solid, of_b ? pair.offset : Vector3d(-pair.offset)), of_b, number, -1});
  RimLanes& lanes = lanes_on(*solid.core);
  if (&lanes == &rim_lanes_[2])
    rim_polyhedra_.push_back(solid.core);
  rim_points_.push_back({static_cast<int>(rims_.size()) - 1, k, lanes.count, -1});
  lanes.add(rims_.back().frame, k);
  return static_cast<int>(rim_points_.size()) - 1;
}

void Manifolds::evaluate() {
  boxes_.evaluate();
  disks_.evaluate();
  rim_lanes_[0].on_disks();
  rim_lanes_[1].on_boxes();
  rim_lanes_[2].on_polyhedra(rim_polyhedra_);
  edge_lanes_.evaluate();
  for (const Pair& pair : pairs_) {
    const int first = static_cast<int>(contacts_.size());
    first_.push_back(first);
    if (pair.first_box >= 0) {
      contacts_.insert(contacts_.end(), of_boxes_.begin() + pair.first_box, of_boxes_.begin() + pair.last_box);
      sunk_.push_back(0);
      gap_.push_back(pair.box_gap);
      continue;
    }
    double gap = std::numeric_limits<double>::max();
    take_points(pair, gap);
    take_rim_points(pair, gap);
    for (int k = pair.first_edge; k < pair.last_edge; ++k)
      take_edge(pair, edges_[k], gap);
    for (int k = pair.first_arc; k < pair.last_arc; ++k)
      take_arc(pair, arcs_[k], gap);
    for (int k = pair.first_line; k < pair.last_line; ++k)
      take_line(pair, lines_[k], gap);
    drop_weightless(first);
    sunk_.push_back(pair.may_be_sunk && may_overlap(pair.bodies, first) ? soften_sunk(pair.bodies, first) : 0);
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
      const PosedCore& solid = *(p.of_b ? pair.bodies.a : pair.bodies.b).posed;
      const bool on_disk = solid.core->is_disk();
      p.distance = on_disk ? disks_.at(DiskLanes::distance, p.lane) : boxes_.at(BoxLanes::distance, p.lane);
      if (p.distance < p.reach)
        p.normal = solid.rotation * (on_disk ? disks_.normal(p.lane) : boxes_.normal(p.lane));
    }
    gap = std::min(gap, p.distance - p.reach);
    if (p.distance >= p.reach)
      continue;
    p.contact = static_cast<int>(contacts_.size());
    const Vector3d arm = p.of_b ? Vector3d(p.point - p.distance * p.normal) : p.point;
    const double radius_own = radius_of(p.of_b ? pair.bodies.b : pair.bodies.a, p.feature);
    contacts_.push_back({p.of_b ? feature_id(p.other, p.feature) : feature_id(p.feature, p.other), false, arm,
                         p.of_b ? Vector3d(-p.normal) : p.normal, p.distance, p.reach,
                         p.of_b ? p.reach - radius_own : radius_own, 1});
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

void Manifolds::take_rim_points(const Pair& pair, double& gap) {
  for (int k = pair.first_rim_point; k < pair.last_rim_point; ++k) {
    RimPoint& p = rim_points_[k];
    RimState& rim = rims_[p.rim];
    const ContactBody &own = rim.of_b ? pair.bodies.b : pair.bodies.a,
                      &solid = rim.of_b ? pair.bodies.a : pair.bodies.b;
    const RimLanes& lanes = lanes_on(*solid.posed->core);
    const double radius_own = radius_of(own, 0), reach = radius_own + radius_of(solid, 0),
                 distance = lanes.at(RimLanes::distance, p.lane);
    gap = std::min(gap, distance - reach);
    if (distance >= reach)
      continue;
    p.contact = static_cast<int>(contacts_.size());
    if (rim.closest < 0 || distance < contacts_[rim.closest].distance)
      rim.closest = p.contact;
    const Vector3d normal = solid.posed->rotation * lanes.vector(RimLanes::nx, p.lane);
    Vector3d on = solid.posed->rotation * lanes.vector(RimLanes::px, p.lane);
    const int feature = rim.number * shape::points_on_rim + p.k, other = solid.posed->core->solid_feature();
    if (rim.of_b) {
      on -= distance * normal;
      contacts_.push_back({feature_id(other, feature), false, on, -normal, distance, reach, reach - radius_own, 1});
    } else {
      on += pair.bodies.offset;
      contacts_.push_back({feature_id(feature, other), false, on, normal, distance, reach, radius_own, 1});
    }
  }
}

/// The contact of a rim that is closest to the other's solid, or -1.
int Manifolds::closest_of_rim(const Pair& pair, bool of_b, int number) const {
  for (int k = pair.first_rim; k < pair.last_rim; ++k)
    if (rims_[k].of_b == of_b && rims_[k].number == number)
      return rims_[k].closest;
  return -1;
}

void Manifolds::take_arc(const Pair& pair, const ArcState& state, double& gap) {
  RimState& rim = rims_[state.rim];
  const bool of_b = rim.of_b;
  const ContactBody &own = of_b ? pair.bodies.b : pair.bodies.a, &solid = of_b ? pair.bodies.a : pair.bodies.b;
  const ContactCore& core = *own.posed->core;
  const RimPoint &first = rim_points_[state.from], &second = rim_points_[state.to];
  const RimLanes& lanes = lanes_on(*solid.posed->core);
  const RimEnd from = lanes.end(first.lane), to = lanes.end(second.lane);
  const double radius_own = radius_of(own, 0), reach = radius_own + radius_of(solid, 0);
  const double least = rim.frame.least_between(from, to) - reach;
  if (least >= 0) {
    gap = std::min(gap, least);
    return;
  }
  constexpr double half = RingDirections::step / 2;
  const RimOnSolid::Arc arc(rim.frame, state.k);
  extremes_.clear();
  if (RimOnSolid::monotonic(from, to)) {
    if (from.slope < 0 && to.slope > 0)
      extremes_.push_back(
          {closest_on_arc(-half, from.slope, half, to.slope, RimOnSolid::cubic_root(from, to), arc), true});
    else if (from.slope >= 0 && to.slope <= 0)
      extremes_.push_back(
          {closest_on_arc(half, to.slope, -half, from.slope, RimOnSolid::cubic_root(from, to), arc), false});
  } else {
    const int pieces =
        std::clamp(static_cast<int>(std::ceil(2 * half * core.half.x() / (resolved * reach))), 1, max_pieces);
    extremes_on_arc(-half, from.slope, half, to.slope, pieces, arc, extremes_);
  }
  if (extremes_.empty())
    return; // an end is closest
  for (const ArcExtreme& e : extremes_)
    gap = std::min(gap, e.point.at.distance - reach);
  const ArcSpring spring({reach - from.distance, reach - to.distance}, {from.slope, to.slope}, extremes_, reach);
  const int touching[2] = {first.contact, second.contact};
  for (int k = 0; k < 2; ++k)
    if (touching[k] >= 0)
      contacts_[touching[k]].weight -= spring.loss[k];
  if (spring.share <= no_weight)
    return;
  const double radius_a = of_b ? reach - radius_own : radius_own;
  const int own_feature = core.line_feature(rim.number * core.ring + state.k);
  int other = solid.posed->core->solid_feature();
  for (const ArcExtreme& e : extremes_) {
    const double distance = e.point.at.distance;
    if (distance >= reach)
      continue;
    const Vector3d normal = solid.posed->rotation * e.point.at.normal;
    Vector3d on = solid.posed->rotation * e.point.point; // from A's centre to the point of A's core
    if (of_b)
      on -= distance * normal;
    else
      on += pair.bodies.offset;
    if (e.closest && (rim.closest < 0 || distance < contacts_[rim.closest].distance))
      rim.closest = static_cast<int>(contacts_.size());
    // Further ones on the same arc have the numbers behind the solid's.
    contacts_.push_back({of_b ? feature_id(other, own_feature) : feature_id(own_feature, other), !e.closest, on,
                         of_b ? Vector3d(-normal) : normal, distance, reach, radius_a,
                         e.closest ? spring.share : -spring.share});
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
    ends[k] = core_a.is_disk() ? closest_of_rim(pair, false, k) : contact_of(pair, core_a.edges[line.line_a][k], false);
    ends[2 + k] =
        core_b.is_disk() ? closest_of_rim(pair, true, k) : contact_of(pair, core_b.edges[line.line_b][k], true);
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

/// False where the contacts show that the cores do not overlap, at much less than the price of the axes. A disk cannot
/// overlap without a rim's point or a side in the other, unless one body has passed through the other's faces.
bool Manifolds::may_overlap(const BodyPair& pair, int first) const {
  const ContactCore &a = *pair.a.posed->core, &b = *pair.b.posed->core;
  if (!(a.is_disk() || b.is_disk()) || a.solid == SolidKind::flat || b.solid == SolidKind::flat)
    return true;
  if (first == static_cast<int>(contacts_.size()))
    return pair.offset.norm() < passed_through * (a.bound + b.bound);
  return std::any_of(contacts_.begin() + first, contacts_.end(), [](const Contact& c) { return c.distance <= 0; });
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
