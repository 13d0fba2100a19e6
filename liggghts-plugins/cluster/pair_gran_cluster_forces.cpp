// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The force loop of pair_style gran/cluster: candidates, exact overlaps, contacts in blocks, forces on bodies.
#include "cluster/pair_gran_cluster.h"

#include "cluster/off_centre.h"
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
constexpr int contacts_per_block = 48;
/// Vector loops run over whole multiples of this, so that rounding does not depend on a contact's place in its block.
constexpr int vector_width = 8;

/// Candidates are sub-spheres closer than a skin: wide enough to last `skin_steps` steps of the present relative
/// motion, within these parts of the smallest sub-sphere's radius.
constexpr float skin_steps = 40;
constexpr float skin_narrowest = 0.02f;
constexpr float skin_widest = 0.25f;
/// A step's path is taken from the velocities at its middle; this allows for its curvature.
constexpr float path_safety = 1.05f;
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
  filled_ = contact_count_ = near_count_ = 0;
  in_block_.clear();
  near.update_bodies(path_safety * static_cast<float>(update->dt));
  const double* x = atom->x[0]; // LIGGGHTS keeps the rows of these arrays one after the other

  const std::size_t pair_count = near.pairs.size();
  for (std::size_t n = 0; n < pair_count; ++n) {
    NearPair& p = near.pairs[n];
    near.next.first.push_back(contact_count_);
    if (p.candidate_count == 0 && near.path(p.a) + near.path(p.b) < p.wake)
      continue;
    const double *xa = x + 3 * p.a, *xb = x + 3 * p.b;
    const double offset[3] = {xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]};
    if (p.direct) {
      const double range = p.surface_a->r[0] + p.extra_a + p.surface_b->r[0] + p.extra_b;
      const int only = contact_id(0, 0);
      if (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2] < range * range)
        gather(p, offset, &only, 1, near.contacts.first[n], near.contacts.first[n + 1]);
      continue;
    }
    const RelativePose pose(near.frame(p.a), near.frame(p.b), offset);
    if (p.candidate_count == 0 || pose.moved_beyond(p.skin, p.pose, p.bound_b))
      search_candidates(p, pose, offset);
    if (p.candidate_count == 0)
      continue;
    ++near_count_;
    const int padded = CandidateSearch::padded(p.candidate_count);
    if (static_cast<int>(hits_.size()) < padded)
      hits_.resize(2 * padded);
    const int count =
        overlapping_candidates(near.candidates, p.candidate_first, padded, pose, round_off * p.range, hits_.data());
    if (count > 0)
      gather(p, offset, hits_.data(), count, near.contacts.first[n], near.contacts.first[n + 1]);
  }
  flush();
  near.next.first.push_back(contact_count_);
  near.accept();
}

/// Finds the pairs of sub-spheres that can touch soon, with a skin that suits how fast the bodies move past each other.
void PairGranCluster::search_candidates(NearPair& p, const RelativePose& pose, const double* offset) {
  CandidateStore& store = near_->candidates;
  const float extra_a = static_cast<float>(p.extra_a), extra_b = static_cast<float>(p.extra_b);
  const float smallest = std::min(static_cast<float>(p.surface_a->smallest_radius) + extra_a,
                                  static_cast<float>(p.surface_b->smallest_radius) + extra_b);
  // Velocity of B's matter relative to A's frame is at most |u| + R_B |w_B - w_A|.
  const double *va = atom->v[p.a], *vb = atom->v[p.b], *wa = atom->omega[p.a], *wb = atom->omega[p.b];
  double u[3] = {va[0] - vb[0], va[1] - vb[1], va[2] - vb[2]};
  cross_add(wa, offset, u);
  const double w[3] = {wb[0] - wa[0], wb[1] - wa[1], wb[2] - wa[2]};
  const float motion = static_cast<float>(update->dt) * (length(u) + p.bound_b * length(w));
  const float skin = std::clamp(skin_steps * motion, skin_narrowest * smallest, skin_widest * smallest);
  const float margin = 2 * round_off * p.range;
  const SearchResult found = search_.search(*p.surface_a, extra_a, *p.surface_b, extra_b, pose, skin + margin);
  p.skin = skin;
  p.pose = pose;
  p.wake = near_->path(p.a) + near_->path(p.b) + found.slack - margin;
  p.candidate_count = found.count;
  const int room = CandidateSearch::padded(found.count);
  if (room > p.candidate_room) {
    p.candidate_first = store.reserve(room);
    p.candidate_room = room;
  }
  if (found.count > 0)
    search_.write(*p.surface_a, extra_a, *p.surface_b, extra_b, store, p.candidate_first);
}

