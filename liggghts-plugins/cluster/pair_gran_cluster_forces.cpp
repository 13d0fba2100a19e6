// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The force loop of pair_style gran/cluster: candidates, exact overlaps, contacts in blocks, forces on bodies.
#include "cluster/pair_gran_cluster.h"
#include "cluster/shared_contacts.h"

#include "atom.h"
#include "error.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace eccentra::cluster {

using namespace LAMMPS_NS;

namespace {

/// Contacts that are evaluated together: enough to fill vectors, few enough to stay in the first-level cache.
constexpr int contacts_per_block = 96;
/// Vector loops run over whole multiples of this, so that rounding does not depend on a contact's place in its block.
constexpr int vector_width = 8;

/// Candidates are sub-spheres closer than a skin: wide enough to last `skin_steps` steps of the present relative
/// motion, within these parts of the smallest sub-sphere's radius.
constexpr float skin_steps = 40;
constexpr float skin_narrowest = 0.02f;
constexpr float skin_widest = 0.25f;
/// The step's motion is taken from the velocities at its middle; this allows for the curvature of the path.
constexpr float motion_safety = 1.05f;
/// Single precision preselects: round-off of coordinates, as part of the bounding radii.
constexpr float round_off = 1e-6f;

inline void cross_add(const double* w, const double* r, double* v) {
  v[0] += w[1] * r[2] - w[2] * r[1];
  v[1] += w[2] * r[0] - w[0] * r[2];
  v[2] += w[0] * r[1] - w[1] * r[0];
}

inline float length(const double* v) {
  return std::sqrt(static_cast<float>(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
}

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
  near.next.clear(near.pairs.size());
  filled_ = block_start_ = near_count_ = 0;
  in_block_.clear();
  double **x = atom->x, **v = atom->v, **omega = atom->omega;
  const float dt = static_cast<float>(update->dt);

  for (std::size_t n = 0; n < near.pairs.size(); ++n) {
    NearPair& p = near.pairs[n];
    near.next.first.push_back(near.next.size());
    const double *xa = x[p.a], *xb = x[p.b];
    const double offset[3] = {xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]};
    const int old_first = near.contacts.first[n], old_last = near.contacts.first[n + 1];
    if (p.direct) {
      const double range =
          p.surface_a->r[0] + bodies_->extra_radius(p.a) + p.surface_b->r[0] + bodies_->extra_radius(p.b);
      if (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2] < range * range) {
        hits_.assign(1, 0);
        gather(p, offset, old_first, old_last);
      }
      continue;
    }
    // Velocity of B's matter relative to A's frame is at most |u| + R_B |w_B - w_A|.
    const double *va = v[p.a], *vb = v[p.b], *wa = omega[p.a], *wb = omega[p.b];
    double u[3] = {va[0] - vb[0], va[1] - vb[1], va[2] - vb[2]};
    cross_add(wa, offset, u);
    const double w[3] = {wb[0] - wa[0], wb[1] - wa[1], wb[2] - wa[2]};
    const float motion = motion_safety * dt * (length(u) + static_cast<float>(atom->radius[p.b]) * length(w));
    p.slack -= motion;
    if (p.slack >= 0 && p.candidate_count == 0)
      continue;
    const RelativePose pose(bodies_->rotation(p.a), bodies_->rotation(p.b), offset);
    if (p.slack < 0)
      search_candidates(p, pose, motion);
    if (p.candidate_count == 0)
      continue;
    ++near_count_;
    const int padded = CandidateSearch::padded(p.candidate_count);
    hits_.resize(padded);
    const int count =
        overlapping_candidates(near.candidates, p.candidate_first, padded, pose, round_off * p.range, hits_.data());
    hits_.resize(count);
    for (int& hit : hits_)
      hit = near.candidates.id[hit];
    if (count > 0)
      gather(p, offset, old_first, old_last);
  }
  flush();
  near.next.first.push_back(near.next.size());
  contact_count_ = near.next.size();
  near.accept();
}

