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
/// More candidates than this are preselected in single precision; fewer are tested in double precision at once.
constexpr int tested_at_once = 4;
/// Up to so many contacts of a pair share damping each with each, more by way of tensors.
constexpr int shared_each_with_each = 8;

/// Candidates are sub-spheres closer than a skin: wide enough to last `skin_steps` steps of the present relative
/// motion, within these parts of the smallest sub-sphere's radius.
constexpr float skin_steps = 40;
constexpr float skin_narrowest = 0.02f;
constexpr float skin_widest = 0.25f;
/// For bodies that cross the skin in fewer steps it is not worth asking how long they will not touch.
constexpr double worth_asking = 10;
/// A step's path is taken from the velocities at its middle; this allows for its curvature.
constexpr double path_safety = 1.05;
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
  const int pair_count = static_cast<int>(near.pairs.size());
  near.next.clear(pair_count);
  filled_ = pairs_in_block_ = contact_count_ = near_count_ = 0;
  near.update_bodies(path_safety * update->dt);
  if (resting_)
    rest();
  const double* x = atom->x[0]; // LIGGGHTS keeps the rows of these arrays one after the other

  int* first = near.next.first.data();
  const int* old_first = near.contacts.first.data();
  for (int n = 0; n < pair_count; ++n) {
    first[n] = contact_count_;
    PairWake& wake = near.wakes[n];
    const double path = near.path(wake.a) + near.path(wake.b);
    if (path < wake.quiet)
      continue;
    const double *xa = x + 3 * wake.a, *xb = x + 3 * wake.b;
    const double offset[3] = {xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]};
    NearPair& p = near.pairs[n];
    const int count = pair_contacts(p, offset, path, old_first[n], old_first[n + 1]);
    contact_count_ += count;
    if (count == 0)
      wake.quiet = quiet_until(p, offset, path);
  }
  flush(block_);
  first[pair_count] = contact_count_;
  near.accept();
  if (resting_)
    add_resting_forces();
  near.set_counts(contact_count_, near_count_);
}

/// Puts the contacts of a pair of bodies into the block; returns how many there are.
int PairGranCluster::pair_contacts(NearPair& p, const double* offset, double path, int old_first, int old_last) {
  if (p.direct) {
    const int only = contact_id(0, 0);
    return gather(p, offset, &only, 1, old_first, old_last);
  }
  RelativePose pose;
  const bool may_be_stale = path >= p.stale;
  if (may_be_stale) {
    pose = pose_of(p, offset);
    const float moved = p.searched ? pose.moved_since(p.pose, p.bound_b) : 0;
    if (p.searched && moved < p.skin)
      p.stale = path + (p.skin - moved);
    else
      search_candidates(p, pose, offset, path);
  }
  if (p.candidate_count == 0)
    return 0;
  ++near_count_;
  CandidateStore& candidates = near_->candidates;
  if (p.candidate_count <= tested_at_once)
    return gather(p, offset, candidates.id.data() + p.candidate_first, p.candidate_count, old_first, old_last);
  if (!may_be_stale)
    pose = pose_of(p, offset);
  const int padded = CandidateSearch::padded(p.candidate_count);
  if (static_cast<int>(hits_.size()) < padded)
    hits_.resize(2 * padded);
  const int count = overlapping_candidates(candidates, p.candidate_first, padded, pose,
                                           round_off * static_cast<float>(p.range), hits_.data());
  return count > 0 ? gather(p, offset, hits_.data(), count, old_first, old_last) : 0;
}

RelativePose PairGranCluster::pose_of(const NearPair& p, const double* offset) const {
  return {near_->frame(p.a), near_->frame(p.b), offset};
}

