// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of pair_style gran/cluster in blocks: exact overlaps, history, damping, forces on bodies. Loops whose length
// differs from pair to pair cost a wrong guess of the processor each: where they can, loops run over whole blocks.
#include "contact/shared_contacts.h"
#include "styles/pairs/hull_contacts.h"
#include "styles/pairs/pair_gran_cluster.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

/// Faces of two lattices of spheres touch at up to four neighbours each (cubes) or seven (disks).
constexpr int interpenetrating = 8;

} // namespace

/// Evaluates the only pair that waits, which has more possible contacts than a block has room for.
void PairGranCluster::evaluate_large() {
  const int count = waiting_.candidates();
  const NearPair& p = near_->pairs[waiting_.pair(0).number];
  const int finer = std::max(near_->surface_a(p).count, near_->surface_b(p).count);
  if (reach_ == 1 && count > interpenetrating * finer)
    error->one(FLERR, ("two clusters touch at up to " + std::to_string(count) + " sub-spheres at once, more than " +
                       std::to_string(interpenetrating) + " for each of the " + std::to_string(finer) +
                       " at the surface of the finer: they have run into each other: use a smaller time step (see fix "
                       "timestep/limit)")
                          .c_str());
  if (!large_block_)
    large_block_ = std::make_unique<contact::LargeContactBlock>();
  large_block_->reserve(count);
  evaluate_waiting(*large_block_);
}

void PairGranCluster::evaluate_waiting() {
  if (waiting_.count() > 0)
    evaluate_waiting(block_);
  else if (hulls_)
    evaluate_hulls();
}

/// Finds the contacts of all pairs that wait, and adds their forces.
template <class Block> void PairGranCluster::evaluate_waiting(Block& c) {
  const std::size_t room = contact::whole_vectors(waiting_.candidates()) + contact::contact_width;
  if (block_ids_.size() < room) {
    block_ids_.resize(room);
    block_pair_.resize(room);
  }
  const bool spheres = waiting_.all_direct();
  if (spheres)
    find_contacts_of_spheres(c);
  else
    find_contacts(c);
  pairs_in_block_ = 0;
  int first = 0;
  for (int k = 0; k < waiting_.count(); ++k) {
    const WaitingPair& pair = waiting_.pair(k);
    if (pair.last_contact > first)
      add_pair(c, pair, first);
    else
      not_touching(pair, k);
    first = pair.last_contact;
  }
  waiting_.clear();
  single_contacts_ = spheres;
  if (filled_ > 0)
    finish_block<false>(c);
  pairs_in_block_ = filled_ = 0;
}

/// Forces of the pairs in the block; `known_geometry`: normals, overlaps and contact radii are in it.
template <bool known_geometry, class Block> void PairGranCluster::finish_block(Block& c) {
  if (known_geometry)
    single_contacts_ = false;
  const bool spheres = single_contacts_;
  const int padded = contact::whole_vectors(filled_);
  for (int m = filled_; m < padded; ++m) {
    // A harmless contact in the unused lanes.
    c.separation[0][m] = 1;
    c.separation[1][m] = c.separation[2][m] = 0;
    c.radius_a[m] = c.radius_b[m] = 1;
    if (known_geometry) {
      c.overlap[m] = c.contact_radius[m] = c.curvature[m] = 0;
      for (int k = 0; k < 3; ++k)
        c.normal[k][m] = c.arm[k][m] = 0;
    }
    for (int k = 0; k < 3; ++k)
      c.history[k][m] = 0;
  }
  recall_history(c);
  if (stock_)
    compute_stock(c);
  else
    compute_block<known_geometry>(c, padded);
  if (records_)
    write_down(c);
  ContactList& next = near_->next;
  next.id.insert(next.id.end(), block_ids_.data(), block_ids_.data() + filled_);
  for (int k = 0; k < 3; ++k)
    next.displacement[k].insert(next.displacement[k].end(), c.history[k], c.history[k] + filled_);
  if (spheres) {
    for (int n = 0; n < pairs_in_block_; ++n)
      scatter(n, c);
    return;
  }
  contact::add_contact_forces(c, block_pair_.data(), filled_, sums_, pairs_in_block_);
  if (known_geometry)
    add_corrections();
  for (int n = 0; n < pairs_in_block_; ++n)
    scatter(n, sums_);
}

