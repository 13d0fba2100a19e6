// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of pair_style gran/cluster over pairs of bodies: which need a look, and which of their sub-spheres may
// touch.
#include "cluster/pair_gran_cluster.h"

#include "atom.h"
#include "error.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

namespace eccentra::cluster {

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
constexpr int prefetched_ahead = 3;

} // namespace

void PairGranCluster::compute_force(int eflag, int vflag, int addflag) {
  if (addflag)
    error->all(FLERR, "compute pair/gran/local sees bodies, not sub-contacts, and cannot be used with gran/cluster");
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = vflag_fdotr = 0;
  if (neighbor->ago == 0 || !near_->live())
    near_->rebuild(*list);

  advance_ = shearupdate() && computeflag();
  NearPairs& near = *near_;
  const int pair_count = static_cast<int>(near.pairs.size());
  near.next.clear(pair_count);
  filled_ = pairs_in_block_ = contact_count_ = near_count_ = 0;
  near.update_bodies(path_safety * update->dt, freeze_group_bit());
  if (resting_)
    rest();

  int* first = near.next.first.data();
  const int* old_first = near.contacts.first.data();
  // First which pairs need a look, so that what they need can be on its way when their turn comes.
  awake_.resize(pair_count);
  int awake = 0;
  for (int n = 0; n < pair_count; ++n) {
    const PairWake& wake = near.wakes[n];
    const bool fresh = near.moved_since_look(wake) < wake.room;
    awake_[awake] = fresh ? n : ~n;
    awake += !(fresh && near.idle[n]);
  }
  int next = 0; // pair whose place among the contacts is not known yet
  for (int k = 0; k < awake; ++k) {
    if (k + prefetched_ahead < awake) {
      const int ahead = awake_[k + prefetched_ahead];
      near.prefetch(ahead < 0 ? ~ahead : ahead);
    }
    const bool fresh = awake_[k] >= 0;
    const int n = fresh ? awake_[k] : ~awake_[k];
    while (next <= n)
      first[next++] = contact_count_;
    const double *xa = near.body(near.wakes[n].a).x, *xb = near.body(near.wakes[n].b).x;
    const double offset[3] = {xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]};
    contact_count_ += pair_contacts(n, fresh, offset, old_first[n], old_first[n + 1]);
  }
  flush();
  while (next <= pair_count)
    first[next++] = contact_count_;
  near.add_forces();
  near.accept();
  if (resting_)
    add_resting_forces();
  near.set_counts(contact_count_, near_count_);
}

/// Puts the contacts of a pair of bodies into the block; returns how many there are. `fresh`: the candidates are still
/// all that can touch.
int PairGranCluster::pair_contacts(int number, bool fresh, const double* offset, int old_first, int old_last) {
  NearPair& p = near_->pairs[number];
  if (p.direct) {
    const int only = contact_id(0, 0);
    const Gathered found = gather(p, offset, &only, 1, old_first, old_last);
    if (found.count == 0) {
      const double sum = p.surface_a->bounding_radius + p.extra_a + p.surface_b->bounding_radius + p.extra_b;
      const double gap = std::sqrt(found.least + sum * sum) - sum;
      near_->note_look(number, offset, (1 - round_off) * gap, true);
    }
    return found.count;
  }
  RelativePose pose;
  if (!fresh) {
    pose = pose_of(p, offset);
    float left = p.searched ? p.skin - pose.moved_since(p.pose, p.bound_b) : 0;
    if (left <= skin_used_up * p.skin) {
      search_candidates(p, pose, offset);
      left = p.skin;
    }
    near_->note_look(number, offset, left, p.candidate_count == 0);
  }
  if (p.candidate_count == 0)
    return 0;
  ++near_count_;
  CandidateStore& candidates = near_->candidates;
  if (p.candidate_count <= tested_at_once) {
    const Gathered found =
        gather(p, offset, candidates.id.data() + p.candidate_first, p.candidate_count, old_first, old_last);
    if (found.count == 0) {
      // (d - s) (d + s) = least; no candidate is farther away than the pair's skin allows.
      const double widest = 2 * p.largest_reach + 2 * p.skin;
      may_idle(number, offset, found.least / widest);
    }
    return found.count;
  }
  if (fresh)
    pose = pose_of(p, offset);
  const int padded = CandidateSearch::padded(p.candidate_count);
  if (static_cast<int>(hits_.size()) < padded)
    hits_.resize(2 * padded);
  const int hits = overlapping_candidates(candidates, p.candidate_first, padded, pose,
                                          static_cast<float>(round_off * p.range), hits_.data());
  if (hits > 0)
    return gather(p, offset, hits_.data(), hits, old_first, old_last).count;
  may_idle(number, offset, least_gap(candidates, p.candidate_first, padded, pose));
  return 0;
}

RelativePose PairGranCluster::pose_of(const NearPair& p, const double* offset) const {
  return {near_->body(p.a), near_->body(p.b), offset};
}

/// Lets a pair that has just been seen not to touch rest until its gap [m] can have closed, if that is worth while.
void PairGranCluster::may_idle(int number, const double* offset, double gap) {
  const NearPair& p = near_->pairs[number];
  const PairWake& wake = near_->wakes[number];
  gap -= round_off * p.range;
  if (gap > worth_idling * path_safety * update->dt * near_->relative_speed(p, offset))
    near_->note_look(number, offset, std::min(gap, static_cast<double>(wake.room - near_->moved_since_look(wake))),
                     true);
}

/// Finds the pairs of sub-spheres that can touch soon, with a skin that suits how fast the bodies move past each other.
void PairGranCluster::search_candidates(NearPair& p, const RelativePose& pose, const double* offset) {
  CandidateStore& store = near_->candidates;
  const float extra_a = static_cast<float>(p.extra_a), extra_b = static_cast<float>(p.extra_b);
  const double smallest = std::min(p.surface_a->smallest_radius + p.extra_a, p.surface_b->smallest_radius + p.extra_b);
  const double motion = update->dt * near_->relative_speed(p, offset);
  const float skin =
      static_cast<float>(std::clamp(skin_steps * motion, skin_narrowest * smallest, skin_widest * smallest));
  const float margin = static_cast<float>(2 * round_off * p.range);
  const SearchResult found = search_.search(*p.surface_a, extra_a, *p.surface_b, extra_b, pose, skin + margin);
  p.searched = true;
  p.skin = found.slack - margin;
  p.pose = pose;
  p.candidate_count = found.count;
  const int room = CandidateSearch::padded(found.count);
  if (room > p.candidate_room) {
    p.candidate_first = store.reserve(room);
    p.candidate_room = room;
  }
  if (found.count > 0)
    search_.write(*p.surface_a, extra_a, *p.surface_b, extra_b, store, p.candidate_first);
}

} // namespace eccentra::cluster
