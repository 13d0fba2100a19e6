// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contacts of pairs of rounded bodies: point contacts that cover the touching features and share one potential.
#pragma once

#include "contact/arc_minimum.h"
#include "contact/box_contacts.h"
#include "contact/contact_core.h"
#include "contact/manifold_lanes.h"
#include "contact/rim_lanes.h"
#include "contact/rim_on_solid.h"

#include <vector>

namespace eccentra::contact {

/// One point contact, seen from A; world axes.
struct Contact {
  int id;                 ///< feature_id
  bool elastic;           ///< an elastic force alone, without friction, damping or history; its weight may be negative
  Eigen::Vector3d arm;    ///< from A's centre to its core's point [m]
  Eigen::Vector3d normal; ///< unit, from B to A
  double distance;        ///< of the cores' points along the normal [m]
  double reach;           ///< distance at which they touch: sum of the two radii [m]
  double radius_a;        ///< of A's rounding there [m]
  double weight;          ///< of the spring
  /// Depth [m]; > 0 where they touch.
  double overlap() const { return reach - distance; }
  /// From A's centre to the middle of the overlap.
  Eigen::Vector3d contact_point() const { return arm - (radius_a - overlap() / 2) * normal; }
};

/// A contact of two boxes, with the reach of the pair and the radius of A's rounding [m].
inline Contact contact_of(const BoxTouch& t, double reach, double radius_a) {
  return {
      t.id,     t.elastic, {t.arm[0], t.arm[1], t.arm[2]}, {t.normal[0], t.normal[1], t.normal[2]}, t.distance, reach,
      radius_a, t.weight};
}

/// A body in a pair: `extra` is added to the radius of its rounding (plain spheres).
struct ContactBody {
  const PosedCore* posed; ///< must outlive the pair
  double extra = 0;       ///< [m]
};

/// Whether two boxes with these candidates overlap with their cores, so that their contacts need more than BoxContacts.
bool boxes_sunk(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset, const int* candidates,
                int count);

/// Two bodies; `offset` leads from A's centre to B's.
struct BodyPair {
  ContactBody a, b;       ///< seen from A
  Eigen::Vector3d offset; ///< [m], world axes
};

/// With u(d) = (reach - d)^(5/2), a Hertz spring's potential but for its stiffness, the potential of a pair is
///   sum of u(distance) over the points of each body from the other's solid
///   + sum over pairs of edges of u_E prod_k (1 - u_k / u_E), k the four ends, u_k by their distance from the other
///   edge
///   + sum over arcs of a disk's rims of u_E prod_k (1 - u_k / u_E), k the two points at its ends, all from the solid,
///     u_E the sum over the arc's closest points less that over its farthest ones (an end may be one of the former)
///   + the same over pairs of lines one of which is a disk's axis, with the disk's radius, squared factors and rims as
///     the axis' ends.
/// A pair of edges counts where its closest points lie inside both, an arc where its closest points lie inside. Where
/// such a point reaches an end, u_k = u_E: the product vanishes and one spring has been handed from edge to vertex.
/// Parallel edges lose theirs quadratically. So the potential has a continuous gradient, which `weight` carries: the
/// springs of ends lose what the gradient of the product gives to the edge. What cannot be taken off an end's own
/// contact is an elastic one with negative weight. Cores that overlap: see soften_sunk().
class Manifolds {
 public:
  /// Forgets all pairs.
  void clear();
  /// Takes in a pair with its candidates (feature_id, ascending), which must hold all points in reach, and the two ends
  /// of each arc of a rim; the pair of both solids among them says that the cores may overlap.
  void add(const BodyPair& pair, const int* candidates, int count);
  /// Finds the contacts of all pairs.
  void evaluate();

  /// Number of pairs.
  int pairs() const { return static_cast<int>(pairs_.size()); }
  /// Of all pairs, one after the other.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// A pair's contacts are first(pair) .. first(pair + 1) - 1, ids ascending.
  int first(int pair) const { return first_[pair]; }
  /// How far the closest candidate of a pair is from touching [m]; negative where something touches.
  double gap(int pair) const { return gap_[pair]; }
  /// How far the cores of a pair have run into each other [m]; 0 where they have not.
  double sunk(int pair) const { return sunk_[pair]; }

 private:
  /// A point of one body against the other's solid, or against a sub-sphere where neither has one.
  struct PointState {
    int feature, other;
    bool of_b;
    int lane; ///< into boxes_ or disks_, or -1
    Eigen::Vector3d point;
    double distance, reach;
    Eigen::Vector3d normal; ///< from the solid to the point
    int contact = -1;
  };
  struct EdgePair {
    int line_a, line_b;
    int lane;
  };
  /// A rim of a disk against the other's solid.
  struct RimState {
    RimOnSolid frame;
    bool of_b;
    int number;
    int closest; ///< the contact closest to the solid, or -1
  };
  struct RimPoint {
    int rim;  ///< into rims_
    int k;    ///< on it
    int lane; ///< into the lanes of the kind of solid
    int contact;
  };
  struct ArcState {
    int rim;      ///< into rims_
    int k;        ///< from this point to the next
    int from, to; ///< into rim_points_: its ends
  };
  struct Pair {
    BodyPair bodies;
    int first_point, first_rim, first_rim_point, first_edge, first_arc, first_line; ///< of the pair
    int last_point, last_rim, last_rim_point, last_edge, last_arc, last_line;
    bool may_be_sunk;
    int first_box = -1, last_box = -1; ///< of two boxes, whose contacts are known already: into of_boxes_
    double box_gap = 0;
  };

  bool add_boxes(const BodyPair& pair, const int* candidates, int count);
  void add_point(const BodyPair& pair, int feature, int other, bool of_b);
  int add_rim_point(const BodyPair& pair, int feature, bool of_b, int first_rim);
  RimLanes& lanes_on(const ContactCore& solid) {
    return rim_lanes_[solid.is_disk() ? 0 : solid.solid == SolidKind::box ? 1 : 2];
  }
  void take_points(const Pair& pair, double& gap);
  void take_rim_points(const Pair& pair, double& gap);
  int closest_of_rim(const Pair& pair, bool of_b, int number) const;
  void take_edge(const Pair& pair, const EdgePair& edge, double& gap);
  void take_arc(const Pair& pair, const ArcState& arc, double& gap);
  void take_line(const Pair& pair, const EdgePair& line, double& gap);
  int contact_of(const Pair& pair, int feature, bool of_b) const;
  void drop_weightless(int first);
  bool may_overlap(const BodyPair& pair, int first) const;
  double soften_sunk(const BodyPair& pair, int first);

  std::vector<Pair> pairs_;
  std::vector<PointState> points_;
  std::vector<EdgePair> edges_, lines_;
  std::vector<RimState> rims_;
  std::vector<RimPoint> rim_points_;
  std::vector<ArcState> arcs_;
  std::vector<ArcExtreme> extremes_; ///< of the arc at hand
  BoxContacts two_boxes_;
  std::vector<Contact> of_boxes_; ///< contacts of the pairs of boxes
  BoxLanes boxes_;
  DiskLanes disks_;
  RimLanes rim_lanes_[3];                         ///< on disks, boxes, other solids
  std::vector<const ContactCore*> rim_polyhedra_; ///< of the lanes on other solids
  EdgeLanes edge_lanes_;
  std::vector<Contact> contacts_;
  std::vector<int> first_;
  std::vector<double> gap_, sunk_;
};

} // namespace eccentra::contact
