// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of pair_style gran/cluster in blocks: exact overlaps, history, damping, forces on bodies. Loops whose length
// differs from pair to pair cost a wrong guess of the processor each: where they can, loops run over whole blocks.
#include "cluster/pair_gran_cluster.h"
#include "cluster/shared_contacts.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

namespace eccentra::cluster {

using namespace LAMMPS_NS;

namespace {

/// Contacts that are evaluated together: enough to fill vectors, few enough to stay in the first-level cache.
constexpr int contacts_per_block = 32;
/// Up to so many contacts of a pair share damping each with each, more by way of tensors.
constexpr int shared_each_with_each = 8;

/// Faces of two lattices of spheres touch at up to four neighbours each (cubes) or seven (disks).
constexpr int interpenetrating = 8;

constexpr int whole_vectors(int count) {
  return (count + contact_width - 1) / contact_width * contact_width;
}

} // namespace

/// Adds those of the pair's `count` possible contacts that do overlap to the block.
PairGranCluster::Gathered PairGranCluster::gather(const NearPair& p, const double* offset, const int* ids, int count,
                                                  int old_first, int old_last) {
  if (filled_ + count > ContactBlock::capacity)
    flush();
  if (count <= ContactBlock::capacity)
    return gather_into(block_, p, offset, ids, count, old_first, old_last);
  const int finer = std::max(p.surface_a->count, p.surface_b->count);
  if (count > interpenetrating * finer)
    error->one(FLERR, ("two clusters touch at up to " + std::to_string(count) + " sub-spheres at once, more than " +
                       std::to_string(interpenetrating) + " for each of the " + std::to_string(finer) +
                       " at the surface of the finer: they have run into each other: use a smaller time step (see fix "
                       "timestep/limit)")
                          .c_str());
  if (!large_block_)
    large_block_ = std::make_unique<LargeContactBlock>();
  large_block_->reserve(count);
  const Gathered found = gather_into(*large_block_, p, offset, ids, count, old_first, old_last);
  flush(*large_block_);
  return found;
}

template <class Block>
PairGranCluster::Gathered PairGranCluster::gather_into(Block& c, const NearPair& p, const double* offset,
                                                       const int* ids, int count, int old_first, int old_last) {
  const Double4 *a = p.surface_a->sphere.data(), *b = p.surface_b->sphere.data();
  const BodyState &body_a = near_->body(p.a), &body_b = near_->body(p.b);
  const Double4 to_b = {offset[0], offset[1], offset[2], 0};
  const Double4 ax = body_a.column[0], ay = body_a.column[1], az = body_a.column[2];
  const Double4 bx = body_b.column[0], by = body_b.column[1], bz = body_b.column[2];
  const int room = whole_vectors(filled_ + count) + contact_width;
  if (static_cast<int>(block_ids_.size()) < room) {
    block_ids_.resize(room);
    block_pair_.resize(room);
  }
  int* block_ids = block_ids_.data();
  double least = std::numeric_limits<double>::max();
  int m = filled_;
  // Every candidate is written; the next one takes the place of one that does not touch.
  for (int n = 0; n < count; ++n) {
    const int id = ids[n];
    const Double4 sphere_a = a[contact_sphere_a(id)], sphere_b = b[contact_sphere_b(id)];
    const Double4 arm = ax * sphere_a[0] + ay * sphere_a[1] + az * sphere_a[2];
    const Double4 from_b = bx * sphere_b[0] + by * sphere_b[1] + bz * sphere_b[2] + to_b;
    const Double4 separation = arm - from_b, square = separation * separation;
    const double ra = sphere_a[3] + p.extra_a, rb = sphere_b[3] + p.extra_b;
    const double excess = square[0] + square[1] + square[2] - (ra + rb) * (ra + rb);
    for (int k = 0; k < 3; ++k) {
      c.separation[k][m] = separation[k];
      c.arm[k][m] = arm[k];
    }
    c.radius_a[m] = ra;
    c.radius_b[m] = rb;
    block_ids[m] = id;
    least = std::min(least, excess);
    m += excess < 0;
  }
  const Gathered found = {m - filled_, least};
  if (found.count > 0)
    add_pair(c, p, offset, m, old_first, old_last);
  return found;
}

/// Closes the pair whose contacts end at `last`: adds what they have in common, and evaluates a block that is full.
template <class Block>
void PairGranCluster::add_pair(Block& c, const NearPair& p, const double* offset, int last, int old_first,
                               int old_last) {
  const BodyState &body_a = near_->body(p.a), &body_b = near_->body(p.b);
  const double *va = body_a.v, *vb = body_b.v, *wa = body_a.omega, *wb = body_b.omega;
  // Of B's matter, were it at A's centre.
  const double velocity[3] = {va[0] - vb[0] + (wb[1] * offset[2] - wb[2] * offset[1]),
                              va[1] - vb[1] + (wb[2] * offset[0] - wb[0] * offset[2]),
                              va[2] - vb[2] + (wb[0] * offset[1] - wb[1] * offset[0])};
  const double spin[3] = {wa[0] - wb[0], wa[1] - wb[1], wa[2] - wb[2]};
  const double mass_a = body_a.mass, mass_b = body_b.mass;
  const bool held_a = body_a.held, held_b = body_b.held;
  double mass = mass_a * mass_b / (mass_a + mass_b);
  if (held_a)
    mass = mass_b;
  if (held_b)
    mass = mass_a;
  const int ta = body_a.type, tb = body_b.type;
  const int first = filled_, number = pairs_in_block_++;
  for (int start = first; start < last; start += contact_width)
    for (int k = 0; k < contact_width; ++k) {
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
  const Common common = {mass, youngs_[ta][tb], shear_[ta][tb], -damping_[ta][tb], friction_[ta][tb]};
  if (constexpr bool large = !std::is_same_v<Block, ContactBlock>;
      large || !common_everywhere_ || !(common == common_)) {
    // At the start of a block for the whole of it: maybe the next pairs are like this one.
    const bool everywhere = !large && first == 0;
    const int end = everywhere ? ContactBlock::capacity + contact_width : last;
    for (int n = first; n < end; ++n) {
      c.mass[n] = common.mass;
      c.youngs[n] = common.youngs;
      c.shear_modulus[n] = common.shear;
      c.damping[n] = common.damping;
      c.friction[n] = common.friction;
      c.share[n] = 1;
    }
    if (!large) {
      common_everywhere_ = everywhere;
      common_ = common;
    }
  }
  // Member by member: a whole struct would be put together in memory and read back before it has arrived there.
  PairInBlock& pair = in_block_[number];
  pair.a = p.a;
  pair.b = p.b;
  pair.first = first;
  pair.last = last;
  pair.old_first = old_first;
  pair.old_last = old_last;
  for (int k = 0; k < 3; ++k)
    pairs_.offset[k][number] = offset[k];
  pairs_.ease_a[number] = held_a && !held_b ? 0 : mass_b;
  pairs_.ease_b[number] = held_b && !held_a ? 0 : mass_a;
  // Where inertia is the same about all axes, orientation does not change it: as above.
  const bool isotropic = p.surface_a->equal_moments && p.surface_b->equal_moments;
  if (!isotropic || isotropic_a_ != p.surface_a || isotropic_b_ != p.surface_b) {
    const bool everywhere = isotropic && number == 0;
    const int end = everywhere ? ContactBlock::capacity : number + 1;
    const double *inverse_a = body_a.inverse_inertia, *inverse_b = body_b.inverse_inertia;
    for (int k = 0; k < 6; ++k) {
      std::fill(pairs_.inverse_a[k] + number, pairs_.inverse_a[k] + end, inverse_a[k]);
      std::fill(pairs_.inverse_b[k] + number, pairs_.inverse_b[k] + end, inverse_b[k]);
    }
    isotropic_a_ = everywhere ? p.surface_a : nullptr;
    isotropic_b_ = everywhere ? p.surface_b : nullptr;
  }
  filled_ = last;
  if (filled_ >= contacts_per_block)
    flush(c);
}

/// Evaluates the contacts in the block and starts a new one.
void PairGranCluster::flush() {
  if (filled_ > 0)
    flush(block_);
}

template <class Block> void PairGranCluster::flush(Block& c) {
  if (filled_ == 0)
    return;
  const int padded = whole_vectors(filled_);
  for (int m = filled_; m < padded; ++m) {
    // A harmless contact in the unused lanes.
    c.separation[0][m] = 1;
    c.separation[1][m] = c.separation[2][m] = 0;
    c.radius_a[m] = c.radius_b[m] = 1;
    for (int k = 0; k < 3; ++k)
      c.history[k][m] = 0;
  }
  recall_history(c);
  if (words_.damping == DampingLaw::stock)
    compute_block<DampingLaw::stock>(c, padded);
  else
    compute_block<DampingLaw::paper>(c, padded);
  ContactList& next = near_->next;
  next.id.insert(next.id.end(), block_ids_.data(), block_ids_.data() + filled_);
  for (int k = 0; k < 3; ++k)
    next.displacement[k].insert(next.displacement[k].end(), c.history[k], c.history[k] + filled_);
  add_contact_forces(c, block_pair_.data(), filled_, pairs_, pairs_in_block_);
  for (int n = 0; n < pairs_in_block_; ++n)
    scatter(n);
  pairs_in_block_ = filled_ = 0;
}

/// Displacements of the contacts in the block: those of the last step, or 0 for a new contact.
template <class Block> void PairGranCluster::recall_history(Block& c) {
  const ContactList& before = near_->contacts;
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
    }
  }
}

