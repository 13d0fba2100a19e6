// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the list of near pairs, and moves history between it and the atoms.
#include "styles/pairs/near_pairs.h"

#include <mpi.h>

#include "atom.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <unordered_map>

namespace eccentra::styles {

using namespace LAMMPS_NS;

void ContactList::clear(std::size_t pairs) {
  first.assign(pairs + 1, 0);
  id.clear();
  for (auto& d : displacement)
    d.clear();
  more.clear();
}

void ContactList::counts_to_places() {
  int sum = 0;
  for (int& f : first)
    f = sum += f;
}

void ContactList::make_room(std::size_t count) {
  const std::size_t room = count + count / 8 + 8; // contacts come and go
  const auto fit = [room](auto& v) {
    if (v.capacity() > 2 * room)
      std::remove_reference_t<decltype(v)>().swap(v);
    v.reserve(room);
  };
  fit(id);
  for (auto& d : displacement)
    fit(d);
  more.reserve(width * room);
}

namespace {

/// Frees the memory of contacts that nobody needs any more.
void give_back(ContactList& list) {
  std::vector<int>().swap(list.id);
  for (auto& d : list.displacement)
    std::vector<double>().swap(d);
  std::vector<double>().swap(list.more);
}

} // namespace

NearPairs::NearPairs(LAMMPS* lmp, FixClusterBodies& bodies, FixClusterHistory& history)
    : Pointers(lmp), bodies_(bodies), history_(history) {}

void NearPairs::rebuild(const NeighList& list) {
  std::size_t count = 0;
  for (int n = 0; n < list.inum; ++n)
    count += list.numneigh[list.ilist[n]];
  pairs.clear();
  pairs.reserve(count); // growing would need room for twice as many
  candidates.clear();
  searches.clear();
  local_at_build_ = atom->nlocal;
  begin_bodies();
  const int* tag = atom->tag;
  for (int n = 0; n < list.inum; ++n) {
    const int i = list.ilist[n];
    for (int m = 0; m < list.numneigh[i]; ++m) {
      const int j = list.firstneigh[i][m] & NEIGHMASK;
      const bool ordered = tag[i] <= tag[j];
      NearPair p;
      p.a = ordered ? i : j;
      p.b = ordered ? j : i;
      p.search =
          surface_a(p).single_at_centre && surface_b(p).single_at_centre ? NearPair::needless : NearPair::not_yet;
      pairs.push_back(p);
    }
  }
  // Images of the same two bodies (periodic, or a ghost of a body of our own) keep the order of their positions.
  double** x = atom->x;
  std::sort(pairs.begin(), pairs.end(), [x, tag](const NearPair& p, const NearPair& q) {
    if (tag[p.a] != tag[q.a])
      return tag[p.a] < tag[q.a];
    if (tag[p.b] != tag[q.b])
      return tag[p.b] < tag[q.b];
    for (int k = 0; k < 3; ++k) {
      const double dp = x[p.b][k] - x[p.a][k], dq = x[q.b][k] - x[q.a][k];
      if (dp != dq)
        return dp < dq;
    }
    return p.a < q.a;
  });
  wakes.clear();
  idle.assign(pairs.size(), 0);
  wakes.reserve(pairs.size());
  for (const NearPair& p : pairs) {
    wakes.emplace_back();
    wakes.back().a = p.a;
    wakes.back().b = p.b;
  }
  time_ = 0;
  new_list_ = true;
  take_history();
  live_ = true;
}

/// What stays as it is until the next list.
void NearPairs::begin_bodies() {
  const int bodies = atom->nlocal + atom->nghost;
  change_.assign(bodies, {0, 0});
  bodies_now_.assign(bodies, contact::BodyState());
  kind_.resize(bodies);
  forces_.resize(local_at_build_ + 1);
  for (int i = 0; i < bodies; ++i) {
    contact::BodyState& body = bodies_now_[i];
    body.surface = &bodies_.shapes().surface(bodies_.shape_id(i));
    body.extra_radius = bodies_.extra_radius(i);
    body.tag = atom->tag[i];
  }
}

void NearPairs::update_bodies(double dt, int held_groups) {
  const double *x = atom->x[0], *v = atom->v[0], *omega = atom->omega[0]; // LIGGGHTS keeps rows one after the other
  const int bodies = static_cast<int>(bodies_now_.size());
  time_ += static_cast<float>(dt);
  if (new_list_)
    kinds_.clear();
  for (int i = 0; i < bodies; ++i) {
    contact::BodyState& body = bodies_now_[i];
    const contact::SurfaceSpheres& surface = *body.surface;
    if (new_list_) {
      constexpr double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
      body.turn(straight); // of round bodies for good: others are seen from their frame
      body.mass = atom->rmass[i];
      body.type = atom->type[i];
      body.held = (atom->mask[i] & held_groups) != 0;
      kind_[i] = kinds_.number({body.mass, body.type, body.held, &surface}, i);
      for (int k = 0; k < 3; ++k) {
        body.inverse_inertia[k] = surface.inverse_inertia[k];
        body.v[k] = v[3 * i + k];
        body.omega[k] = omega[3 * i + k];
      }
    }
    double dv = 0, dw = 0, ww = 0;
    for (int k = 0; k < 3; ++k) {
      const double u = v[3 * i + k], w = omega[3 * i + k];
      dv += (u - body.v[k]) * (u - body.v[k]);
      dw += (w - body.omega[k]) * (w - body.omega[k]);
      ww += w * w;
      body.x[k] = x[3 * i + k];
      body.v[k] = u;
      body.omega[k] = w;
    }
    change_[i].speed += static_cast<float>(std::sqrt(dv));
    change_[i].turning += static_cast<float>(std::sqrt(dw) + ww * dt);
    if (surface.single_at_centre)
      continue;
    body.turn(bodies_.rotation(i));
    if (!surface.equal_moments)
      body.turn_inertia(surface.inverse_inertia);
  }
  new_list_ = false;
  std::fill(forces_.begin(), forces_.end(), contact::BodyForce());
}

// As short as can be: each step asks all pairs.
int NearPairs::find_awake(int* out) const {
  const VelocityChange* change = change_.data();
  const PairWake* wake = wakes.data();
  const char* rests = idle.data();
  const float now = time_;
  const int count = static_cast<int>(pairs.size());
  int awake = 0;
  for (int n = 0; n < count; ++n) {
    const PairWake& w = wake[n];
    const VelocityChange &a = change[w.a], &b = change[w.b];
    const float moved =
        (now - w.since) * (w.speed + (a.speed + b.speed - w.changed) + (a.turning + b.turning - w.turned) * w.reach);
    const int stale = moved < w.room ? 0 : -1;
    out[awake] = n ^ stale;
    awake += 1 - (rests[n] & ~stale);
  }
  return awake;
}

void NearPairs::add_forces() const {
  for (int i = 0; i < atom->nlocal; ++i)
    for (int k = 0; k < 3; ++k) {
      atom->f[i][k] += forces_[i].force[k];
      atom->torque[i][k] += forces_[i].torque[k];
    }
}

// The velocity of B's matter at r from B's centre, in a frame that moves and turns with A, is u + (w_B - w_A) x r with
// u = v_B - v_A - w_A x d, d from A's centre to B's. Two round bodies need no turning frame: u = v_B - v_A.
double NearPairs::relative_speed(const NearPair& p, const double* offset) const {
  if (p.direct())
    return speed_of_centres(p);
  const contact::BodyState &a = bodies_now_[p.a], &b = bodies_now_[p.b];
  const double *va = a.v, *vb = b.v, *wa = a.omega, *wb = b.omega;
  const double v[3] = {vb[0] - va[0], vb[1] - va[1], vb[2] - va[2]};
  const double u[3] = {v[0] - (wa[1] * offset[2] - wa[2] * offset[1]), v[1] - (wa[2] * offset[0] - wa[0] * offset[2]),
                       v[2] - (wa[0] * offset[1] - wa[1] * offset[0])};
  const double w[3] = {wb[0] - wa[0], wb[1] - wa[1], wb[2] - wa[2]};
  return std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) +
         bound_b(p) * std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
}

