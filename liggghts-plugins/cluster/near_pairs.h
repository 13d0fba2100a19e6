// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The list of near pairs of bodies of this rank, with the history of their contacts and their candidates.
#pragma once

#include "cluster/bodies.h"
#include "cluster/candidates.h"
#include "cluster/contact_history.h"

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
class NeighList;
}

namespace eccentra::cluster {

/// Two bodies near each other. A has the lower tag, so that every rank that meets the pair computes the same.
struct NearPair {
  int a, b; ///< local or ghost indices
  int tag_a, tag_b;
  const SurfaceSpheres *surface_a, *surface_b;
  double extra_a, extra_b; ///< added to the sub-spheres' radii (plain spheres) [m]
  double range;            ///< sum of the bounding radii [m]
  double stale;            ///< length of both bodies' paths up to which the candidates are all that can touch [m]
  int candidate_first;     ///< into the candidate store
  int candidate_count;
  int candidate_room;
  bool direct;       ///< two single spheres: nothing to search
  bool searched;     ///< there has been a search
  float bound_b;     ///< bounding radius of B [m]
  float skin;        ///< relative motion since the last search that the candidates allow [m]
  RelativePose pose; ///< at the last search
};

/// What tells whether a pair needs a look at all; apart from the rest, as most pairs do not and all are asked.
struct PairWake {
  int a, b;
  double quiet; ///< length of both bodies' paths before which they cannot touch [m]
};

/// Contacts of one step in the order of the pairs, ids ascending within a pair.
struct ContactList {
  std::vector<int> first; ///< per pair, and one past the end; room for that
  std::vector<int> id;
  std::vector<double> displacement[3];
  void clear(std::size_t pairs);
  int size() const { return static_cast<int>(id.size()); }
};

/// Kept in ascending order of (tag_a, tag_b): then forces on a body add up in an order that depends neither on the
/// number of ranks nor on when neighbour lists were built, and results agree to the last bit.
class NearPairs : protected LAMMPS_NS::Pointers {
 public:
  NearPairs(LAMMPS_NS::LAMMPS* lmp, FixBodies& bodies, FixContactHistory& history);

  /// True while the arrays here hold the newest history.
  bool live() const { return live_; }
  /// Makes the pairs of a fresh neighbour list and takes the history over from the atoms.
  void rebuild(const LAMMPS_NS::NeighList& list);
  /// Copies the history to the atoms. `keep`: the pairs stay valid.
  void hand_over(bool keep);

  std::vector<NearPair> pairs;
  std::vector<PairWake> wakes; ///< one per pair
  ContactList contacts, next;  ///< of the last step; the one under construction
  CandidateStore candidates;

  /// Once a step: frames of all bodies, ghosts as well, and their paths longer by dt (|v| + R |omega|): no matter of a
  /// body has moved farther.
  void update_bodies(double dt);
  const BodyFrame& frame(int i) const { return frame_[i]; }
  /// Local and ghost atoms, as of the list.
  int body_count() const { return static_cast<int>(path_.size()); }
  /// Length of the path of local or ghost atom i since the list was made [m].
  double path(int i) const { return path_[i]; }
  /// By how much it grew in this step [m].
  double last_step(int i) const { return last_step_[i]; }

  /// Makes `next` the contacts of the last step.
  void accept() { std::swap(contacts, next); }
  /// Numbers for f_cluster_history.
  void set_counts(int contacts_now, int near_now) {
    history_.contact_count = contacts_now;
    history_.near_pair_count = near_now;
  }
  double memory_usage() const;

 private:
  void take_history();

  FixBodies& bodies_;
  FixContactHistory& history_;
  bool live_ = false;
  int local_at_build_ = 0;
  std::vector<double> path_, last_step_;
  std::vector<BodyFrame> frame_;
};

} // namespace eccentra::cluster