/// Writes the contacts of the block down for outputs. A pair with a ghost is met twice: the rank of A counts it.
template <class Block> void PairGranCluster::write_down(const Block& c) {
  for (int m = 0; m < filled_; ++m) {
    const PairInBlock& p = in_block_[block_pair_[m]];
    if (p.a < atom->nlocal)
      records_->add(c, m, p.a, p.b, contact::contact_sphere_a(block_ids_[m]), contact::contact_sphere_b(block_ids_[m]));
  }
}

/// The exact test: writes those candidates of the pairs that wait which do overlap to the block.
template <class Block> void PairGranCluster::find_contacts(Block& c) {
  const int *ids = waiting_.ids(), *pair_of = waiting_.pair_of(), count = waiting_.candidates();
  double* excesses = waiting_.excess();
  int* block_ids = block_ids_.data();
  int m = 0;
  // Every candidate is written; the next one takes the place of one that does not touch.
  for (int n = 0; n < count; ++n) {
    const int id = ids[n];
    WaitingPair& p = waiting_.pair(pair_of[n]);
    const contact::Double4 *turn_a = p.a->column, *turn_b = p.b->column;
    const contact::Double4 sphere_a = p.spheres_a[contact::contact_sphere_a(id)],
                           sphere_b = p.spheres_b[contact::contact_sphere_b(id)];
    const contact::Double4 arm = turn_a[0] * sphere_a[0] + turn_a[1] * sphere_a[1] + turn_a[2] * sphere_a[2];
    const contact::Double4 from_b =
        turn_b[0] * sphere_b[0] + turn_b[1] * sphere_b[1] + turn_b[2] * sphere_b[2] + p.to_b;
    const contact::Double4 separation = arm - from_b, square = separation * separation;
    const double ra = sphere_a[3] + p.extra_a, rb = sphere_b[3] + p.extra_b;
    const double reach = reach_ * (ra + rb);
    const double excess = square[0] + square[1] + square[2] - reach * reach;
    for (int k = 0; k < 3; ++k) {
      c.separation[k][m] = separation[k];
      c.arm[k][m] = arm[k];
    }
    c.radius_a[m] = ra;
    c.radius_b[m] = rb;
    block_ids[m] = id;
    excesses[n] = excess;
    m += excess < 0;
    p.last_contact = m;
  }
  filled_ = m;
}

/// The same where all of them are single spheres at their bodies' centres.
template <class Block> void PairGranCluster::find_contacts_of_spheres(Block& c) {
  double* excesses = waiting_.excess();
  int* block_ids = block_ids_.data();
  int m = 0;
  for (int n = 0; n < waiting_.count(); ++n) {
    WaitingPair& p = waiting_.pair(n);
    const contact::Double4 separation = -p.to_b, square = separation * separation;
    const double ra = p.spheres_a[0][3] + p.extra_a, rb = p.spheres_b[0][3] + p.extra_b;
    const double reach = reach_ * (ra + rb);
    const double excess = square[0] + square[1] + square[2] - reach * reach;
    for (int k = 0; k < 3; ++k) {
      c.separation[k][m] = separation[k];
      c.arm[k][m] = 0;
    }
    c.radius_a[m] = ra;
    c.radius_b[m] = rb;
    block_ids[m] = contact::contact_id(0, 0);
    excesses[n] = excess;
    m += excess < 0;
    p.last_contact = m;
  }
  filled_ = m;
}