void PairGranCluster::search_candidates(NearPair& p, const RelativePose& pose, float motion) {
  CandidateStore& store = near_->candidates;
  const float extra_a = static_cast<float>(bodies_->extra_radius(p.a));
  const float extra_b = static_cast<float>(bodies_->extra_radius(p.b));
  const float smallest = std::min(static_cast<float>(p.surface_a->smallest_radius) + extra_a,
                                  static_cast<float>(p.surface_b->smallest_radius) + extra_b);
  const float skin = std::clamp(skin_steps * motion, skin_narrowest * smallest, skin_widest * smallest);
  const SearchResult found = search_.search(*p.surface_a, extra_a, *p.surface_b, extra_b, pose, skin);
  p.slack = found.slack - 2 * round_off * p.range;
  p.candidate_count = found.count;
  const int room = CandidateSearch::padded(found.count);
  if (room > p.candidate_room) {
    p.candidate_first = store.reserve(room);
    p.candidate_room = room;
  }
  if (found.count > 0)
    search_.write(*p.surface_a, extra_a, *p.surface_b, extra_b, store, p.candidate_first);
}

/// Adds the pair's contacts among hits_ to the block.
void PairGranCluster::gather(const NearPair& p, const double* offset, int old_first, int old_last) {
  if (filled_ + static_cast<int>(hits_.size()) > ContactBlock::capacity)
    flush();
  PairInBlock in_block = {p.a, p.b, filled_, filled_, {-offset[0], -offset[1], -offset[2]}};
  int old = old_first;
  for (int id : hits_)
    in_block.last += add_contact(p, id, offset, old, old_last);
  if (in_block.last > in_block.first)
    in_block_.push_back(in_block);
  if (filled_ >= contacts_per_block)
    flush();
}

/// Adds one contact to the block if the sub-spheres overlap; returns how many were added.
int PairGranCluster::add_contact(const NearPair& p, int id, const double* offset, int& old, int old_last) {
  const int ka = contact_sphere_a(id), kb = contact_sphere_b(id);
  const double body_a[3] = {p.surface_a->x[ka], p.surface_a->y[ka], p.surface_a->z[ka]};
  const double body_b[3] = {p.surface_b->x[kb], p.surface_b->y[kb], p.surface_b->z[kb]};
  double arm_a[3], arm_b[3], separation[3];
  to_world(bodies_->rotation(p.a), body_a, arm_a);
  to_world(bodies_->rotation(p.b), body_b, arm_b);
  for (int k = 0; k < 3; ++k)
    separation[k] = arm_a[k] - arm_b[k] - offset[k];
  const double ra = p.surface_a->r[ka] + bodies_->extra_radius(p.a);
  const double rb = p.surface_b->r[kb] + bodies_->extra_radius(p.b);
  const double distance2 =
      separation[0] * separation[0] + separation[1] * separation[1] + separation[2] * separation[2];
  if (distance2 >= (ra + rb) * (ra + rb))
    return 0;
  if (filled_ >= ContactBlock::capacity)
    error->one(FLERR, ("two clusters touch at more than " + std::to_string(ContactBlock::capacity) +
                       " sub-spheres at once: use a coarser shape, or a smaller time step if they ran into each other")
                          .c_str());

  ContactList &before = near_->contacts, &next = near_->next;
  while (old < old_last && before.id[old] < id)
    ++old;
  const bool known = old < old_last && before.id[old] == id;
  ContactBlock& c = block_;
  const int m = filled_++;
  next.id.push_back(id);
  for (int k = 0; k < 3; ++k) {
    const double displacement = known ? before.displacement[k][old] : 0;
    next.displacement[k].push_back(displacement);
    c.history[k][m] = displacement;
    c.separation[k][m] = separation[k];
    c.arm_a[k][m] = arm_a[k];
    c.arm_b[k][m] = arm_b[k];
    c.velocity[k][m] = atom->v[p.a][k] - atom->v[p.b][k];
    c.omega_a[k][m] = atom->omega[p.a][k];
    c.omega_b[k][m] = atom->omega[p.b][k];
  }
  c.radius_a[m] = ra;
  c.radius_b[m] = rb;
  const double mass_a = atom->rmass[p.a], mass_b = atom->rmass[p.b];
  double mass = mass_a * mass_b / (mass_a + mass_b);
  if (atom->mask[p.a] & freeze_group_bit())
    mass = mass_b;
  if (atom->mask[p.b] & freeze_group_bit())
    mass = mass_a;
  c.mass[m] = mass;
  const int ta = atom->type[p.a], tb = atom->type[p.b];
  c.youngs[m] = youngs_[ta][tb];
  c.shear_modulus[m] = shear_[ta][tb];
  c.damping[m] = -damping_[ta][tb];
  c.friction[m] = friction_[ta][tb];
  c.share[m] = 1;
  return 1;
}

