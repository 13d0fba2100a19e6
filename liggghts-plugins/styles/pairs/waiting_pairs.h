// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of bodies whose candidates wait for the exact test, so that it runs over the candidates of many pairs at once.
#pragma once

#include "contact/contact_law.h"
#include "styles/pairs/near_pairs.h"

#include <array>
#include <cstring>
#include <vector>

namespace eccentra::styles {

/// What the exact test asks of a pair, together.
struct WaitingPair {
  contact::Double4 to_b; ///< from A's centre to B's [m]; fourth lane: anything
  const contact::BodyState *a, *b;
  const contact::Double4 *spheres_a, *spheres_b; ///< of their shapes
  double extra_a, extra_b;                       ///< added to radii [m]
  int number;                                    ///< of the pair
  bool may_idle;                                 ///< all that is near waits here: if nothing touches, the pair may rest
  int last_candidate;                            ///< one past its last among those that wait
  int last_contact;                              ///< the same among those of them that touch, once known
};

/// Pairs in the order in which they came, with their candidates one after the other.
class WaitingPairs {
 public:
  /// Of single pairs more may wait, alone.
  static constexpr int capacity = contact::ContactBlock::capacity;
  /// So many are evaluated together: enough to fill vectors, few enough to stay in the first-level cache.
  static constexpr int enough = 32;

  int count() const { return count_; }
  int candidates() const { return candidates_; }
  bool has_room(int candidates) const { return candidates_ + candidates <= capacity; }
  /// True if all of them are of two single spheres: candidate n is then that of pair n.
  bool all_direct() const { return direct_ == count_; }
  void clear() { count_ = candidates_ = direct_ = 0; }

  /// Adds a pair; the caller fills in the first of its members, one by one (a whole struct would be put together in
  /// memory and read back before it has arrived there). `ids`: the contact_id of its candidates, readable up to the
  /// next multiple of CandidateStore::chunk.
  WaitingPair& add(bool direct, const int* ids, int count) {
    constexpr int chunk = contact::CandidateStore::chunk;
    const std::size_t room = candidates_ + count + chunk;
    if (ids_.size() < room) {
      ids_.resize(room);
      pair_of_.resize(room);
      excess_.resize(room);
    }
    // A whole chunk is copied as fast as a part of it, and without a guess at its length.
    int *to = ids_.data() + candidates_, *pair_of = pair_of_.data() + candidates_;
    const int number = count_;
    for (int start = 0; start < count; start += chunk) {
      std::memcpy(to + start, ids + start, chunk * sizeof(int));
      for (int k = 0; k < chunk; ++k)
        pair_of[start + k] = number;
    }
    candidates_ += count;
    direct_ += direct;
    WaitingPair& pair = pairs_[count_++];
    pair.last_candidate = candidates_;
    return pair;
  }

  WaitingPair& pair(int k) { return pairs_[k]; }
  int first_candidate(int k) const { return k > 0 ? pairs_[k - 1].last_candidate : 0; }
  /// Per candidate: its contact_id, its pair, and (room for) distance^2 - (sum of radii)^2 [m2].
  const int* ids() const { return ids_.data(); }
  const int* pair_of() const { return pair_of_.data(); }
  double* excess() { return excess_.data(); }

 private:
  std::array<WaitingPair, capacity> pairs_;
  int count_ = 0, candidates_ = 0, direct_ = 0;
  std::vector<int> ids_, pair_of_;
  std::vector<double> excess_;
};

} // namespace eccentra::styles