/// Length of both bodies' paths up to which a pair that does not touch now cannot touch.
double PairGranCluster::quiet_until(const NearPair& p, const double* offset, double path) const {
  if (p.direct) {
    const double distance = std::sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]);
    return path + (1 - round_off) * (distance - p.range);
  }
  if (p.candidate_count == 0)
    return p.stale;
  if (worth_asking * (near_->last_step(p.a) + near_->last_step(p.b)) > p.skin)
    return path;
  const float gap =
      least_gap(near_->candidates, p.candidate_first, CandidateSearch::padded(p.candidate_count), pose_of(p, offset));
  return std::min(p.stale, path + gap - round_off * p.range);
}

/// Finds the pairs of sub-spheres that can touch soon, with a skin that suits how fast the bodies move past each other.
void PairGranCluster::search_candidates(NearPair& p, const RelativePose& pose, const double* offset, double path) {
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
  const float margin = 2 * round_off * static_cast<float>(p.range);
  const SearchResult found = search_.search(*p.surface_a, extra_a, *p.surface_b, extra_b, pose, skin + margin);
  p.searched = true;
  p.skin = found.slack - margin;
  p.pose = pose;
  p.stale = path + p.skin;
  p.candidate_count = found.count;
  const int room = CandidateSearch::padded(found.count);
  if (room > p.candidate_room) {
    p.candidate_first = store.reserve(room);
    p.candidate_room = room;
  }
  if (found.count > 0)
    search_.write(*p.surface_a, extra_a, *p.surface_b, extra_b, store, p.candidate_first);
}

/// Adds those of the pair's `count` possible contacts that do overlap to the block, with their history; returns how
/// many.
int PairGranCluster::gather(const NearPair& p, const double* offset, const int* ids, int count, int old, int old_last) {
  if (filled_ + count > ContactBlock::capacity)
    flush(block_);
  if (count <= ContactBlock::capacity)
    return gather_into(block_, p, offset, ids, count, old, old_last);
  if (count > LargeContactBlock::capacity)
    error->one(FLERR, ("two clusters touch at up to " + std::to_string(count) + " sub-spheres at once, more than " +
                       std::to_string(LargeContactBlock::capacity) +
                       ": use a coarser shape, or a smaller time step if they ran into each other")
                          .c_str());
  if (!large_block_)
    large_block_ = std::make_unique<LargeContactBlock>();
  const int found = gather_into(*large_block_, p, offset, ids, count, old, old_last);
  flush(*large_block_);
  return found;
}

template <class Block>
int PairGranCluster::gather_into(Block& c, const NearPair& p, const double* offset, const int* ids, int count, int old,
                                 int old_last) {
  const SurfaceSpheres &a = *p.surface_a, &b = *p.surface_b;
  const double *rotation_a = bodies_->rotation(p.a), *rotation_b = bodies_->rotation(p.b);
  const ContactList& before = near_->contacts;
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
    block_ids_[m] = id;
    ++m;
  }
  if (m == first)
    return 0;

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
  for (int n = first; n < m; ++n) {
    c.velocity[0][n] = velocity[0];
    c.velocity[1][n] = velocity[1];
    c.velocity[2][n] = velocity[2];
    c.spin[0][n] = spin[0];
    c.spin[1][n] = spin[1];
    c.spin[2][n] = spin[2];
    c.mass[n] = mass;
    c.youngs[n] = youngs;
    c.shear_modulus[n] = shear;
    c.damping[n] = damping;
    c.friction[n] = friction;
    c.share[n] = 1;
  }
  // Member by member: a whole struct would be put together in memory and read back before it has arrived there.
  PairInBlock& pair = in_block_[pairs_in_block_++];
  pair.a = p.a;
  pair.b = p.b;
  pair.first = first;
  pair.last = m;
  for (int k = 0; k < 3; ++k)
    pair.offset[k] = offset[k];
  filled_ = m;
  if (filled_ >= contacts_per_block)
    flush(c);
  return m - first;
}

