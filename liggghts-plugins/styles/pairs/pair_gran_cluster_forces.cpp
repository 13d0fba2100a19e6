// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of pair_style gran/cluster over pairs of bodies: which need a look, and which of their sub-spheres may
// touch.
#include "styles/pairs/hull_contacts.h"
#include "styles/pairs/pair_gran_cluster.h"

#include "atom.h"
#include "error.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

/// More candidates than this are preselected in single precision; fewer are tested in double precision at once.
constexpr int tested_at_once = 4;

/// Candidates are sub-spheres closer than a skin: wide enough to last `skin_steps` steps of the present relative
/// motion, within these parts of the smallest sub-sphere's radius.
constexpr double skin_steps = 40;
constexpr double skin_narrowest = 0.02;
constexpr double skin_widest = 0.25;
/// Once so little of the skin is left, candidates are searched anew.
constexpr float skin_used_up = 0.1f;
/// A pair that is to cross the gap in fewer steps stays under watch.
constexpr double worth_idling = 4;
/// A step's path is taken from the velocities at its middle; this allows for its curvature.
constexpr double path_safety = 1.06;
/// Single precision preselects: round-off of coordinates, as part of the bounding radii.
constexpr double round_off = 1e-6;
/// So many pairs ahead data are asked for.
constexpr int prefetched_ahead = 8;

bool has_hull(const NearPairs& near, const NearPair& p) {
  return near.surface_a(p).hull || near.surface_b(p).hull;
}

} // namespace

void PairGranCluster::compute_force(int eflag, int vflag, int addflag) {
  if (addflag)
    error->all(FLERR,
               "compute pair/gran/local sees bodies, not sub-contacts, and cannot be used with gran/cluster; expected "
               "compute contact/cluster/local");
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = vflag_fdotr = 0;
  if (neighbor->ago == 0 || !near_->live())
    near_->rebuild(*list);

  if (stock_)
    stock_->begin_step();
  advance_ = shearupdate() && computeflag();
  NearPairs& near = *near_;
  const int pair_count = static_cast<int>(near.pairs.size());
  near.next.clear(pair_count);
  near.next.make_room(near.contacts.size());
  near_count_ = 0;
  outgrown_.clear();
  one_kind_ = false; // kinds are numbered anew with each list, and properties may change
  near.update_bodies(path_safety * update->dt, freeze_group_bit());
  if (hulls_)
    hulls_->begin_step(near.body_count());
  records_ = all_records_->wanted(update->ntimestep) ? all_records_ : nullptr;
  if (records_) {
    records_->begin(update->ntimestep);
    if (resting_)
      resting_->release(near);
  } else if (resting_) {
    rest();
  }

  // First which pairs need a look, so that what they need can be on its way when their turn comes.
  awake_.resize(pair_count);
  const int awake = near.find_awake(awake_.data());
  for (int k = 0; k < awake; ++k) {
    if (k + prefetched_ahead < awake) {
      const int ahead = awake_[k + prefetched_ahead];
      near.prefetch(ahead < 0 ? ~ahead : ahead);
    }
    const bool fresh = awake_[k] >= 0;
    look_at(fresh ? awake_[k] : ~awake_[k], fresh);
  }
  evaluate_waiting();
  near.next.counts_to_places();
  contact_count_ = near.next.size();
  near.add_forces();
  near.accept();
  if (resting_ && !records_)
    add_resting_forces();
  near.set_counts(contact_count_, near_count_);
}

/// Lets a pair wait with its `count` possible contacts, and evaluates all that wait once they are enough.
inline void PairGranCluster::wait(int number, const NearPair& p, const contact::Double4& to_b, const int* ids,
                                  int count, bool may_idle) {
  if (hulls_)
    evaluate_hulls(); // contacts are noted in the order of the pairs
  if (!waiting_.has_room(count))
    evaluate_waiting();
  WaitingPair& pair = waiting_.add(p.direct(), ids, count);
  pair.to_b = to_b;
  pair.a = &near_->body(p.a);
  pair.b = &near_->body(p.b);
  pair.spheres_a = pair.a->surface->sphere.data();
  pair.spheres_b = pair.b->surface->sphere.data();
  pair.extra_a = pair.a->extra_radius;
  pair.extra_b = pair.b->extra_radius;
  pair.number = number;
  pair.may_idle = may_idle;
  if (count > WaitingPairs::capacity)
    evaluate_large();
  else if (waiting_.candidates() >= WaitingPairs::enough)
    evaluate_waiting();
}

/// Lets a pair of bodies wait for the exact test of its candidates. `fresh`: they are still all that can touch.
void PairGranCluster::look_at(int number, bool fresh) {
  NearPair& p = near_->pairs[number];
  const contact::Double4 to_b = near_->offset(p);
  if (p.direct()) {
    static constexpr int only[contact::CandidateStore::chunk] = {contact::contact_id(0, 0)};
    wait(number, p, to_b, only, 1, true);
    return;
  }
  const double offset[3] = {to_b[0], to_b[1], to_b[2]};
  if (!fresh)
    renew_candidates(number, p, offset);
  if (p.candidate_count == 0)
    return;
  ++near_count_;
  if (hulls_ && has_hull(*near_, p)) {
    wait_hulls(number, p, to_b);
    return;
  }
  if (p.candidate_count <= tested_at_once)
    wait(number, p, to_b, near_->candidates.at(p.candidate_first), p.candidate_count, true);
  else if (const int hits = preselect(number, p, offset); hits > 0)
    wait(number, p, to_b, hits_.data(), hits, false);
}

