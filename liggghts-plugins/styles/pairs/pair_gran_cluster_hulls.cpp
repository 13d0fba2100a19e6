// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of pair_style gran/cluster with a rounded body: features instead of sub-spheres, manifolds instead of the exact
// test, then the same law, history and sharing.
#include "styles/pairs/hull_contacts.h"
#include "styles/pairs/pair_gran_cluster.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

/// Cores deeper in each other than this part of the smaller body's bounding radius are beyond any contact law.
constexpr double kMaxSunk = 0.9;

int real_contacts(const std::vector<contact::Contact>& all, int first, int last) {
  return static_cast<int>(
      std::count_if(all.begin() + first, all.begin() + last, [](const contact::Contact& c) { return !c.elastic; }));
}

/// The row of a contact that is an elastic force alone.
ContactRecord record_of(const contact::Contact& contact, const NearPair& near, const Eigen::Vector3d& force,
                        const Eigen::Vector3d& torque) {
  ContactRecord row = {};
  row.a = near.a;
  row.b = near.b;
  row.sub_a = contact::feature_a(contact.id);
  row.sub_b = contact::feature_b(contact.id);
  row.overlap = contact.overlap();
  row.radius_a = contact.radius_a;
  row.radius_b = contact.reach - contact.radius_a;
  const Eigen::Vector3d arm = contact.contact_point();
  for (int k = 0; k < 3; ++k) {
    row.arm[k] = arm[k];
    row.normal[k] = contact.normal[k];
    row.force[k] = force[k];
    row.torque[k] = torque[k];
  }
  return row;
}

} // namespace

/// Lets a pair with a rounded body wait for its manifold.
void PairGranCluster::wait_hulls(int number, const NearPair& p, const contact::Double4& to_b) {
  if (waiting_.count() > 0) // contacts are noted in the order of the pairs
    evaluate_waiting();
  const double offset[3] = {to_b[0], to_b[1], to_b[2]};
  hulls_->manifolds.add(hulls_->pair(p, *near_, offset), near_->candidates.at(p.candidate_first), p.candidate_count);
  hulls_->waiting.emplace_back();
  WaitingPair& pair = hulls_->waiting.back();
  pair.to_b = to_b;
  pair.a = &near_->body(p.a);
  pair.b = &near_->body(p.b);
  pair.extra_a = pair.a->extra_radius;
  pair.extra_b = pair.b->extra_radius;
  pair.number = number;
  pair.may_idle = true;
  if (hulls_->manifolds.pairs() >= HullContacts::enough)
    evaluate_hulls();
}

/// Features of a pair that can touch soon; returns the relative motion that they allow [m].
float PairGranCluster::search_features(const NearPair& p, const double* offset, float skin) {
  return static_cast<float>(hulls_->search.search(hulls_->pair(p, *near_, offset), skin));
}

/// Finds the contacts of all pairs with rounded bodies that wait, and adds their forces.
void PairGranCluster::evaluate_hulls() {
  HullContacts& hulls = *hulls_;
  if (hulls.waiting.empty())
    return;
  hulls.manifolds.evaluate();
  const std::vector<contact::Contact>& all = hulls.manifolds.contacts();
  const std::size_t room = contact::ContactBlock::capacity + contact::contact_width;
  if (block_ids_.size() < room) {
    block_ids_.resize(room);
    block_pair_.resize(room);
  }
  pairs_in_block_ = filled_ = 0;
  hulls.corrections.clear();
  for (int n = 0; n < hulls.manifolds.pairs(); ++n) {
    WaitingPair& pair = hulls.waiting[n];
    const int first = hulls.manifolds.first(n), last = hulls.manifolds.first(n + 1);
    if (first == last) {
      const double offset[3] = {pair.to_b[0], pair.to_b[1], pair.to_b[2]};
      may_idle(pair.number, offset, hulls.manifolds.gap(n));
      continue;
    }
    const NearPair& near = near_->pairs[pair.number];
    if (hulls.manifolds.sunk(n) > kMaxSunk * std::min(near_->bound_a(near), near_->bound_b(near)))
      error->one(FLERR, ("pair_style gran/cluster: the bodies " + std::to_string(near_->tag(near.a)) + " and " +
                         std::to_string(near_->tag(near.b)) +
                         " have run into each other by most of their size: use a smaller time step (see fix "
                         "timestep/limit) or a larger Young's modulus")
                            .c_str());
    const int count = real_contacts(all, first, last);
    if (count > contact::ContactBlock::capacity) {
      finish_hull_block(block_);
      evaluate_large_hull(pair, all.data() + first, last - first, count);
      continue;
    }
    if (filled_ + count > contact::ContactBlock::capacity || pairs_in_block_ >= contact::ContactBlock::capacity)
      finish_hull_block(block_);
    add_hull_pair(block_, pair, all.data() + first, last - first);
  }
  finish_hull_block(block_);
  hulls.manifolds.clear();
  hulls.waiting.clear();
}

