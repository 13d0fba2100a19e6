// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The short way of wall/gran/cluster for clusters on planes and cylinders: contacts are written straight into the block
// of the contact law, body after body. Meshes go the long way, by lists of WallTouch.
#include "contact/plain_wall.h"
#include "contact/rigid_rotation.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include "atom.h"
#include "update.h"

#include <algorithm>
#include <cmath>

namespace eccentra::styles {

void FixWallGranCluster::cluster_forces() {
  const contact::PlainWall wall(*arguments_.surface);
  int m = 0;
  begin_groups();
  const auto flush = [&] {
    evaluate(*block_, m, !update->setupflag);
    scatter_clusters(wall);
    begin_groups();
    m = 0;
  };
  for (const int i : near_clusters_) {
    double normal[3], from[3];
    const contact::SurfaceSpheres& spheres = bodies_->shapes().surface(bodies_->shape_id(i));
    if (hits_.size() < static_cast<std::size_t>(spheres.padded))
      hits_.resize(spheres.padded);
    if (spheres.hull) {
      collect(i);
      continue;
    }
    int count = 0;
    if (contact::nearest(wall, atom->x[i], normal, from) < atom->radius[i]) // of the bounding sphere
      count = contact::spheres_at_wall(wall, from, bodies_->rotation(i), spheres, hits_.data());
    if (count > contact::ContactBlock::capacity) {
      collect(i); // the long way; forces come when all others are done
      continue;
    }
    if (m + count > contact::ContactBlock::capacity)
      flush();
    m = add_cluster(wall, i, count, m);
    if (m >= kBatch)
      flush();
  }
  flush();
}

int FixWallGranCluster::add_cluster(const contact::PlainWall& wall, int i, int count, const int first) {
  contact::ContactBlock& block = *block_;
  contact::WallHistory::Entries& entries = history_[i];
  int m = first;
  if (count > 0) {
    const contact::SurfaceSpheres& spheres = bodies_->shapes().surface(bodies_->shape_id(i));
    const double *x = atom->x[i], *v = atom->v[i], *w = wall.omega, *rotation = bodies_->rotation(i);
    for (int n = 0; n < count; ++n) {
      const int k = hits_[n];
      const double body[3] = {spheres.x[k], spheres.y[k], spheres.z[k]}, radius = spheres.r[k];
      double arm[3], normal[3], from[3];
      contact::to_world(rotation, body, arm);
      const double centre[3] = {x[0] + arm[0], x[1] + arm[1], x[2] + arm[2]};
      const double distance = contact::nearest(wall, centre, normal, from);
      if (distance >= radius)
        continue;
      double at[3]; // the wall's point, from its reference
      for (int d = 0; d < 3; ++d)
        at[d] = from[d] - distance * normal[d];
      const double turning[3] = {w[1] * at[2] - w[2] * at[1], w[2] * at[0] - w[0] * at[2], w[0] * at[1] - w[1] * at[0]};
      for (int d = 0; d < 3; ++d) {
        block.normal[d][m] = normal[d];
        block.arm[d][m] = arm[d];
        block.velocity[d][m] = v[d] - (wall.velocity[d] + turning[d]);
      }
      block.radius_a[m] = radius;
      block.overlap[m] = radius - distance;
      block.contact_radius[m] = std::sqrt(radius * (radius - distance));
      contact::set_curvature(wall, normal, from, distance, block, m);
      sub_in_block_[m] = k;
      ++m;
    }
  }
  if (m == first) {
    if (!entries.empty())
      entries.clear();
    return m;
  }

  // As a rule the contacts are those of the last step.
  bool same = entries.size() == static_cast<std::size_t>(m - first);
  for (int n = first; same && n < m; ++n)
    same = entries[n - first].key == contact::WallContactKey(sub_in_block_[n], 0, 0);
  if (!same) {
    next_history_.clear();
    for (int n = first; n < m; ++n) {
      const contact::WallContactKey key(sub_in_block_[n], 0, 0);
      const auto old = std::find_if(entries.begin(), entries.end(),
                                    [&](const contact::WallHistoryEntry& entry) { return entry.key == key; });
      next_history_.push_back(old != entries.end()
                                  ? *old
                                  : contact::WallHistoryEntry{key, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
    }
    entries.swap(next_history_);
  }
  const double *omega = atom->omega[i], mass = atom->rmass[i];
  const int type = atom->type[i], wall_type = arguments_.type;
  for (int n = first; n < m; ++n) {
    for (int d = 0; d < 3; ++d) {
      block.spin[d][n] = omega[d]; // the wall's own is in its velocity
      block.history[d][n] = entries[n - first].shear[d];
    }
    block.mass[n] = mass;
  }
  materials_.fill(block, first, m, type, wall_type);
  add_group(i, first, m);
  return m;
}

void FixWallGranCluster::scatter_clusters(const contact::PlainWall& wall) {
  const contact::ContactBlock& block = *block_;
  for (int n = 0; n < groups_; ++n) {
    const Group& cluster = group_[n];
    const int i = cluster.atom;
    contact::WallHistory::Entries& entries = history_[i];
    double force[3] = {0, 0, 0}, torque[3] = {0, 0, 0}, from[3];
    if (records_)
      for (int m = cluster.first; m < cluster.last; ++m)
        records_->add(block, m, i, ContactRecord::wall, sub_in_block_[m], 0);
    for (int m = cluster.first; m < cluster.last; ++m)
      for (int d = 0; d < 3; ++d) {
        force[d] += block.force[d][m];
        torque[d] += block.torque[d][m];
        entries[m - cluster.first].shear[d] = block.history[d][m];
      }
    if (rolls(i))
      for (int m = cluster.first; m < cluster.last; ++m) {
        const Eigen::Vector3d spin(wall.omega[0], wall.omega[1], wall.omega[2]);
        const Eigen::Vector3d rolling = rolling_torque(block, m, i, arguments_.type, spin, entries[m - cluster.first]);
        for (int d = 0; d < 3; ++d)
          torque[d] += rolling[d];
      }
    for (int d = 0; d < 3; ++d)
      from[d] = atom->x[i][d] - wall.reference[d];
    const double moment[3] = {from[1] * force[2] - from[2] * force[1], from[2] * force[0] - from[0] * force[2],
                              from[0] * force[1] - from[1] * force[0]};
    for (int d = 0; d < 3; ++d) {
      atom->f[i][d] += force[d];
      atom->torque[i][d] += torque[d];
      local_sums_[d] -= force[d];
      local_sums_[3 + d] -= moment[d] + torque[d];
    }
    local_sums_[6] += cluster.last - cluster.first;
  }
}

} // namespace eccentra::styles