/// Adds those of the pair's `count` possible contacts that do overlap to the block, with their history.
void PairGranCluster::gather(const NearPair& p, const double* offset, const int* ids, int count, int old,
                             int old_last) {
  ContactBlock& c = block_;
  if (filled_ + count > ContactBlock::capacity)
    flush();
  if (count > ContactBlock::capacity)
    error->one(FLERR, ("two clusters touch at up to " + std::to_string(count) + " sub-spheres at once, more than " +
                       std::to_string(ContactBlock::capacity) +
                       ": use a coarser shape, or a smaller time step if they ran into each other")
                          .c_str());
  const SurfaceSpheres &a = *p.surface_a, &b = *p.surface_b;
  const double *rotation_a = bodies_->rotation(p.a), *rotation_b = bodies_->rotation(p.b);
  const ContactList& before = near_->contacts;
  // What all contacts of the pair have in common.
  const double *va = atom->v[p.a], *vb = atom->v[p.b], *wa = atom->omega[p.a], *wb = atom->omega[p.b];
  double velocity[3] = {va[0] - vb[0], va[1] - vb[1], va[2] - vb[2]};
  cross_add(wb, offset, velocity);
  const double spin[3] = {wa[0] - wb[0], wa[1] - wb[1], wa[2] - wb[2]};
  const double mass_a = atom->rmass[p.a], mass_b = atom->rmass[p.b];
  double mass = mass_a * mass_b / (mass_a + mass_b);
  if (atom->mask[p.a] & freeze_group_bit())
    mass = mass_b;
  if (atom->mask[p.b] & freeze_group_bit())
    mass = mass_a;
  const int ta = atom->type[p.a], tb = atom->type[p.b];
  const double youngs = youngs_[ta][tb], shear = shear_[ta][tb], damping = -damping_[ta][tb];
  const double friction = friction_[ta][tb];

  const int first = filled_;
  int m = first;
  for (int n = 0; n < count; ++n) {
    const int id = ids[n], ka = contact_sphere_a(id), kb = contact_sphere_b(id);
    double arm[3] = {0, 0, 0}, arm_b[3] = {0, 0, 0};
    if (!p.direct) {
      const double body_a[3] = {a.x[ka], a.y[ka], a.z[ka]}, body_b[3] = {b.x[kb], b.y[kb], b.z[kb]};
      to_world(rotation_a, body_a, arm);
      to_world(rotation_b, body_b, arm_b);
    }
    const double sx = arm[0] - arm_b[0] - offset[0], sy = arm[1] - arm_b[1] - offset[1];
    const double sz = arm[2] - arm_b[2] - offset[2];
    const double ra = a.r[ka] + p.extra_a, rb = b.r[kb] + p.extra_b;
    if (sx * sx + sy * sy + sz * sz >= (ra + rb) * (ra + rb))
      continue;
    while (old < old_last && before.id[old] < id)
      ++old;
    const bool known = old < old_last && before.id[old] == id;
    c.separation[0][m] = sx;
    c.separation[1][m] = sy;
    c.separation[2][m] = sz;
    c.arm[0][m] = arm[0];
    c.arm[1][m] = arm[1];
    c.arm[2][m] = arm[2];
    c.radius_a[m] = ra;
    c.radius_b[m] = rb;
    c.history[0][m] = known ? before.displacement[0][old] : 0;
    c.history[1][m] = known ? before.displacement[1][old] : 0;
    c.history[2][m] = known ? before.displacement[2][old] : 0;
    c.velocity[0][m] = velocity[0];
    c.velocity[1][m] = velocity[1];
    c.velocity[2][m] = velocity[2];
    c.spin[0][m] = spin[0];
    c.spin[1][m] = spin[1];
    c.spin[2][m] = spin[2];
    c.mass[m] = mass;
    c.youngs[m] = youngs;
    c.shear_modulus[m] = shear;
    c.damping[m] = damping;
    c.friction[m] = friction;
    c.share[m] = 1;
    block_ids_[m] = id;
    ++m;
  }
  if (m == first)
    return;
  in_block_.push_back({p.a, p.b, first, m, {offset[0], offset[1], offset[2]}});
  contact_count_ += m - first;
  filled_ = m;
  if (filled_ >= contacts_per_block)
    flush();
}

template <DampingLaw law> void PairGranCluster::compute_block(int padded) {
  contact_geometry(block_, padded);
  if (words_.sharing == ContactSharing::shared) {
    share_damping();
    weigh_off_centre();
  }
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

/// Impacts off centre have less mass to bring to rest.
void PairGranCluster::weigh_off_centre() {
  ContactBlock& c = block_;
  const int held = freeze_group_bit();
  const auto at_impact = [&](int i) {
    return BodyAtImpact{atom->rmass[i], (atom->mask[i] & held) != 0, &bodies_->shapes().surface(bodies_->shape_id(i)),
                        bodies_->rotation(i)};
  };
  for (const PairInBlock& p : in_block_) {
    const BodyAtImpact a = at_impact(p.a), b = at_impact(p.b);
    if (a.surface->single_at_centre && b.surface->single_at_centre)
      continue;
    const double factor = off_centre_factor(c, p.first, p.last, p.offset, a, b);
    for (int m = p.first; m < p.last; ++m)
      c.share[m] *= factor;
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
  ContactList& next = near_->next;
  next.id.insert(next.id.end(), block_ids_, block_ids_ + filled_);
  for (int k = 0; k < 3; ++k)
    next.displacement[k].insert(next.displacement[k].end(), c.history[k], c.history[k] + filled_);
  for (const PairInBlock& p : in_block_)
    scatter(p);
  in_block_.clear();
  filled_ = 0;
}

/// Adds the forces of one pair of bodies to the atoms of this rank.
void PairGranCluster::scatter(const PairInBlock& p) {
  const ContactBlock& c = block_;
  double force[3] = {0, 0, 0}, torque[3] = {0, 0, 0};
  for (int m = p.first; m < p.last; ++m)
    for (int k = 0; k < 3; ++k) {
      force[k] += c.force[k][m];
      torque[k] += c.torque[k][m];
    }
  const int local = atom->nlocal;
  if (p.a < local)
    for (int k = 0; k < 3; ++k) {
      atom->f[p.a][k] += force[k];
      atom->torque[p.a][k] += torque[k];
    }
  if (p.b < local) {
    double torque_b[3] = {-torque[0], -torque[1], -torque[2]};
    cross_add(p.offset, force, torque_b);
    for (int k = 0; k < 3; ++k) {
      atom->f[p.b][k] -= force[k];
      atom->torque[p.b][k] += torque_b[k];
    }
  }
  if (evflag)
    ev_tally_xyz(p.a, p.b, local, 0, 0., 0., force[0], force[1], force[2], -p.offset[0], -p.offset[1], -p.offset[2]);
}

} // namespace eccentra::cluster