double NearPairs::speed_of_centres(const NearPair& p) const {
  const double *va = bodies_now_[p.a].v, *vb = bodies_now_[p.b].v;
  const double v[3] = {vb[0] - va[0], vb[1] - va[1], vb[2] - va[2]};
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// d|u|/dt <= |a_A| + |a_B| + (|alpha_A| + w_A^2) |d|: the rest of du/dt, w_A x u, only turns u.
void NearPairs::note_look(int pair, const double* offset, double room, bool may_rest) {
  const NearPair& p = pairs[pair];
  PairWake& wake = wakes[pair];
  idle[pair] = may_rest;
  wake.since = time_;
  wake.speed = static_cast<float>(relative_speed(p, offset));
  wake.changed = change_[p.a].speed + change_[p.b].speed;
  wake.turned = change_[p.a].turning + change_[p.b].turning;
  wake.reach = 0;
  if (!p.direct())
    wake.reach = static_cast<float>(std::sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]) +
                                    room + bound_b(p));
  wake.room = static_cast<float>(room);
}

void NearPairs::note_apart(int pair, double room) {
  const NearPair& p = pairs[pair];
  PairWake& wake = wakes[pair];
  idle[pair] = 1;
  wake.since = time_;
  wake.speed = static_cast<float>(speed_of_centres(p));
  wake.changed = change_[p.a].speed + change_[p.b].speed;
  wake.turned = wake.reach = 0;
  wake.room = static_cast<float>(room);
}

