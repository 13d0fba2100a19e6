// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which pairs rest, and the way of their contacts out of the list and back.
#include "styles/pairs/resting_pairs.h"

#include <algorithm>

namespace eccentra::styles {

void RestingPairs::keep(Kept kept) {
  if (free_slots_.empty()) {
    free_slots_.push_back(static_cast<int>(kept_.size()));
    kept_.emplace_back();
  }
  const int slot = free_slots_.back();
  free_slots_.pop_back();
  kept_of_pair_[kept.pair] = slot;
  contact_count_ += static_cast<int>(kept.contacts.size());
  kept_[slot] = std::move(kept);
}

void RestingPairs::list_pairs_of_bodies(const NearPairs& near, int bodies) {
  rests_.assign(bodies, 0);
  kept_of_pair_.assign(near.pairs.size(), moves);
  first_of_body_.assign(bodies + 1, 0);
  for (const NearPair& p : near.pairs) {
    ++first_of_body_[p.a + 1];
    ++first_of_body_[p.b + 1];
  }
  for (int i = 0; i < bodies; ++i)
    first_of_body_[i + 1] += first_of_body_[i];
  of_body_.resize(first_of_body_[bodies]);
  std::vector<int> next(first_of_body_.begin(), first_of_body_.end() - 1);
  for (std::size_t n = 0; n < near.pairs.size(); ++n) {
    of_body_[next[near.pairs[n].a]++] = static_cast<int>(n);
    of_body_[next[near.pairs[n].b]++] = static_cast<int>(n);
  }
}

const std::vector<int>& RestingPairs::update(NearPairs& near) {
  const int bodies = near.body_count();
  if (kept_of_pair_.empty())
    list_pairs_of_bodies(near, bodies);
  changed_.clear();
  woken_.clear();
  fresh_.clear();
  for (int i = 0; i < bodies; ++i) {
    const std::uint8_t rests = near.at_rest(i);
    if (rests != rests_[i]) {
      rests_[i] = rests;
      changed_.push_back(i);
    }
  }
  for (const int i : changed_)
    for (int m = first_of_body_[i]; m < first_of_body_[i + 1]; ++m) {
      const int n = of_body_[m];
      const bool rest = rests_[near.pairs[n].a] && rests_[near.pairs[n].b];
      if (rest && kept_of_pair_[n] == moves) {
        kept_of_pair_[n] = due;
        near.leave_alone(n);
        fresh_.push_back(n);
      } else if (!rest && kept_of_pair_[n] != moves) {
        near.look_again(n);
        woken_.push_back(n);
      }
    }
  std::sort(fresh_.begin(), fresh_.end());
  std::sort(woken_.begin(), woken_.end());
  woken_.erase(std::unique(woken_.begin(), woken_.end()), woken_.end());
  give_back(near);
  return fresh_;
}

/// The contacts of woken_ go back to near.contacts.
void RestingPairs::give_back(NearPairs& near) {
  if (woken_.empty())
    return;
  const ContactList& old = near.contacts;
  const int pairs = static_cast<int>(near.pairs.size());
  merged_.clear(pairs);
  merged_.width = old.width;
  const auto copy = [&](int first_pair, int last_pair) { // last_pair is not copied
    const int shift = merged_.size() - old.first[first_pair], first = old.first[first_pair];
    const int last = old.first[last_pair];
    for (int n = first_pair; n < last_pair; ++n)
      merged_.first[n] = old.first[n] + shift;
    merged_.id.insert(merged_.id.end(), old.id.begin() + first, old.id.begin() + last);
    for (int k = 0; k < 3; ++k)
      merged_.displacement[k].insert(merged_.displacement[k].end(), old.displacement[k].begin() + first,
                                     old.displacement[k].begin() + last);
    merged_.more.insert(merged_.more.end(), old.more.begin() + old.width * first, old.more.begin() + old.width * last);
  };
  int next = 0;
  for (const int n : woken_) {
    copy(next, n);
    merged_.first[n] = merged_.size();
    const int slot = kept_of_pair_[n];
    if (slot >= 0) {
      for (const Contact& contact : kept_[slot].contacts) {
        merged_.id.push_back(contact.id);
        for (int k = 0; k < 3; ++k)
          merged_.displacement[k].push_back(contact.displacement[k]);
        merged_.more.insert(merged_.more.end(), contact.more.begin(), contact.more.end());
      }
      contact_count_ -= static_cast<int>(kept_[slot].contacts.size());
      kept_[slot].contacts.clear();
      free_slots_.push_back(slot);
    }
    kept_of_pair_[n] = moves;
    next = n + 1;
  }
  copy(next, pairs);
  merged_.first[pairs] = merged_.size();
  std::swap(near.contacts, merged_);
}

void RestingPairs::sum_forces(const NearPairs& near, int local_bodies) {
  if (woken_.empty() && fresh_.empty())
    return;
  loads_.resize(local_bodies);
  for (const std::vector<int>* pairs : {&woken_, &fresh_})
    for (const int n : *pairs)
      for (const int i : {near.pairs[n].a, near.pairs[n].b})
        if (i < local_bodies)
          loads_[i].stale = true;
  for (int i = 0; i < local_bodies; ++i)
    if (loads_[i].stale)
      loads_[i] = load_of(near, i);
}

/// In the order of the pairs: the same digits on any number of ranks.
RestingPairs::Load RestingPairs::load_of(const NearPairs& near, int i) const {
  Load load;
  for (int m = first_of_body_[i]; m < first_of_body_[i + 1]; ++m) {
    const int slot = kept_of_pair_[of_body_[m]];
    if (slot < 0 || kept_[slot].contacts.empty())
      continue;
    load.any = true;
    const std::array<double, 6>& on = near.pairs[kept_[slot].pair].a == i ? kept_[slot].on_a : kept_[slot].on_b;
    for (int k = 0; k < 6; ++k)
      load.sum[k] += on[k];
  }
  return load;
}

void RestingPairs::add_forces(double* force, double* torque) const {
  for (std::size_t i = 0; i < loads_.size(); ++i)
    if (loads_[i].any)
      for (int k = 0; k < 3; ++k) {
        force[3 * i + k] += loads_[i].sum[k];
        torque[3 * i + k] += loads_[i].sum[3 + k];
      }
}

void RestingPairs::release(NearPairs& near) {
  woken_.clear();
  for (std::size_t n = 0; n < kept_of_pair_.size(); ++n)
    if (kept_of_pair_[n] != moves) {
      near.look_again(static_cast<int>(n));
      woken_.push_back(static_cast<int>(n));
    }
  give_back(near);
  kept_of_pair_.clear();
  kept_.clear();
  free_slots_.clear();
  loads_.clear();
  contact_count_ = 0;
}

} // namespace eccentra::styles
