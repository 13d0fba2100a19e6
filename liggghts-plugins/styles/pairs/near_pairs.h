// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The list of near pairs of bodies of this rank, with the history of their contacts and their candidates.
#pragma once

#include "contact/candidates.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/pairs/fix_cluster_history.h"

#include "pointers.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

namespace LAMMPS_NS {
class NeighList;
}

namespace eccentra::styles {

/// Two bodies near each other. A has the lower tag, so that every rank that meets the pair computes the same.
/// Short, as a body has some ten of them: what belongs to a body is in its state.
struct NearPair {
  static constexpr int not_yet = -1, needless = -2; ///< for `search`; needless: two single spheres

  int a, b;                                     ///< local or ghost indices
  int candidate_first = 0, candidate_count = 0; ///< in the candidate store
  int candidate_room = 0;                       ///< the pair's there
  float skin = 0; ///< relative motion since the last search that the candidates allow [m]; 0: they hold no more
  int search;     ///< into NearPairs::searches

  bool direct() const { return search == needless; }
};

/// What tells whether a pair needs a look at all; apart from the rest and short, as most pairs do not and all are
/// asked. At the last look at time `since` matter of B moved past A's by at most `speed`; until now none has moved
/// farther than (time - since) (speed + both bodies' changes of velocity + both bodies' changes of turning * reach).
/// Single precision: the margin for the curvature of paths is much wider.
struct PairWake {
  int a, b;
  float since = 0;               ///< [s]
  float speed = 0;               ///< [m/s]
  float changed = 0, turned = 0; ///< sums of both bodies' VelocityChange then
  float reach = 0;               ///< from A's centre to the farthest of B's matter [m]
  float room = -1;               ///< [m]; idle: nothing touches within it; else the candidates are all that can touch
};

/// What the velocities of a body have done since the list was made: sums over the steps of |change of v| [m/s], and of
/// |change of omega| + omega^2 dt [rad/s]. The latter is what a point at rest in a turning frame needs to stay there.
struct VelocityChange {
  float speed, turning;
};

/// Numbers for what bodies have in common, so that one comparison tells whether they are alike.
class BodyKinds {
 public:
  struct Kind {
    double mass;
    int type;
    bool held;
    const contact::SurfaceSpheres* surface;
    bool operator==(const Kind& k) const {
      return mass == k.mass && type == k.type && held == k.held && surface == k.surface;
    }
  };
  void clear() { known_.clear(); }
  /// The number of body i's kind; where there are many kinds, some bodies have one of their own.
  int number(const Kind& kind, int i) {
    constexpr std::size_t most = 8;
    for (std::size_t k = 0; k < known_.size(); ++k)
      if (known_[k] == kind)
        return static_cast<int>(k);
    if (known_.size() == most)
      return static_cast<int>(most) + i;
    known_.push_back(kind);
    return static_cast<int>(known_.size()) - 1;
  }

 private:
  std::vector<Kind> known_;
};

/// Contacts of one step in the order of the pairs, ids ascending within a pair.
struct ContactList {
  std::vector<int> first; ///< per pair, and one past the end
  std::vector<int> id;
  std::vector<double> displacement[3];
  /// What contact models of LIGGGHTS's own remember: `width` values per contact.
  std::vector<double> more;
  int width = 0;
  /// No contacts; `first` is all 0.
  void clear(std::size_t pairs);
  /// Makes `first` of the counts that have been written one place behind each pair's own.
  void counts_to_places();
  /// Makes room for `count` contacts and some more, or gives back what is far too much.
  void make_room(std::size_t count);
  int size() const { return static_cast<int>(id.size()); }
};

/// Kept in ascending order of (tag_a, tag_b): then forces on a body add up in an order that depends neither on the
/// number of ranks nor on when neighbour lists were built, and results agree to the last bit.
class NearPairs : protected LAMMPS_NS::Pointers {
 public:
  NearPairs(LAMMPS_NS::LAMMPS* lmp, FixClusterBodies& bodies, FixClusterHistory& history);

  /// True while the arrays here hold the newest history.
  bool live() const { return live_; }
  /// Makes the pairs of a fresh neighbour list and takes the history over from the atoms.
  void rebuild(const LAMMPS_NS::NeighList& list);
  /// Values per contact beside the displacement; before rebuild().
  void set_history_width(int width) { contacts.width = next.width = width; }
  /// Copies the history to the atoms. `keep`: the pairs stay valid.
  void hand_over(bool keep);

  std::vector<NearPair> pairs;
  std::vector<PairWake> wakes; ///< one per pair
  std::vector<char> idle;      ///< one per pair
  ContactList contacts, next;  ///< of the last step; the one under construction
  contact::CandidateStore candidates;
  /// Poses at the last search of pairs whose bounding spheres have met.
  std::vector<contact::RelativePose> searches;