void NearPairs::take_history() {
  contacts.clear(pairs.size());
  // Lists that grow as they are filled would take up to twice the memory.
  std::size_t count = 0;
  for (const NearPair& p : pairs) {
    const bool a_is_local = p.a < atom->nlocal;
    const int partner = tag(a_is_local ? p.b : p.a);
    for (const Touch& touch : history_.touches(a_is_local ? p.a : p.b))
      count += touch.partner == partner;
  }
  contacts.make_room(count);
  std::vector<const Touch*> found;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const NearPair& p = pairs[n];
    contacts.first[n] = contacts.size();
    const bool a_is_local = p.a < atom->nlocal;
    const int partner = tag(a_is_local ? p.b : p.a);
    found.clear();
    for (const Touch& touch : history_.touches(a_is_local ? p.a : p.b))
      if (touch.partner == partner)
        found.push_back(&touch);
    std::sort(found.begin(), found.end(), [](const Touch* s, const Touch* t) { return s->id < t->id; });
    for (const Touch* touch : found) {
      contacts.id.push_back(touch->id);
      for (int k = 0; k < 3; ++k)
        contacts.displacement[k].push_back(touch->displacement[k]);
      if (contacts.width > 0) {
        const int i = a_is_local ? p.a : p.b;
        const std::vector<Touch>& touches = history_.touches(i);
        const std::vector<double>& values = history_.more(i);
        const std::size_t width = values.size() / touches.size(), at = width * (touch - touches.data());
        for (std::size_t k = 0; k < static_cast<std::size_t>(contacts.width); ++k)
          contacts.more.push_back(k < width ? values[at + k] : 0); // an earlier model may have remembered less
      }
    }
  }
  contacts.first[pairs.size()] = contacts.size();
  for (int i = 0; i < atom->nlocal; ++i)
    history_.touches(i) = std::vector<Touch>(); // its memory, too
  for (int i = 0; i < atom->nlocal; ++i)
    history_.more(i) = std::vector<double>();
}

void NearPairs::hand_over(bool keep) {
  if (!live_)
    return;
  live_ = keep;
  give_back(next); // its memory is about to be needed
  if (!keep) {
    candidates = contact::CandidateStore();
    std::vector<contact::RelativePose>().swap(searches);
  }
  for (int i = 0; i < atom->nlocal; ++i)
    history_.touches(i).clear();
  for (int i = 0; i < atom->nlocal; ++i)
    history_.more(i).clear();
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
  // First how many, as growing lists would take twice the memory.
  std::vector<int> of_atom(atom->nlocal, 0);
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const int count = contacts.first[n + 1] - contacts.first[n];
    if (count > 0)
      for (const int i : {owner(pairs[n].a, tag(pairs[n].a)), owner(pairs[n].b, tag(pairs[n].b))})
        if (i >= 0)
          of_atom[i] += count;
  }
  for (int i = 0; i < atom->nlocal; ++i)
    history_.touches(i).reserve(of_atom[i]);
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const NearPair& p = pairs[n];
    for (int m = contacts.first[n]; m < contacts.first[n + 1]; ++m) {
      Touch touch = {tag(p.b), contacts.id[m], {}};
      for (int k = 0; k < 3; ++k)
        touch.displacement[k] = contacts.displacement[k][m];
      const int a = owner(p.a, tag(p.a)), b = owner(p.b, tag(p.b));
      const auto hand_to = [&](int i) {
        history_.touches(i).push_back(touch);
        const auto values = contacts.more.begin() + contacts.width * m;
        history_.more(i).insert(history_.more(i).end(), values, values + contacts.width);
      };
      if (a >= 0)
        hand_to(a);
      touch.partner = tag(p.a);
      if (b >= 0)
        hand_to(b);
    }
  }
}

double NearPairs::memory_usage() const {
  const double contact_bytes = sizeof(int) + (3 + contacts.width) * sizeof(double);
  return static_cast<double>(pairs.capacity()) * (sizeof(NearPair) + sizeof(PairWake) + 2 * sizeof(int)) +
         static_cast<double>(contacts.id.capacity() + next.id.capacity()) * contact_bytes +
         static_cast<double>(candidates.bytes()) +
         static_cast<double>(searches.capacity()) * sizeof(contact::RelativePose);
}

} // namespace eccentra::styles