/// Adds what the contacts of a pair, which begin at `first`, have in common.
template <class Block> void PairGranCluster::add_pair(Block& c, const WaitingPair& waiting, int first) {
  const contact::BodyState &body_a = *waiting.a, &body_b = *waiting.b;
  // In registers throughout: numbers that are written one by one are not read back as a vector at once.
  const contact::Double4 va = contact::load3(body_a.v), vb = contact::load3(body_b.v);
  const contact::Double4 wb = contact::load3(body_b.omega);
  // Of B's matter, were it at A's centre.
  contact::Double4 velocity = va - vb + contact::cross(wb, waiting.to_b);
  contact::Double4 spin = contact::load3(body_a.omega) - wb;
  if (arguments_.synchronised && advance_)
    contact::to_middle_of_step(velocity, spin, va, vb, wb, 0.5 * update->dt);
  const int number = pairs_in_block_++, last = waiting.last_contact;
  for (int start = first; start < last; start += contact::contact_width)
    for (int k = 0; k < contact::contact_width; ++k) {
      const int n = start + k;
      c.velocity[0][n] = velocity[0];
      c.velocity[1][n] = velocity[1];
      c.velocity[2][n] = velocity[2];
      c.spin[0][n] = spin[0];
      c.spin[1][n] = spin[1];
      c.spin[2][n] = spin[2];
      block_pair_[n] = number;
    }
  // As a rule all bodies have the same mass and material: then what is there from the last block will do.
  constexpr bool large = !std::is_same_v<Block, contact::ContactBlock>;
  const NearPair& near = near_->pairs[waiting.number];
  const bool there = !large && one_kind_ && near_->kind(near.a) == kind_a_ && near_->kind(near.b) == kind_b_;
  if (!there)
    fill_materials(c, waiting, first, number);
  if (!there || !one_inertia_)
    fill_inertia(waiting, number);
  // Member by member: a whole struct would be put together in memory and read back before it has arrived there.
  const int* old_first = near_->contacts.first.data() + waiting.number;
  PairInBlock& pair = in_block_[number];
  pair.a = near.a;
  pair.b = near.b;
  pair.first = first;
  pair.last = last;
  pair.old_first = old_first[0];
  pair.old_last = old_first[1];
  near_->next.first[waiting.number + 1] = last - first;
  for (int k = 0; k < 3; ++k)
    pairs_.offset[k][number] = waiting.to_b[k];
}

/// Masses and materials of a pair; at the start of a block for the whole of it: maybe the next pairs are like this one.
template <class Block>
void PairGranCluster::fill_materials(Block& c, const WaitingPair& waiting, int first, int number) {
  constexpr bool large = !std::is_same_v<Block, contact::ContactBlock>;
  const contact::BodyState &a = *waiting.a, &b = *waiting.b;
  double mass = a.mass * b.mass / (a.mass + b.mass);
  if (a.held)
    mass = b.mass;
  if (b.held)
    mass = a.mass;
  one_kind_ = !large && number == 0;
  kind_a_ = near_->kind(near_->pairs[waiting.number].a);
  kind_b_ = near_->kind(near_->pairs[waiting.number].b);
  const int last = one_kind_ ? contact::ContactBlock::capacity + contact::contact_width : waiting.last_contact;
  for (int n = first; n < last; ++n)
    c.mass[n] = mass;
  if (!stock_)
    materials_.fill(c, first, last, a.type, b.type);
  const int last_pair = one_kind_ ? contact::ContactBlock::capacity : number + 1;
  std::fill(pairs_.ease_a + number, pairs_.ease_a + last_pair, a.held && !b.held ? 0 : b.mass);
  std::fill(pairs_.ease_b + number, pairs_.ease_b + last_pair, b.held && !a.held ? 0 : a.mass);
}

/// Inertia of a pair, likewise; where it is the same about all axes, orientation does not change it.
void PairGranCluster::fill_inertia(const WaitingPair& waiting, int number) {
  const NearPair& p = near_->pairs[waiting.number];
  one_inertia_ = one_kind_ && number == 0 && near_->surface_a(p).equal_moments && near_->surface_b(p).equal_moments;
  pairs_.alike = one_inertia_;
  const int last = one_inertia_ ? contact::ContactBlock::capacity : number + 1;
  const double *inverse_a = waiting.a->inverse_inertia, *inverse_b = waiting.b->inverse_inertia;
  for (int k = 0; k < 6; ++k) {
    std::fill(pairs_.inverse_a[k] + number, pairs_.inverse_a[k] + last, inverse_a[k]);
    std::fill(pairs_.inverse_b[k] + number, pairs_.inverse_b[k] + last, inverse_b[k]);
  }
}