template <DampingLaw law, class Block> void PairGranCluster::compute_block(Block& block, int padded) {
  contact_geometry(block, padded);
  if (words_.sharing == ContactSharing::shared)
    share_damping(block, padded);
  if (words_.tangential_damping)
    contact_forces<law, true>(block, padded, update->dt, advance_);
  else
    contact_forces<law, false>(block, padded, update->dt, advance_);
}

/// Contacts of the same two bodies have one damper between them, tuned to the mass that they feel.
template <class Block> void PairGranCluster::share_damping(Block& c, int padded) {
  start_shared_sums(c, padded);
  start_off_centre_sums(c, padded);
  bool any_with_many = false;
  add_off_centre_sums(c, block_pair_.data(), filled_, pairs_, pairs_in_block_);
  for (int n = 0; n < pairs_in_block_; ++n) {
    const PairInBlock& p = in_block_[n];
    if (p.last - p.first > shared_each_with_each) {
      any_with_many = true;
      continue;
    }
    for (int j = p.first; j < p.last; ++j)
      for (int k = j + 1; k < p.last; ++k)
        add_shared_pair(c, j, k);
  }
  finish_shared_sums(c, padded);
  for (int n = 0; any_with_many && n < pairs_in_block_; ++n) {
    const PairInBlock& p = in_block_[n];
    if (p.last - p.first <= shared_each_with_each)
      continue;
    SharedStiffness all;
    for (int m = p.first; m < p.last; ++m)
      all.add(c.contact_radius[m], c.overlap[m], c.normal[0][m], c.normal[1][m], c.normal[2][m]);
    for (int m = p.first; m < p.last; ++m)
      c.share[m] = all.damping_share(c.contact_radius[m], c.normal[0][m], c.normal[1][m], c.normal[2][m]);
  }
  off_centre_factors(pairs_, whole_vectors(pairs_in_block_));
  for (int m = 0; m < filled_; ++m)
    c.share[m] *= pairs_.factor[block_pair_[m]];
}

/// Adds the forces of a pair of bodies in the block.
void PairGranCluster::scatter(int pair) {
  const PairInBlock& p = in_block_[pair];
  const double fx = pairs_.force[0][pair], fy = pairs_.force[1][pair], fz = pairs_.force[2][pair];
  const double tx = pairs_.torque[0][pair], ty = pairs_.torque[1][pair], tz = pairs_.torque[2][pair];
  const double d[3] = {pairs_.offset[0][pair], pairs_.offset[1][pair], pairs_.offset[2][pair]};
  BodyForce &a = near_->force(p.a), &b = near_->force(p.b);
  a.force += Double4{fx, fy, fz, 0};
  a.torque += Double4{tx, ty, tz, 0};
  b.force -= Double4{fx, fy, fz, 0};
  b.torque += Double4{d[1] * fz - d[2] * fy - tx, d[2] * fx - d[0] * fz - ty, d[0] * fy - d[1] * fx - tz, 0};
  if (evflag)
    ev_tally_xyz(p.a, p.b, atom->nlocal, 0, 0., 0., fx, fy, fz, -d[0], -d[1], -d[2]);
}

} // namespace eccentra::cluster
