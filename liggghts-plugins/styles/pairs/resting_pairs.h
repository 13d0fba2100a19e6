// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of bodies of which neither moves: their contacts and forces are kept instead of computed (fix sleep/cluster).
#pragma once

#include "styles/pairs/near_pairs.h"

#include <array>
#include <cstdint>
#include <vector>

namespace eccentra::styles {

/// A body rests in a step if its velocity and spin are exactly 0, as fix sleep/cluster leaves them. That is known of
/// ghosts, too, so ranks agree without a message. A pair that rests leaves the list of contacts; as soon as one of its
/// bodies moves, its contacts go back there with their history.
class RestingPairs {
 public:
  struct Contact {
    int id;
    double displacement[3];
    std::vector<double> more; ///< ContactList::width values
  };
  struct Kept {
    int pair = 0;
    std::vector<Contact> contacts;
    std::array<double, 6> on_a{}, on_b{}; ///< force [N], torque [N m] on local bodies
    double offset[3];                     ///< from A's centre to B's [m]
  };

  /// Compares with the last step: contacts of pairs that no longer rest go back to near.contacts. Returns the pairs
  /// that rest from now on, for which keep() is due, in ascending order. Call after near.update_bodies().
  const std::vector<int>& update(NearPairs& near);
  void keep(Kept kept);
  /// Call after the last keep() of a step.
  void sum_forces(const NearPairs& near, int local_bodies);
  /// Adds what is kept to the forces and torques of local bodies.
  void add_forces(double* force, double* torque) const;
  /// All contacts go back to near.contacts; the next update() starts from nothing.
  void release(NearPairs& near);
  /// Calls visit(kept) for each pair that rests and touches.
  template <class Visit> void for_each(Visit visit) const {
    for (const Kept& kept : kept_)
      if (!kept.contacts.empty())
        visit(kept);
  }
  int contact_count() const { return contact_count_; }

 private:
  static constexpr int moves = -2, due = -1; ///< instead of a slot in kept_
  /// What the pairs that rest do to one body.
  struct Load {
    std::array<double, 6> sum{};
    bool any = false, stale = false;
  };
  Load load_of(const NearPairs& near, int i) const;
  void list_pairs_of_bodies(const NearPairs& near, int bodies);
  void give_back(NearPairs& near);

  std::vector<std::uint8_t> rests_;          ///< per body, local and ghost
  std::vector<int> first_of_body_, of_body_; ///< pairs of each body
  std::vector<int> kept_of_pair_;            ///< slot in kept_; or see above
  std::vector<Kept> kept_;
  std::vector<int> free_slots_;
  std::vector<int> changed_, woken_, fresh_;
  std::vector<Load> loads_; ///< per local body
  ContactList merged_;
  int contact_count_ = 0;
};

} // namespace eccentra::styles