  /// Once a step of `dt` [s]: states of all bodies, ghosts as well, and changes of their velocities; no forces.
  void update_bodies(double dt, int held_groups);
  const contact::BodyState& body(int i) const { return bodies_now_[i]; }
  /// Of body i when the list was made.
  int tag(int i) const { return bodies_now_[i].tag; }
  const contact::SurfaceSpheres& surface_a(const NearPair& p) const { return *bodies_now_[p.a].surface; }
  const contact::SurfaceSpheres& surface_b(const NearPair& p) const { return *bodies_now_[p.b].surface; }
  double bound_a(const NearPair& p) const { return bound(bodies_now_[p.a]); } ///< bounding radius of A [m]
  double bound_b(const NearPair& p) const { return bound(bodies_now_[p.b]); }
  double range(const NearPair& p) const { return bound_a(p) + bound_b(p); }
  /// Largest sum of the radii of two sub-spheres [m].
  double largest_reach(const NearPair& p) const { return largest(bodies_now_[p.a]) + largest(bodies_now_[p.b]); }
  /// The same number for bodies of the same mass, material and shape.
  int kind(int i) const { return kind_[i]; }
  /// From A's centre to B's [m]; fourth lane: anything.
  contact::Double4 offset(const NearPair& p) const {
    contact::Double4 a, b; // of the mass, too, as it stands beside the position
    static_assert(offsetof(contact::BodyState, mass) == 3 * sizeof(double));
    std::memcpy(&a, &bodies_now_[p.a], sizeof a);
    std::memcpy(&b, &bodies_now_[p.b], sizeof b);
    return b - a;
  }
  /// Local and ghost atoms, as of the list.
  int body_count() const { return static_cast<int>(bodies_now_.size()); }
  /// True for a body without any velocity in this step.
  bool at_rest(int i) const {
    const contact::BodyState& b = bodies_now_[i];
    return b.v[0] == 0 && b.v[1] == 0 && b.v[2] == 0 && b.omega[0] == 0 && b.omega[1] == 0 && b.omega[2] == 0;
  }
  /// Takes a pair out of the loop over pairs, and back into it.
  void leave_alone(int pair) {
    idle[pair] = 1;
    wakes[pair].room = std::numeric_limits<float>::infinity();
  }
  void look_again(int pair) {
    idle[pair] = 0;
    wakes[pair].room = -1;
  }
  /// Of all ghosts together: nobody reads it.
  contact::BodyForce& force(int i) { return forces_[std::min(i, local_at_build_)]; }
  /// Adds the forces to the atoms of this rank.
  void add_forces() const;
  /// Asks for the data of a pair ahead of its turn.
  void prefetch(int pair) const {
    const char *p = reinterpret_cast<const char*>(&pairs[pair]),
               *a = reinterpret_cast<const char*>(&bodies_now_[wakes[pair].a]),
               *b = reinterpret_cast<const char*>(&bodies_now_[wakes[pair].b]);
    constexpr int line = 64;
    __builtin_prefetch(p);
    for (int k = 0; k < 4; ++k) {
      __builtin_prefetch(a + k * line);
      __builtin_prefetch(b + k * line);
    }
  }
  /// How far at most matter of B has moved past A since the last look at the pair [m].
  float moved_since_look(const PairWake& wake) const {
    const VelocityChange &a = change_[wake.a], &b = change_[wake.b];
    return (time_ - wake.since) *
           (wake.speed + (a.speed + b.speed - wake.changed) + (a.turning + b.turning - wake.turned) * wake.reach);
  }
  /// Lists the pairs that need a look in ascending order, as ~n where more than the room for it has been moved; `out`
  /// has room for all pairs. Returns how many.
  int find_awake(int* out) const;
  /// Notes a look at the pair that holds for the next `room` [m] of relative motion.
  void note_look(int pair, const double* offset, double room, bool idle);
  /// The same for a pair that has `room` between its bounding spheres, which then is idle: turning cannot close it.
  void note_apart(int pair, double room);
  /// Speed at most of B's matter past A's [m/s].
  double relative_speed(const NearPair& pair, const double* offset) const;
  /// Speed of B's centre past A's [m/s].
  double speed_of_centres(const NearPair& pair) const;

  /// Makes `next` the contacts of the last step.
  void accept() { std::swap(contacts, next); }
  /// Numbers for f_cluster_history.
  void set_counts(int contacts_now, int near_now) {
    history_.contact_count = contacts_now;
    history_.near_pair_count = near_now;
  }
  double memory_usage() const;

 private:
  static double bound(const contact::BodyState& body) { return body.surface->bounding_radius + body.extra_radius; }
  static double largest(const contact::BodyState& body) { return body.surface->largest_radius + body.extra_radius; }
  void begin_bodies();
  void take_history();

  FixClusterBodies& bodies_;
  FixClusterHistory& history_;
  bool live_ = false;
  int local_at_build_ = 0;
  float time_ = 0; ///< since the list was made [s]
  bool new_list_ = true;
  BodyKinds kinds_;
  std::vector<int> kind_; ///< per body
  std::vector<VelocityChange> change_;
  std::vector<contact::BodyState> bodies_now_;
  std::vector<contact::BodyForce> forces_;
};

} // namespace eccentra::styles