/// Displacements of the contacts in the block: those of the last step, or 0 for a new contact.
template <class Block> void PairGranCluster::recall_history(Block& c) {
  const ContactList& before = near_->contacts;
  block_more_.assign(static_cast<std::size_t>(before.width) * filled_, 0.);
  // As a rule all of them were there in the last step, one after the other.
  const int start = in_block_[0].old_first;
  int changed = in_block_[pairs_in_block_ - 1].old_last - start != filled_;
  for (int n = 0; n < pairs_in_block_; ++n)
    changed |= in_block_[n].old_first - start != in_block_[n].first;
  if (!changed)
    for (int m = 0; m < filled_; ++m)
      changed |= before.id[start + m] != block_ids_[m];
  if (!changed) {
    for (int k = 0; k < 3; ++k)
      std::copy_n(before.displacement[k].data() + start, filled_, c.history[k]);
    std::copy_n(before.more.begin() + before.width * start, before.width * filled_, block_more_.begin());
    return;
  }
  for (int n = 0; n < pairs_in_block_; ++n) {
    const PairInBlock& p = in_block_[n];
    int old = p.old_first;
    for (int m = p.first; m < p.last; ++m) {
      while (old < p.old_last && before.id[old] < block_ids_[m])
        ++old;
      const bool known = old < p.old_last && before.id[old] == block_ids_[m];
      for (int k = 0; k < 3; ++k)
        c.history[k][m] = known ? before.displacement[k][old] : 0;
      if (known)
        std::copy_n(before.more.begin() + before.width * old, before.width, block_more_.begin() + before.width * m);
    }
  }
}

template <bool known_geometry, class Block> void PairGranCluster::compute_block(Block& block, int padded) {
  if (!known_geometry)
    contact::contact_geometry(block, padded);
  model_->stiffness(block, padded, arguments_.damping_choice());
  if (arguments_.sharing == ContactSharing::shared && !single_contacts_)
    shares_.apply(
        block, filled_, block_pair_.data(), pairs_in_block_,
        [this](int k) {
          return contact::ContactGroup{in_block_[k].first, in_block_[k].last};
        },
        pairs_);
  contact::contact_forces(block, padded, update->dt, advance_, {arguments_.friction, arguments_.synchronised, false});
}

/// Adds the forces of a pair of bodies in the block. `forces` has rows of them, one place per pair.
template <class Forces> void PairGranCluster::scatter(int pair, const Forces& forces) {
  const PairInBlock& p = in_block_[pair];
  const double fx = forces.force[0][pair], fy = forces.force[1][pair], fz = forces.force[2][pair];
  const double tx = forces.torque[0][pair], ty = forces.torque[1][pair], tz = forces.torque[2][pair];
  const double d[3] = {pairs_.offset[0][pair], pairs_.offset[1][pair], pairs_.offset[2][pair]};
  contact::BodyForce &a = near_->force(p.a), &b = near_->force(p.b);
  a.force += contact::Double4{fx, fy, fz, 0};
  a.torque += contact::Double4{tx, ty, tz, 0};
  b.force -= contact::Double4{fx, fy, fz, 0};
  b.torque += contact::Double4{d[1] * fz - d[2] * fy - tx, d[2] * fx - d[0] * fz - ty, d[0] * fy - d[1] * fx - tz, 0};
  if (stock_)
    for (int k = 0; k < 3; ++k)
      b.torque[k] += excess_torques_[pair][k];
  if (evflag)
    ev_tally_xyz(p.a, p.b, atom->nlocal, 0, 0., 0., fx, fy, fz, -d[0], -d[1], -d[2]);
}

template void PairGranCluster::finish_block<true>(contact::ContactBlock& block);
template void PairGranCluster::finish_block<true>(contact::LargeContactBlock& block);
template void PairGranCluster::add_pair(contact::ContactBlock& block, const WaitingPair& waiting, int first);
template void PairGranCluster::add_pair(contact::LargeContactBlock& block, const WaitingPair& waiting, int first);

} // namespace eccentra::styles