/// Looks whether a pair's candidates still are all that can touch, and else for others.
void PairGranCluster::renew_candidates(int number, NearPair& p, const double* offset) {
  if (p.candidate_count == 0) {
    const double between = std::sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]);
    const double room = (1 - round_off) * between - near_->range(p) - gap_reached(p);
    if (room > 0) {
      p.skin = 0;
      near_->note_apart(number, room);
      return;
    }
  }
  const contact::RelativePose pose(near_->body(p.a), near_->body(p.b), offset);
  float left = 0;
  if (p.skin > 0)
    left = p.skin - pose.moved_since(near_->searches[p.search], static_cast<float>(near_->bound_b(p)));
  if (left <= skin_used_up * p.skin) {
    search_candidates(p, pose, offset);
    left = p.skin;
  }
  near_->note_look(number, offset, left, p.candidate_count == 0);
}

/// Puts those candidates of a pair that seem to touch in single precision into hits_; returns how many.
int PairGranCluster::preselect(int number, const NearPair& p, const double* offset) {
  const contact::BodyState &a = near_->body(p.a), &b = near_->body(p.b);
  const contact::RelativePose pose(a, b, offset);
  const int* candidates = near_->candidates.at(p.candidate_first);
  const int count = p.candidate_count;
  const contact::PosedShapes shapes = {*a.surface, *b.surface, static_cast<float>(a.extra_radius + b.extra_radius),
                                       pose};
  if (static_cast<int>(hits_.size()) < count + contact::CandidateStore::chunk)
    hits_.resize(2 * count + contact::CandidateStore::chunk);
  const int hits = contact::overlapping_candidates(
      shapes, candidates, count, static_cast<float>(round_off * near_->range(p) + gap_reached(p)), hits_.data());
  if (hits == 0)
    may_idle(number, offset, contact::min_gap(shapes, candidates, count) - gap_reached(p));
  return hits;
}

/// What the exact test, which has found no contact of the pair, tells about how long it may rest.
void PairGranCluster::not_touching(const WaitingPair& waiting, int number_waiting) {
  if (!waiting.may_idle)
    return;
  const NearPair& p = near_->pairs[waiting.number];
  const double offset[3] = {waiting.to_b[0], waiting.to_b[1], waiting.to_b[2]};
  const double* excess = waiting_.excess();
  double least = std::numeric_limits<double>::max();
  for (int n = waiting_.first_candidate(number_waiting); n < waiting.last_candidate; ++n)
    least = std::min(least, excess[n]);
  if (p.direct()) {
    const double sum = reach_ * near_->range(p);
    const double gap = std::sqrt(least + sum * sum) - sum;
    near_->note_look(waiting.number, offset, (1 - round_off) * gap, true);
    return;
  }
  // (d - s) (d + s) = least; no candidate is farther away than the pair's skin allows.
  const double widest = (1 + reach_) * near_->largest_reach(p) + gap_reached(p) + 2 * p.skin;
  may_idle(waiting.number, offset, least / widest);
}

/// Lets a pair that has just been seen not to touch rest until its gap [m] can have closed, if that is worth while.
void PairGranCluster::may_idle(int number, const double* offset, double gap) {
  const NearPair& p = near_->pairs[number];
  const PairWake& wake = near_->wakes[number];
  gap -= round_off * near_->range(p);
  if (gap > worth_idling * path_safety * update->dt * near_->relative_speed(p, offset))
    near_->note_look(number, offset, std::min(gap, static_cast<double>(wake.room - near_->moved_since_look(wake))),
                     true);
}

/// Finds the pairs of sub-spheres that can touch soon, with a skin that suits how fast the bodies move past each other.
void PairGranCluster::search_candidates(NearPair& p, const contact::RelativePose& pose, const double* offset) {
  contact::CandidateStore& store = near_->candidates;
  const contact::BodyState &a = near_->body(p.a), &b = near_->body(p.b);
  const float extra_a = static_cast<float>(a.extra_radius), extra_b = static_cast<float>(b.extra_radius);
  const double smallest =
      std::min(a.surface->smallest_radius + a.extra_radius, b.surface->smallest_radius + b.extra_radius);
  const double motion = update->dt * near_->relative_speed(p, offset);
  const float skin =
      static_cast<float>(std::clamp(skin_steps * motion, skin_narrowest * smallest, skin_widest * smallest));
  const float margin = static_cast<float>(2 * round_off * near_->range(p) + gap_reached(p));
  const bool hull = hulls_ && has_hull(*near_, p);
  contact::SearchResult found;
  if (hull) {
    found.slack = search_features(p, offset, skin + margin);
    found.count = static_cast<int>(hulls_->search.found().size());
  } else {
    found = search_.search(*a.surface, extra_a, *b.surface, extra_b, pose, skin + margin);
  }
  if (p.search == NearPair::not_yet) {
    std::vector<contact::RelativePose>& searches = near_->searches;
    p.search = static_cast<int>(searches.size());
    if (searches.size() == searches.capacity())
      searches.reserve(searches.size() + searches.size() / 4 + 64);
    searches.emplace_back();
  }
  p.skin = found.slack - margin;
  near_->searches[p.search] = pose;
  p.candidate_count = found.count;
  if (found.count > p.candidate_room) {
    // A little more, as what it grows out of is lost until the next list.
    p.candidate_room = found.count + found.count / 4 + 1;
    p.candidate_first = store.reserve(p.candidate_room);
  }
  const std::vector<int>& ids = hull ? hulls_->search.found() : search_.found();
  std::copy(ids.begin(), ids.end(), store.at(p.candidate_first));
}

} // namespace eccentra::styles
