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
  bool direct;             ///< two single spheres: nothing to search
  RelativePose pose;       ///< at the last search
  float skin;              ///< relative motion since then that the candidates allow [m]
  float wake;              ///< without candidates: length of both bodies' paths that calls for a new search [m]
  float range;             ///< sum of the bounding radii [m]
  float bound_b;           ///< bounding radius of B [m]
  int candidate_first;     ///< into the candidate store
  int candidate_count;
  int candidate_room;
};

/// Contacts of one step in the order of the pairs, ids ascending within a pair.
struct ContactList {
  std::vector<int> first; ///< per pair, and one past the end
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
  ContactList contacts, next; ///< of the last step; the one under construction
  CandidateStore candidates;

  /// Once a step: frames of all bodies, ghosts as well, and their paths longer by dt (|v| + R |omega|): no matter of a
  /// body has moved farther.
  void update_bodies(float dt);
  const BodyFrame& frame(int i) const { return frame_[i]; }
  /// Length of the path of local or ghost atom i since the list was made [m].
  float path(int i) const { return path_[i]; }

  /// Makes `next` the contacts of the last step.
  void accept() { std::swap(contacts, next); }
  double memory_usage() const;

 private:
  void take_history();

  FixBodies& bodies_;
  FixContactHistory& history_;
  bool live_ = false;
  int local_at_build_ = 0;
  std::vector<float> path_;
  std::vector<BodyFrame> frame_;
};

} // namespace eccentra::cluster