template <DampingLaw law, class Block> void PairGranCluster::compute_block(Block& block, int padded) {
  contact_geometry(block, padded);
  if (words_.sharing == ContactSharing::shared) {
    share_damping(block, padded);
    weigh_off_centre(block);
  }
  if (words_.tangential_damping)
    contact_forces<law, true>(block, padded, update->dt, advance_);
  else
    contact_forces<law, false>(block, padded, update->dt, advance_);
}

template <class Block> void PairGranCluster::share_damping(Block& c, int padded) {
  start_shared_sums(c, padded);
  bool any_with_many = false;
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
}

/// Impacts off centre have less mass to bring to rest.
template <class Block> void PairGranCluster::weigh_off_centre(Block& c) {
  const int held = freeze_group_bit();
  const auto at_impact = [&](int i) {
    return BodyAtImpact{atom->rmass[i], (atom->mask[i] & held) != 0, &bodies_->shapes().surface(bodies_->shape_id(i)),
                        bodies_->rotation(i)};
  };
  for (int n = 0; n < pairs_in_block_; ++n) {
    const PairInBlock& p = in_block_[n];
    const BodyAtImpact a = at_impact(p.a), b = at_impact(p.b);
    if (a.surface->single_at_centre && b.surface->single_at_centre)
      continue;
    const double factor = off_centre_factor(c, p.first, p.last, p.offset, a, b);
    for (int m = p.first; m < p.last; ++m)
      c.share[m] *= factor;
  }
}

/// Evaluates the contacts in the block and starts a new one.
template <class Block> void PairGranCluster::flush(Block& c) {
  if (filled_ == 0)
    return;
  const int padded = (filled_ + vector_width - 1) / vector_width * vector_width;
  for (int m = filled_; m < padded; ++m) {
    // A harmless contact in the unused lanes.
    c.separation[0][m] = 1;
    c.separation[1][m] = c.separation[2][m] = 0;
    c.radius_a[m] = c.radius_b[m] = 1;
  }
  if (words_.damping == DampingLaw::stock)
    compute_block<DampingLaw::stock>(c, padded);
  else
    compute_block<DampingLaw::paper>(c, padded);
  ContactList& next = near_->next;
  next.id.insert(next.id.end(), block_ids_, block_ids_ + filled_);
  for (int k = 0; k < 3; ++k)
    next.displacement[k].insert(next.displacement[k].end(), c.history[k], c.history[k] + filled_);
  for (int n = 0; n < pairs_in_block_; ++n)
    scatter(c, in_block_[n]);
  pairs_in_block_ = filled_ = 0;
}

/// Adds the forces of one pair of bodies to the atoms of this rank.
template <class Block> void PairGranCluster::scatter(const Block& c, const PairInBlock& p) {
  double fx = 0, fy = 0, fz = 0, tx = 0, ty = 0, tz = 0;
  for (int m = p.first; m < p.last; ++m) {
    fx += c.force[0][m];
    fy += c.force[1][m];
    fz += c.force[2][m];
    tx += c.torque[0][m];
    ty += c.torque[1][m];
    tz += c.torque[2][m];
  }
  const int local = atom->nlocal;
  double *force = atom->f[0], *torque = atom->torque[0];
  if (p.a < local) {
    double *f = force + 3 * p.a, *t = torque + 3 * p.a;
    f[0] += fx;
    f[1] += fy;
    f[2] += fz;
    t[0] += tx;
    t[1] += ty;
    t[2] += tz;
  }
  if (p.b < local) {
    double *f = force + 3 * p.b, *t = torque + 3 * p.b;
    const double* d = p.offset;
    f[0] -= fx;
    f[1] -= fy;
    f[2] -= fz;
    t[0] += d[1] * fz - d[2] * fy - tx;
    t[1] += d[2] * fx - d[0] * fz - ty;
    t[2] += d[0] * fy - d[1] * fx - tz;
  }
  if (evflag)
    ev_tally_xyz(p.a, p.b, local, 0, 0., 0., fx, fy, fz, -p.offset[0], -p.offset[1], -p.offset[2]);
}

} // namespace eccentra::cluster
