// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that sleep (fix sleep/cluster) at a wall that stands still: evaluated once, then their forces are added as
// they are. Their history stays where it is.
#include "styles/bodies/fix_sleep_cluster.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include "atom.h"

#include <algorithm>

namespace eccentra::styles {

namespace {

/// A row of forces and torques, put aside.
std::array<double, 6> row_of(const LAMMPS_NS::Atom& atom, int i) {
  std::array<double, 6> row;
  std::copy(atom.f[i], atom.f[i] + 3, row.data());
  std::copy(atom.torque[i], atom.torque[i] + 3, row.data() + 3);
  return row;
}

void set_row(LAMMPS_NS::Atom& atom, int i, const std::array<double, 6>& row) {
  std::copy(row.data(), row.data() + 3, atom.f[i]);
  std::copy(row.data() + 3, row.data() + 6, atom.torque[i]);
}

} // namespace

/// Where a wall moves, or may move (meshes), its sleepers feel it: they are evaluated like all others.
bool FixWallGranCluster::stands_still() const {
  return arguments_.surface && arguments_.surface->angular_velocity().isZero(0) &&
         arguments_.surface->velocity_at(arguments_.surface->reference()).isZero(0);
}

/// Takes bodies that have fallen asleep out of the lists, brings others back, and adds what is kept of the former.
void FixWallGranCluster::rest() {
  bool changed = asleep_.size() != near_.size();
  asleep_.resize(near_.size(), 0);
  for (std::size_t n = 0; n < near_.size(); ++n) {
    const char now = sleep_->asleep(near_[n]);
    changed = changed || now != asleep_[n];
    asleep_[n] = now;
  }
  if (changed) {
    std::vector<Resting> before;
    before.swap(resting_);
    near_spheres_.clear();
    near_clusters_.clear();
    auto old = before.begin();
    for (std::size_t n = 0; n < near_.size(); ++n) {
      const int i = near_[n];
      while (old != before.end() && old->atom < i)
        ++old;
      if (!asleep_[n])
        (moves_like_sphere(i) ? near_spheres_ : near_clusters_).push_back(i);
      else
        resting_.push_back(old != before.end() && old->atom == i ? *old : evaluate_alone(i));
    }
  }
  for (const Resting& body : resting_) {
    for (int k = 0; k < 3; ++k) {
      atom->f[body.atom][k] += body.force[k];
      atom->torque[body.atom][k] += body.force[3 + k];
    }
    for (std::size_t k = 0; k < body.sums.size(); ++k)
      local_sums_[k] += body.sums[k];
  }
}

/// Force and torque of the wall on local atom i, and what they add to the sums; nothing else changes.
FixWallGranCluster::Resting FixWallGranCluster::evaluate_alone(int i) {
  const std::array<double, 6> forces = row_of(*atom, i);
  const auto sums = local_sums_;
  set_row(*atom, i, {});
  local_sums_.fill(0);
  std::vector<int> only = {i}, none;
  std::vector<int>& list = moves_like_sphere(i) ? near_spheres_ : near_clusters_;
  std::vector<int>& other = moves_like_sphere(i) ? near_clusters_ : near_spheres_;
  list.swap(only);
  other.swap(none);
  near_forces();
  list.swap(only);
  other.swap(none);
  const Resting body = {i, row_of(*atom, i), local_sums_};
  local_sums_ = sums;
  set_row(*atom, i, forces);
  return body;
}

} // namespace eccentra::styles
