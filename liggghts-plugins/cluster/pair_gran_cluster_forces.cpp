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
  const int awake = near.find_awake(awake_.data());
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
  if (p.direct()) {
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
    if (p.candidate_count == 0) {
      const double between = std::sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]);
      const double room = (1 - round_off) * between - p.range();
      if (room > 0) {
        p.skin = 0;
        near_->note_apart(number, room);
        return 0;
      }
    }
    pose = pose_of(p, offset);
    float left = 0;
    if (p.skin > 0)
      left = p.skin - pose.moved_since(near_->searches[p.search].pose, static_cast<float>(p.bound_b()));
    if (left <= skin_used_up * p.skin) {
      search_candidates(p, pose, offset);
      left = p.skin;
    }
    near_->note_look(number, offset, left, p.candidate_count == 0);
  }
  if (p.candidate_count == 0)
    return 0;
  ++near_count_;
  const int* candidates = near_->candidates.at(p.candidate_first);
  const int count = p.candidate_count;
  if (count <= tested_at_once) {
    const Gathered found = gather(p, offset, candidates, count, old_first, old_last);
    if (found.count == 0) {
      // (d - s) (d + s) = least; no candidate is farther away than the pair's skin allows.
      const double widest = 2 * p.largest_reach() + 2 * p.skin;
      may_idle(number, offset, found.least / widest);
    }
    return found.count;
  }
  if (fresh)
    pose = pose_of(p, offset);
  const PosedShapes shapes = {*p.surface_a, *p.surface_b, static_cast<float>(p.extra_a + p.extra_b), pose};
  if (static_cast<int>(hits_.size()) < count)
    hits_.resize(2 * count);
  const int hits =
      overlapping_candidates(shapes, candidates, count, static_cast<float>(round_off * p.range()), hits_.data());
  if (hits > 0)
    return gather(p, offset, hits_.data(), hits, old_first, old_last).count;
  may_idle(number, offset, least_gap(shapes, candidates, count));
  return 0;
}

RelativePose PairGranCluster::pose_of(const NearPair& p, const double* offset) const {
  return {near_->body(p.a), near_->body(p.b), offset};
}

/// Lets a pair that has just been seen not to touch rest until its gap [m] can have closed, if that is worth while.
void PairGranCluster::may_idle(int number, const double* offset, double gap) {
  const NearPair& p = near_->pairs[number];
  const PairWake& wake = near_->wakes[number];
  gap -= round_off * p.range();
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
  const float margin = static_cast<float>(2 * round_off * p.range());
  const SearchResult found = search_.search(*p.surface_a, extra_a, *p.surface_b, extra_b, pose, skin + margin);
  if (p.search == NearPair::not_yet) {
    std::vector<PairSearch>& searches = near_->searches;
    p.search = static_cast<int>(searches.size());
    if (searches.size() == searches.capacity())
      searches.reserve(searches.size() + searches.size() / 4 + 64);
    searches.emplace_back();
  }
  PairSearch& search = near_->searches[p.search];
  p.skin = found.slack - margin;
  search.pose = pose;
  p.candidate_count = found.count;
  if (found.count > search.candidate_room) {
    // A little more, as what it grows out of is lost until the next list.
    search.candidate_room = found.count + found.count / 4 + 1;
    p.candidate_first = store.reserve(search.candidate_room);
  }
  std::copy(search_.found().begin(), search_.found().end(), store.at(p.candidate_first));
}

} // namespace eccentra::cluster