template <DampingLaw law> void PairGranCluster::compute_block(int padded) {
  contact_geometry(block_, padded);
  if (words_.sharing == ContactSharing::shared)
    share_damping();
  if (words_.tangential_damping)
    contact_forces<law, true>(block_, padded, update->dt, advance_);
  else
    contact_forces<law, false>(block_, padded, update->dt, advance_);
}

void PairGranCluster::share_damping() {
  ContactBlock& c = block_;
  for (const PairInBlock& p : in_block_) {
    if (p.last - p.first == 1)
      continue;
    SharedStiffness all;
    for (int m = p.first; m < p.last; ++m)
      all.add(c.contact_radius[m], c.overlap[m], c.normal[0][m], c.normal[1][m], c.normal[2][m]);
    for (int m = p.first; m < p.last; ++m)
      c.share[m] = all.damping_share(c.contact_radius[m], c.normal[0][m], c.normal[1][m], c.normal[2][m]);
  }
}

/// Evaluates the contacts in the block and starts a new one.
void PairGranCluster::flush() {
  if (filled_ == 0)
    return;
  ContactBlock& c = block_;
  const int padded = (filled_ + vector_width - 1) / vector_width * vector_width;
  for (int m = filled_; m < padded; ++m) {
    // A harmless contact in the unused lanes.
    c.separation[0][m] = 1;
    c.separation[1][m] = c.separation[2][m] = 0;
    c.radius_a[m] = c.radius_b[m] = 1;
  }
  if (words_.damping == DampingLaw::stock)
    compute_block<DampingLaw::stock>(padded);
  else
    compute_block<DampingLaw::paper>(padded);
  for (int k = 0; k < 3; ++k)
    std::copy(c.history[k], c.history[k] + filled_, near_->next.displacement[k].begin() + block_start_);
  for (const PairInBlock& p : in_block_)
    scatter(p);
  in_block_.clear();
  filled_ = 0;
  block_start_ = near_->next.size();
}

/// Adds the forces of one pair of bodies to the atoms of this rank.
void PairGranCluster::scatter(const PairInBlock& p) {
  const ContactBlock& c = block_;
  double force[3] = {0, 0, 0}, torque_a[3] = {0, 0, 0}, torque_b[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k)
    for (int m = p.first; m < p.last; ++m) {
      force[k] += c.force[k][m];
      torque_a[k] += c.torque_a[k][m];
      torque_b[k] += c.torque_b[k][m];
    }
  const int local = atom->nlocal;
  for (int k = 0; k < 3; ++k) {
    if (p.a < local) {
      atom->f[p.a][k] += force[k];
      atom->torque[p.a][k] += torque_a[k];
    }
    if (p.b < local) {
      atom->f[p.b][k] -= force[k];
      atom->torque[p.b][k] += torque_b[k];
    }
  }
  if (evflag)
    ev_tally_xyz(p.a, p.b, local, 0, 0., 0., force[0], force[1], force[2], p.separation[0], p.separation[1],
                 p.separation[2]);
}

} // namespace eccentra::cluster
