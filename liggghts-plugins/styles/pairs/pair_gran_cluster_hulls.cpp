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
  if (add_boxes(number, p, to_b))
    return;
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
    take_manifolds();
}

/// Two boxes whose cores do not overlap: their contacts go straight to the block. False for other pairs.
bool PairGranCluster::add_boxes(int number, const NearPair& p, const contact::Double4& to_b) {
  const contact::ContactCore &core_a = near_->surface_a(p).core, &core_b = near_->surface_b(p).core;
  if (core_a.solid != contact::SolidKind::box || core_b.solid != contact::SolidKind::box)
    return false;
  const int* candidates = near_->candidates.at(p.candidate_first);
  if (candidates[p.candidate_count - 1] == contact::feature_id(core_a.solid_feature(), core_b.solid_feature())) {
    const double offset[3] = {to_b[0], to_b[1], to_b[2]};
    const contact::BodyPair pair = hulls_->pair(p, *near_, offset);
    if (contact::boxes_sunk(*pair.a.posed, *pair.b.posed, pair.offset, candidates, p.candidate_count))
      return false;
  }
  if (!hulls_->waiting.empty())
    take_manifolds();
  WaitingPair waiting; // what add_pair() and add_hull_pair() read of it
  waiting.a = &near_->body(p.a);
  waiting.b = &near_->body(p.b);
  waiting.extra_a = waiting.a->extra_radius;
  waiting.extra_b = waiting.b->extra_radius;
  waiting.to_b = contact::Double4{to_b[0], to_b[1], to_b[2], 0};
  waiting.number = number;
  hulls_->boxes.find({&core_a, waiting.a->column}, {&core_b, waiting.b->column}, waiting.to_b,
                     core_a.radius + core_b.radius, candidates, p.candidate_count);
  if (hulls_->boxes.size() == 0) {
    const double offset[3] = {to_b[0], to_b[1], to_b[2]};
    may_idle(number, offset, hulls_->boxes.gap());
  } else {
    add_box_pair(waiting);
  }
  return true;
}

/// Writes the contacts of two boxes to the block.
void PairGranCluster::add_box_pair(WaitingPair& waiting) {
  const contact::BoxContacts& touches = hulls_->boxes;
  const int count = touches.size();
  const contact::ContactCore &core_a = waiting.a->surface->core, &core_b = waiting.b->surface->core;
  const double reach = core_a.radius + core_b.radius;
  if (count > contact::ContactBlock::capacity || touches.any_elastic()) {
    std::vector<contact::Contact>& contacts = hulls_->of_boxes;
    contacts.clear();
    for (const contact::BoxTouch& t : touches)
      contacts.push_back(contact::contact_of(t, reach, core_a.radius));
    add_hull_contacts(waiting, contacts.data(), count);
    return;
  }
  make_room_in_block(count);
  const double radius = core_a.contact_radius * core_b.contact_radius / (core_a.contact_radius + core_b.contact_radius);
  const int first = filled_;
  int m = first;
  contact::ContactBlock& c = block_;
  for (const contact::BoxTouch& t : touches) {
    for (int k = 0; k < 3; ++k) {
      c.normal[k][m] = t.normal[k];
      c.arm[k][m] = t.arm[k];
    }
    const double overlap = reach - t.distance;
    c.radius_a[m] = core_a.radius;
    c.radius_b[m] = core_b.radius; // for outputs alone
    c.overlap[m] = overlap;
    c.contact_radius[m] = t.weight * std::sqrt(radius * overlap);
    c.curvature[m] = 0;
    block_ids_[m] = t.id;
    ++m;
  }
  waiting.last_contact = filled_ = m;
  add_pair(c, waiting, first);
  if (filled_ >= HullContacts::in_block)
    finish_hull_block(block_);
}

/// Features of a pair that can touch soon; returns the relative motion that they allow [m].
float PairGranCluster::search_features(const NearPair& p, const double* offset, float skin) {
  return static_cast<float>(hulls_->search.search(hulls_->pair(p, *near_, offset), skin));
}

/// Finds the contacts of all pairs with rounded bodies that wait, and adds the forces of all that are in the block.
void PairGranCluster::evaluate_hulls() {
  HullContacts& hulls = *hulls_;
  if (!hulls.waiting.empty())
    take_manifolds();
  finish_hull_block(block_);
}

void PairGranCluster::take_manifolds() {
  HullContacts& hulls = *hulls_;
  hulls.manifolds.evaluate();
  const std::vector<contact::Contact>& all = hulls.manifolds.contacts();
  for (int n = 0; n < hulls.manifolds.pairs(); ++n) {
    WaitingPair& pair = hulls.waiting[n];
    const int first = hulls.manifolds.first(n), last = hulls.manifolds.first(n + 1);
    if (first == last) {
      const double offset[3] = {pair.to_b[0], pair.to_b[1], pair.to_b[2]};
      may_idle(pair.number, offset, hulls.manifolds.gap(n));
      continue;
    }
    const NearPair& near = near_->pairs[pair.number];
    if (hulls.manifolds.sunk(n) > 0)
      judge_sunk_cores(near, hulls.manifolds.sunk(n));
    add_hull_contacts(pair, all.data() + first, last - first);
  }
  hulls.manifolds.clear();
  hulls.waiting.clear();
}

/// Says once that cores have met, and stops where one body is inside the other.
void PairGranCluster::judge_sunk_cores(const NearPair& near, double depth) {
  const bool beyond = depth > kMaxSunk * std::min(near_->bound_a(near), near_->bound_b(near));
  if (hulls_->warned_of_sunk_cores && !beyond)
    return;
  hulls_->warned_of_sunk_cores = true;
  const std::string bodies = "pair_style gran/cluster: the bodies " + std::to_string(near_->tag(near.a)) + " and " +
                             std::to_string(near_->tag(near.b));
  if (beyond)
    error->one(FLERR, (bodies + " have run into each other by most of their size: use a smaller time step (see fix "
                                "timestep/limit) or a larger Young's modulus")
                          .c_str());
  error->warning(FLERR, (bodies + " overlap by more than the radii of their edges, where no contact law holds (an "
                                  "elastic impact gains energy): use a "
                                  "larger Young's modulus, rounding or contact_radius")
                            .c_str());
}

/// Adds the contacts of a pair to the block, whose forces are added once it is full.
void PairGranCluster::add_hull_contacts(WaitingPair& pair, const contact::Contact* contacts, int count) {
  const int real =
      static_cast<int>(std::count_if(contacts, contacts + count, [](const contact::Contact& c) { return !c.elastic; }));
  if (real > contact::ContactBlock::capacity) {
    finish_hull_block(block_);
    evaluate_large_hull(pair, contacts, count, real);
    return;
  }
  make_room_in_block(real);
  add_hull_pair(block_, pair, contacts, count);
  if (filled_ >= HullContacts::in_block)
    finish_hull_block(block_);
}

void PairGranCluster::make_room_in_block(int contacts) {
  if (filled_ + contacts > contact::ContactBlock::capacity || pairs_in_block_ >= contact::ContactBlock::capacity)
    finish_hull_block(block_);
  constexpr std::size_t room = contact::ContactBlock::capacity + contact::contact_width;
  if (block_ids_.size() < room) {
    block_ids_.resize(room);
    block_pair_.resize(room);
  }
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
