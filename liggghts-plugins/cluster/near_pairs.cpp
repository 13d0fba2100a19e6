// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the list of near pairs, and moves history between it and the atoms.
#include "cluster/near_pairs.h"

#include <mpi.h>

#include "atom.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace eccentra::cluster {

using namespace LAMMPS_NS;

void ContactList::clear(std::size_t pairs) {
  first.resize(pairs + 1);
  id.clear();
  for (auto& d : displacement)
    d.clear();
}

NearPairs::NearPairs(LAMMPS* lmp, FixBodies& bodies, FixContactHistory& history)
    : Pointers(lmp), bodies_(bodies), history_(history) {}

void NearPairs::rebuild(const NeighList& list) {
  pairs.clear();
  candidates.clear();
  const int* tag = atom->tag;
  const double* radius = atom->radius;
  const ShapeTable& shapes = bodies_.shapes();
  for (int n = 0; n < list.inum; ++n) {
    const int i = list.ilist[n];
    for (int m = 0; m < list.numneigh[i]; ++m) {
      const int j = list.firstneigh[i][m] & NEIGHMASK;
      const bool ordered = tag[i] <= tag[j];
      NearPair p;
      p.a = ordered ? i : j;
      p.b = ordered ? j : i;
      p.tag_a = tag[p.a];
      p.tag_b = tag[p.b];
      p.surface_a = &shapes.surface(bodies_.shape_id(p.a));
      p.surface_b = &shapes.surface(bodies_.shape_id(p.b));
      p.direct = p.surface_a->single_at_centre && p.surface_b->single_at_centre;
      p.extra_a = bodies_.extra_radius(p.a);
      p.extra_b = bodies_.extra_radius(p.b);
      p.bound_b = static_cast<float>(radius[p.b]);
      p.searched = false;
      p.skin = 0;
      p.stale = 0;
      p.range = radius[p.a] + radius[p.b];
      p.candidate_first = p.candidate_count = p.candidate_room = 0;
      pairs.push_back(p);
    }
  }
  // Images of the same two bodies (periodic, or a ghost of a body of our own) keep the order of their positions.
  double** x = atom->x;
  std::sort(pairs.begin(), pairs.end(), [x](const NearPair& p, const NearPair& q) {
    if (p.tag_a != q.tag_a)
      return p.tag_a < q.tag_a;
    if (p.tag_b != q.tag_b)
      return p.tag_b < q.tag_b;
    for (int k = 0; k < 3; ++k) {
      const double dp = x[p.b][k] - x[p.a][k], dq = x[q.b][k] - x[q.a][k];
      if (dp != dq)
        return dp < dq;
    }
    return p.a < q.a;
  });
  wakes.clear();
  for (const NearPair& p : pairs)
    wakes.push_back({p.a, p.b, 0});
  local_at_build_ = atom->nlocal;
  path_.assign(atom->nlocal + atom->nghost, 0.);
  last_step_.resize(path_.size());
  frame_.resize(path_.size());
  take_history();
  live_ = true;
}

void NearPairs::update_bodies(double dt) {
  const double *v = atom->v[0], *omega = atom->omega[0], *radius = atom->radius;
  const int bodies = static_cast<int>(path_.size());
  for (int i = 0; i < bodies; ++i)
    if (!bodies_.is_round(i))
      frame_[i] = BodyFrame(bodies_.rotation(i));
  double *path = path_.data(), *step = last_step_.data();
#pragma GCC ivdep
  for (int i = 0; i < bodies; ++i) {
    const double *u = v + 3 * i, *w = omega + 3 * i;
    step[i] = dt * (std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) +
                    radius[i] * std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]));
    path[i] += step[i];
  }
}

void NearPairs::take_history() {
  contacts.clear(pairs.size());
  std::vector<const Touch*> found;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const NearPair& p = pairs[n];
    contacts.first[n] = contacts.size();
    const bool a_is_local = p.a < atom->nlocal;
    const int partner = a_is_local ? p.tag_b : p.tag_a;
    found.clear();
    for (const Touch& touch : history_.touches(a_is_local ? p.a : p.b))
      if (touch.partner == partner)
        found.push_back(&touch);
    std::sort(found.begin(), found.end(), [](const Touch* s, const Touch* t) { return s->id < t->id; });
    for (const Touch* touch : found) {
      contacts.id.push_back(touch->id);
      for (int k = 0; k < 3; ++k)
        contacts.displacement[k].push_back(touch->displacement[k]);
    }
  }
  contacts.first[pairs.size()] = contacts.size();
  for (int i = 0; i < atom->nlocal; ++i)
    history_.touches(i).clear();
}

void NearPairs::hand_over(bool keep) {
  if (!live_)
    return;
  live_ = keep;
  for (int i = 0; i < atom->nlocal; ++i)
    history_.touches(i).clear();
  // Other fixes may have inserted or deleted atoms just before us: then the indices of the list are stale.
  std::unordered_map<int, int> moved;
  const auto owner = [&](int index, int tag) {
    if (index >= local_at_build_)
      return -1;
    if (index < atom->nlocal && atom->tag[index] == tag)
      return index;
    if (moved.empty())
      for (int i = 0; i < atom->nlocal; ++i)
        moved[atom->tag[i]] = i;
    const auto found = moved.find(tag);
    return found == moved.end() ? -1 : found->second;
  };
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const NearPair& p = pairs[n];
    for (int m = contacts.first[n]; m < contacts.first[n + 1]; ++m) {
      Touch touch = {p.tag_b, contacts.id[m], {}};
      for (int k = 0; k < 3; ++k)
        touch.displacement[k] = contacts.displacement[k][m];
      const int a = owner(p.a, p.tag_a), b = owner(p.b, p.tag_b);
      if (a >= 0)
        history_.touches(a).push_back(touch);
      touch.partner = p.tag_a;
      if (b >= 0)
        history_.touches(b).push_back(touch);
    }
  }
}

double NearPairs::memory_usage() const {
  const double contact_bytes = sizeof(int) + 3 * sizeof(double), candidate_bytes = 7 * sizeof(float) + sizeof(int);
  return static_cast<double>(pairs.capacity()) * (sizeof(NearPair) + sizeof(PairWake) + 2 * sizeof(int)) +
         static_cast<double>(contacts.id.capacity() + next.id.capacity()) * contact_bytes +
         static_cast<double>(candidates.id.capacity()) * candidate_bytes;
}

} // namespace eccentra::cluster
