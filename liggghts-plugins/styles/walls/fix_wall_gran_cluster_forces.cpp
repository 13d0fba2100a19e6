// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: forces of the contacts that were found, in blocks.
#include "styles/walls/fix_wall_gran_cluster.h"

#include "base/eigen_views.h"
#include "styles/bodies/fix_cluster_bodies.h"

#include "atom.h"
#include "update.h"

#include <algorithm>
#include <cmath>

namespace eccentra::styles {

// The wall is body B of the contact law: its velocity is that at the contact point, so its spin adds nothing.
template <class Block> void FixWallGranCluster::fill(Block& block, int m, const contact::WallTouch& touch) {
  const int i = touch.atom;
  const Eigen::Vector3d to_centre = touch.lever + (touch.radius - 0.5 * touch.overlap) * touch.normal;
  for (int k = 0; k < 3; ++k) {
    block.normal[k][m] = touch.normal[k];
    block.arm[k][m] = to_centre[k];
    block.velocity[k][m] = atom->v[i][k] - touch.wall_velocity[k];
    block.spin[k][m] = atom->omega[i][k];
    block.history[k][m] = touch.history ? touch.history->shear[k] : 0;
  }
  block.radius_a[m] = touch.radius;
  block.overlap[m] = touch.overlap;
  block.contact_radius[m] = std::max(0., touch.contact_radius());
  set_curvature(block, m, touch);
  block.mass[m] = atom->rmass[i];
  if (!stock_)
    materials_.fill(block, m, m + 1, atom->type[i], touch.wall_type);
}

/// How the normal turns as the body moves past a wall that is round.
template <class Block>
void FixWallGranCluster::set_curvature(Block& block, int m, const contact::WallTouch& touch) const {
  block.curvature[m] = 0;
  if (!arguments_.surface || arguments_.surface->is_plane())
    return;
  const contact::WallSurface& wall = *arguments_.surface;
  for (int k = 0; k < 3; ++k)
    block.separation[k][m] = wall.direction()[k];
  if (touch.hertz_radius > 0) // of a rounded body
    return;
  const double distance = touch.radius - touch.overlap;
  const Eigen::Vector3d from_axis = base::vector3(atom->x[touch.atom]) + touch.to_wall - wall.reference();
  const bool outside = touch.normal.dot(from_axis) > 0;
  block.curvature[m] = outside ? 1 / (wall.radius() + distance) : -1 / (wall.radius() - distance);
}

template <class Block>
Eigen::Vector3d FixWallGranCluster::rolling_torque(const Block& block, int m, int i, int wall_type,
                                                   const Eigen::Vector3d& wall_spin, contact::WallHistoryEntry& entry) {
  const Eigen::Vector3d normal(block.normal[0][m], block.normal[1][m], block.normal[2][m]);
  const Eigen::Vector3d force(block.force[0][m], block.force[1][m], block.force[2][m]);
  double lever = block.radius_a[m];
  if (arguments_.rolling_radius == RollingRadius::body) {
    const Eigen::Vector3d to_centre(block.arm[0][m], block.arm[1][m], block.arm[2][m]);
    lever = (to_centre - (lever - 0.5 * block.overlap[m]) * normal).norm();
  }
  // Dampers of rolling go with the root of the inertia.
  const double share = arguments_.shared && groups_ > 0 ? block.share[m] : 1;
  return arguments_.rolling->torque(
      {i, atom->type[i], wall_type, block.mass[m] * share * share, block.kn[m], block.kn[m] * block.overlap[m], lever,
       normal, base::vector3(atom->omega[i]) - wall_spin, wall_spin, entry.rolling.data(), !update->setupflag,
       force.dot(normal), block.kt[m], block.gamma_n[m], block.gamma_t[m]});
}

template Eigen::Vector3d FixWallGranCluster::rolling_torque(const contact::ContactBlock&, int, int, int,
                                                            const Eigen::Vector3d&, contact::WallHistoryEntry&);

template <class Block> void FixWallGranCluster::scatter(const Block& block, int m, const contact::WallTouch& touch) {
  const int i = touch.atom;
  if (records_)
    records_->add(block, m, i, ContactRecord::wall, touch.key.sub(), 0);
  const auto row = [m](const auto* rows) { return Eigen::Vector3d(rows[0][m], rows[1][m], rows[2][m]); };
  touch.history->shear = row(block.history);
  Eigen::Vector3d force = row(block.force), torque = row(block.torque);
  if (touch.weight < 0) {
    const Eigen::Vector3d correction =
        4. / 3 * block.material[0][m] * touch.contact_radius() * touch.overlap * touch.normal;
    force += correction;
    torque += touch.lever.cross(correction);
  }
  if (rolls(i) && touch.weight > 0 && touch.overlap > 0)
    torque += rolling_torque(block, m, i, touch.wall_type, touch.wall_omega, *touch.history);
  base::add(atom->f[i], force);
  base::add(atom->torque[i], torque);
  Eigen::Vector3d from_reference = base::vector3(atom->x[i]);
  if (arguments_.surface)
    from_reference -= arguments_.surface->reference();
  base::add(&local_sums_[0], -force);
  base::add(&local_sums_[3], -(from_reference.cross(force) + torque));
  local_sums_[6] += 1.0;
  if (meshes_)
    meshes_->report(touch, force);
}

contact::LargeContactBlock& FixWallGranCluster::large_block(int count) {
  if (!large_block_)
    large_block_ = std::make_unique<contact::LargeContactBlock>();
  large_block_->reserve(count);
  if (group_of_.size() < static_cast<std::size_t>(count))
    group_of_.resize(count);
  return *large_block_;
}

void FixWallGranCluster::add_group(int i, int first, int last) {
  const int k = groups_++;
  group_[k] = {i, first, last};
  std::fill(group_of_.begin() + first, group_of_.begin() + last, k);
  impacts_.ease_a[k] = 1; // the wall is held and has no inertia: its rows stay 0
  double inverse[6] = {0, 0, 0, 0, 0, 0};
  if (!is_plain_sphere(i)) {
    const contact::SurfaceSpheres& surface = bodies_->shapes().surface(bodies_->shape_id(i));
    std::copy_n(surface.inverse_inertia, 3, inverse);
    if (!surface.equal_moments) {
      const Eigen::Matrix3d r = base::row_major(bodies_->rotation(i));
      const Eigen::Matrix3d turned = r * Eigen::Map<const Eigen::Vector3d>(inverse).asDiagonal() * r.transpose();
      const double six[6] = {turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(0, 2), turned(1, 2)};
      std::copy_n(six, 6, inverse);
    }
  }
  for (int d = 0; d < 6; ++d)
    impacts_.inverse_a[d][k] = inverse[d];
}

template <class Block> void FixWallGranCluster::stiffness(Block& block, int n) {
  model_->stiffness(block, contact::whole_vectors(n), arguments_.damping_choice());
  if (arguments_.shared && groups_ > 0)
    share_groups(block, n);
}

template void FixWallGranCluster::stiffness(contact::LargeContactBlock& block, int n);

template <class Block> void FixWallGranCluster::share_groups(Block& block, int n) {
  shares_.apply(
      block, n, group_of_.data(), groups_,
      [this](int k) {
        return contact::ContactGroup{group_[k].first, group_[k].last};
      },
      impacts_);
}

template void FixWallGranCluster::share_groups(contact::ContactBlock& block, int n);
template void FixWallGranCluster::share_groups(contact::LargeContactBlock& block, int n);

/// Whole vectors, so that rounding does not depend on a contact's place; what is left from before does no harm there.
template <class Block> void FixWallGranCluster::evaluate(Block& block, int n, bool advance) {
  stiffness(block, n);
  const int padded = contact::whole_vectors(n);
  const bool round = arguments_.surface && !arguments_.surface->is_plane();
  contact::contact_forces(block, padded, update->dt, advance, {arguments_.friction, arguments_.synchronised, round});
}

template void FixWallGranCluster::evaluate(contact::ContactBlock& block, int n, bool advance);

/// Forces of touches_[first] to touches_[last - 1], which are all that their atoms have.
template <class Block> void FixWallGranCluster::add_forces(Block& block, std::size_t first, std::size_t last) {
  begin_groups();
  int of_group = 0;
  const int n = static_cast<int>(last - first);
  for (int m = 0; m < n; ++m) {
    fill(block, m, touches_[first + m]);
    const bool last_of_atom = m + 1 == n || touches_[first + m + 1].atom != touches_[first + m].atom;
    if (!last_of_atom)
      continue;
    add_group(touches_[first + m].atom, of_group, m + 1);
    of_group = m + 1;
  }
  if (stock_)
    stock_evaluate(block, touches_.data() + first, n, !update->setupflag);
  else
    evaluate(block, n, !update->setupflag);
  for (int m = 0; m < n; ++m)
    scatter(block, m, touches_[first + m]);
}

void FixWallGranCluster::add_forces() {
  constexpr std::size_t capacity = contact::ContactBlock::capacity;
  const std::size_t all = touches_.size();
  std::size_t first = 0, last = 0;
  while (last < all) {
    std::size_t next = last + 1; // one past this atom's
    while (next < all && touches_[next].atom == touches_[last].atom)
      ++next;
    if (next - first > capacity && last > first) {
      add_forces(*block_, first, last);
      first = last;
    }
    last = next;
    if (last - first > capacity) {
      add_forces(large_block(static_cast<int>(last - first)), first, last);
      first = last;
    }
  }
  if (last > first)
    add_forces(*block_, first, last);
  touches_.clear();
}

void FixWallGranCluster::near_forces() {
  if (stock_) {
    touches_.clear();
    for (const std::vector<int>* list : {&near_spheres_, &near_clusters_})
      for (const int i : *list) {
        collect(i);
        if (touches_.size() >= kBatch)
          add_forces();
      }
    add_forces();
    return;
  }
  if (!near_spheres_.empty())
    sphere_forces();
  touches_.clear();
  if (arguments_.surface && !near_clusters_.empty())
    cluster_forces();
  else
    for (const int i : near_clusters_) {
      collect(i);
      if (touches_.size() >= kBatch)
        add_forces();
    }
  add_forces();
}

} // namespace eccentra::styles
