// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The short way of wall/gran/cluster for plain spheres on planes and cylinders: one contact each, written straight into
// the block of the contact law. Plain numbers throughout: small vectors cost more to move than to compute with.
#include "contact/plain_wall.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include "atom.h"
#include "update.h"

#include <cmath>

namespace eccentra::styles {

void FixWallGranCluster::sphere_forces() {
  const contact::PlainWall wall(*arguments_.surface);
  const std::size_t all = near_spheres_.size();
  std::size_t next = 0;
  begin_groups(); // a sphere has one contact here, which shares with none
  while (next < all) {
    int n = 0;
    while (next < all && n < kBatch)
      n = add_sphere(wall, near_spheres_[next++], n);
    evaluate(*block_, n, !update->setupflag);
    scatter_spheres(wall, n);
  }
}

int FixWallGranCluster::add_sphere(const contact::PlainWall& wall, int i, int m) {
  double normal[3], from[3];
  const double radius = atom->radius[i];
  const double distance = contact::nearest(wall, atom->x[i], normal, from);
  contact::WallHistory::Entries& entries = history_[i];
  if (distance >= radius) {
    if (!entries.empty())
      entries.clear();
    return m;
  }
  if (entries.empty())
    entries.push_back({contact::WallContactKey(0, 0, 0), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  contact::ContactBlock& block = *block_;
  const double overlap = radius - distance;
  double at_wall[3];
  for (int k = 0; k < 3; ++k)
    at_wall[k] = from[k] - distance * normal[k];
  const double* w = wall.omega;
  const double turning[3] = {w[1] * at_wall[2] - w[2] * at_wall[1], w[2] * at_wall[0] - w[0] * at_wall[2],
                             w[0] * at_wall[1] - w[1] * at_wall[0]};
  const int type = atom->type[i];
  const int wall_type = arguments_.type;
  for (int k = 0; k < 3; ++k) {
    block.normal[k][m] = normal[k];
    block.arm[k][m] = 0;
    block.velocity[k][m] = atom->v[i][k] - (wall.velocity[k] + turning[k]);
    block.spin[k][m] = atom->omega[i][k]; // the wall's own is in its velocity
    block.history[k][m] = entries[0].shear[k];
  }
  block.radius_a[m] = radius;
  block.overlap[m] = overlap;
  block.contact_radius[m] = std::sqrt(radius * overlap);
  contact::set_curvature(wall, normal, from, distance, block, m);
  block.mass[m] = atom->rmass[i];
  materials_.fill(block, m, m + 1, type, wall_type);
  in_block_[m] = i;
  return m + 1;
}

void FixWallGranCluster::scatter_spheres(const contact::PlainWall& wall, int n) {
  const contact::ContactBlock& block = *block_;
  for (int m = 0; m < n; ++m) {
    const int i = in_block_[m];
    contact::WallHistoryEntry& entry = history_[i][0];
    if (records_)
      records_->add(block, m, i, ContactRecord::wall, 0, 0);
    double force[3], torque[3], from[3];
    for (int k = 0; k < 3; ++k) {
      entry.shear[k] = block.history[k][m];
      force[k] = block.force[k][m];
      torque[k] = block.torque[k][m];
      from[k] = atom->x[i][k] - wall.reference[k];
    }
    if (arguments_.rolling) {
      const Eigen::Vector3d spin(wall.omega[0], wall.omega[1], wall.omega[2]);
      const Eigen::Vector3d rolling = rolling_torque(block, m, i, arguments_.type, spin, entry);
      for (int k = 0; k < 3; ++k)
        torque[k] += rolling[k];
    }
    const double moment[3] = {from[1] * force[2] - from[2] * force[1], from[2] * force[0] - from[0] * force[2],
                              from[0] * force[1] - from[1] * force[0]};
    for (int k = 0; k < 3; ++k) {
      atom->f[i][k] += force[k];
      atom->torque[i][k] += torque[k];
      local_sums_[k] -= force[k];
      local_sums_[3 + k] -= moment[k] + torque[k];
    }
  }
  local_sums_[6] += n;
}

} // namespace eccentra::styles