void PairGranCluster::evaluate_large_hull(WaitingPair& pair, const contact::Contact* contacts, int count, int real) {
  if (!large_block_)
    large_block_ = std::make_unique<contact::LargeContactBlock>();
  large_block_->reserve(real);
  const std::size_t room = real + 2 * contact::contact_width;
  if (block_ids_.size() < room) {
    block_ids_.resize(room);
    block_pair_.resize(room);
  }
  add_hull_pair(*large_block_, pair, contacts, count);
  finish_hull_block(*large_block_);
}

/// Writes the contacts of a pair to the block.
template <class Block>
void PairGranCluster::add_hull_pair(Block& c, WaitingPair& waiting, const contact::Contact* contacts, int count) {
  const NearPair& near = near_->pairs[waiting.number];
  const double youngs = materials_.value(0, waiting.a->type, waiting.b->type);
  HullContacts::Correction correction{pairs_in_block_, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  bool corrected = false;
  const int first = filled_;
  int m = first;
  for (int n = 0; n < count; ++n) {
    const contact::Contact& contact = contacts[n];
    const double overlap = contact.overlap();
    const double radius_a = hertz_radius(*waiting.a->surface, waiting.extra_a, contact.radius_a),
                 radius_b = hertz_radius(*waiting.b->surface, waiting.extra_b, contact.reach - contact.radius_a);
    const double stiffness = contact.weight * std::sqrt(radius_a * radius_b / (radius_a + radius_b) * overlap);
    if (contact.elastic) {
      const Eigen::Vector3d force = 4. / 3 * youngs * stiffness * overlap * contact.normal;
      correction.force += force;
      const Eigen::Vector3d torque = contact.contact_point().cross(force);
      correction.torque += torque;
      corrected = true;
      if (records_ && near.a < atom->nlocal)
        records_->rows.push_back(record_of(contact, near, force, torque));
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      c.normal[k][m] = contact.normal[k];
      c.arm[k][m] = contact.arm[k];
    }
    c.radius_a[m] = contact.radius_a;
    c.radius_b[m] = contact.reach - contact.radius_a; // for outputs alone
    c.overlap[m] = overlap;
    c.contact_radius[m] = stiffness;
    c.curvature[m] = 0;
    block_ids_[m] = contact.id;
    ++m;
  }
  if (corrected)
    hulls_->corrections.push_back(correction);
  waiting.last_contact = filled_ = m;
  add_pair(c, waiting, first);
}

/// Adds what is elastic alone to the forces of the pairs in the block.
void PairGranCluster::add_corrections() {
  for (const HullContacts::Correction& c : hulls_->corrections)
    for (int k = 0; k < 3; ++k) {
      sums_.force[k][c.pair] += c.force[k];
      sums_.torque[k][c.pair] += c.torque[k];
    }
}

template <class Block> void PairGranCluster::finish_hull_block(Block& c) {
  if (pairs_in_block_ > 0)
    finish_block<true>(c);
  pairs_in_block_ = filled_ = 0;
  hulls_->corrections.clear();
}

} // namespace eccentra::styles
