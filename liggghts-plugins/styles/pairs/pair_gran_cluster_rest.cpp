// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs that rest, as pair_style gran/cluster treats them: evaluated once, then their forces are added as they are.
#include "styles/pairs/pair_gran_cluster.h"

#include "atom.h"

#include <utility>

namespace eccentra::styles {

/// Before the loop over all pairs: those that rest from now on are evaluated and leave it, others come back.
void PairGranCluster::rest() {
  const std::vector<int>& fresh = resting_->update(*near_);
  const bool advance = advance_;
  const int evaluated_flag = evflag;
  advance_ = false; // nothing moves, so nothing slides
  evflag = 0;       // tallied with all that rest
  for (const int n : fresh)
    resting_->keep(evaluate_alone(n));
  advance_ = advance;
  evflag = evaluated_flag;
  near_count_ = 0;
  resting_->sum_forces(*near_, atom->nlocal);
}

/// Contacts and forces of pair n by itself; near_->next and the forces of its bodies are as before.
RestingPairs::Kept PairGranCluster::evaluate_alone(int n) {
  const NearPair& p = near_->pairs[n];
  RestingPairs::Kept kept;
  kept.pair = n;
  for (int k = 0; k < 3; ++k)
    kept.offset[k] = near_->body(p.b).x[k] - near_->body(p.a).x[k];
  const int bodies[2] = {p.a, p.b};
  contact::BodyForce before[2];
  for (int s = 0; s < 2; ++s)
    before[s] = std::exchange(near_->force(bodies[s]), contact::BodyForce());
  ContactList& next = near_->next;
  const int before_it = next.size();
  look_at(n, false);
  evaluate_waiting();
  const int count = next.size() - before_it;
  next.first[n + 1] = 0;
  near_->leave_alone(n);
  for (int m = next.size() - count; m < next.size(); ++m) {
    const auto more = next.more.begin() + next.width * m;
    kept.contacts.push_back({next.id[m],
                             {next.displacement[0][m], next.displacement[1][m], next.displacement[2][m]},
                             {more, more + next.width}});
  }
  next.more.resize(next.more.size() - next.width * count);
  next.id.resize(next.id.size() - count);
  for (auto& d : next.displacement)
    d.resize(d.size() - count);
  for (int s = 0; s < 2; ++s) {
    const contact::BodyForce acting = std::exchange(near_->force(bodies[s]), before[s]);
    std::array<double, 6>& on = s == 0 ? kept.on_a : kept.on_b;
    for (int k = 0; k < 3; ++k) {
      on[k] = acting.force[k];
      on[3 + k] = acting.torque[k];
    }
  }
  return kept;
}

void PairGranCluster::add_resting_forces() {
  resting_->add_forces(atom->f[0], atom->torque[0]);
  contact_count_ += resting_->contact_count();
  if (evflag)
    resting_->for_each([this](const RestingPairs::Kept& kept) {
      const NearPair& p = near_->pairs[kept.pair];
      // What acts on a ghost alone is not kept: both see the opposite of each other's force.
      const bool a_is_local = p.a < atom->nlocal;
      const double* f = a_is_local ? kept.on_a.data() : kept.on_b.data();
      const double sign = a_is_local ? 1 : -1;
      ev_tally_xyz(p.a, p.b, atom->nlocal, 0, 0., 0., sign * f[0], sign * f[1], sign * f[2], -kept.offset[0],
                   -kept.offset[1], -kept.offset[2]);
    });
}

} // namespace eccentra::styles
