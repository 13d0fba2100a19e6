// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contacts of two rounded boxes, straight from the orientations of the bodies. What Manifolds finds for other
// cores, with the same meaning.
#pragma once

#include "contact/body_state.h"
#include "contact/contact_core.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace eccentra::contact {

/// One point contact of two boxes, as Contact has it.
struct BoxTouch {
  Double4 normal;  ///< unit, from B to A
  Double4 arm;     ///< from A's centre to its core's point [m]
  double distance; ///< of the cores' points along the normal [m]
  double weight;   ///< of the spring
  int id;          ///< feature_id
  bool elastic;    ///< an elastic force alone
};

/// A box: its core and the columns of the rotation from body to world.
struct TurnedBox {
  const ContactCore* core; ///< in the body frame
  const Double4* column;   ///< three, unit
};

/// Finds the contacts of one pair of boxes at a time.
class BoxContacts {
 public:
  /// `to_b` leads from A's centre to B's [m], fourth lane 0; `ids`: candidates (feature_id, ascending), of which the
  /// pair of both solids does not count; `reach`: distance of the cores at which they touch [m].
  void find(const TurnedBox& a, const TurnedBox& b, const Double4& to_b, double reach, const int* ids, int count);

  /// Forgets what it knows of cores: others may come to be where they are.
  void forget_cores() { edges_.clear(); }

  /// The contacts, ids ascending.
  const BoxTouch* begin() const { return touches_.data(); }
  const BoxTouch* end() const { return touches_.data() + count_; } ///< one past the last
  /// Number of contacts.
  int size() const { return count_; }
  /// How far the closest candidate is from touching [m]; of use where none touches.
  double gap() const;
  /// Whether one of the contacts is an elastic force alone.
  bool any_elastic() const { return elastic_; }

 private:
  /// The edges of a box in its body frame: p + s u with |s| <= half, u along an axis of the body.
  struct Edges {
    const ContactCore* core = nullptr;
    Double4 middle[12];
    double half[12], sign[12]; ///< u is this times the axis
    int axis[12], from[12], to[12];
  };
  /// What an end of an edge that has touched in its inside has to give.
  struct Loss {
    int vertex;
    bool of_a;
    double distance, loss; ///< of the end from the other edge [m]; part of its spring
    BoxTouch correction;   ///< in force where the vertex has no contact to take it from
  };

  template <bool of_b> void take_vertex(const TurnedBox& own, const TurnedBox& other, int vertex, int id);
  void take_edge(const TurnedBox& a, const TurnedBox& b, const Edges& edges_a, const Edges& edges_b, int id);
  void hand_over(int edges_first, int edges_last);
  const Edges& edges_of(const ContactCore& core);

  std::vector<BoxTouch> touches_; ///< room for more than there are
  int count_ = 0;
  std::vector<Loss> losses_;
  std::vector<Edges> edges_;                        ///< of all cores that have come
  Double4 to_b_, rows_[2][3], half_[2];             ///< rotations from world to body, and half edges, of A and B
  double reach_ = 0, square_reach_ = 0, least_ = 0; ///< the least squared distance of candidates [m2]
  bool elastic_ = false;
};

} // namespace eccentra::contact
