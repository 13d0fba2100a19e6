// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: forces of the contacts that were found, in blocks.
#include "styles/walls/wall_gran_cluster.h"

#include "base/eigen_views.h"
#include "styles/bodies/bodies.h"

#include "atom.h"
#include "update.h"

#include <algorithm>
#include <cmath>

namespace eccentra::cluster {

// The wall is body B of the contact law: its velocity is that at the contact point, so its spin adds nothing.
void FixWallGranCluster::fill(int m, const WallTouch& touch) {
  ContactBlock& block = *block_;
  const int i = touch.atom;
  const int type = atom->type[i];
  const Eigen::Vector3d to_centre = touch.lever + (touch.radius - 0.5 * touch.overlap) * touch.normal;
  const Eigen::Vector3d& shear = touch.history->shear;
  for (int k = 0; k < 3; ++k) {
    block.normal[k][m] = touch.normal[k];
    block.arm[k][m] = to_centre[k];
    block.velocity[k][m] = atom->v[i][k] - touch.wall_velocity[k];
    block.spin[k][m] = atom->omega[i][k];
    block.history[k][m] = shear[k];
  }
  block.radius_a[m] = touch.radius;
  block.overlap[m] = touch.overlap;
  block.contact_radius[m] = std::sqrt(touch.radius * touch.overlap);
  block.mass[m] = atom->rmass[i];
  block.youngs[m] = youngs_[type][touch.wall_type];
  block.shear_modulus[m] = shear_[type][touch.wall_type];
  block.damping[m] = -damping_[type][touch.wall_type];
  block.friction[m] = friction_[type][touch.wall_type];
  block.share[m] = touch.share;
}

Eigen::Vector3d FixWallGranCluster::rolling_torque(int m, int i, int wall_type, const Eigen::Vector3d& wall_spin,
                                                   WallHistoryEntry& entry) {
  const ContactBlock& block = *block_;
  const Eigen::Vector3d normal(block.normal[0][m], block.normal[1][m], block.normal[2][m]);
  const Eigen::Vector3d force(block.force[0][m], block.force[1][m], block.force[2][m]);
  const double kn = 4. / 3. * block.youngs[m] * block.contact_radius[m];
  const double kt = 8 * block.shear_modulus[m] * block.contact_radius[m];
  // Dashpots as contact_forces has them.
  const bool stock = words_.damping == DampingLaw::stock;
  const double factor = (stock ? 2 * std::sqrt(5. / 6.) : 2.) * block.damping[m] * block.share[m];
  const double gamma_n = factor * std::sqrt((stock ? 1.5 : 1.) * kn * block.mass[m]);
  const double gamma_t = factor * std::sqrt((stock ? 1. : 2. / 7.) * kt * block.mass[m]);
  return words_.rolling->torque({i, atom->type[i], wall_type, block.mass[m], kn, kn * block.overlap[m],
                                 block.radius_a[m], normal, vector3(atom->omega[i]) - wall_spin, wall_spin,
                                 entry.rolling.data(), !update->setupflag, force.dot(normal), kt, gamma_n,
                                 words_.tangential_damping ? gamma_t : 0.0});
}

void FixWallGranCluster::scatter(int m, const WallTouch& touch) {
  const ContactBlock& block = *block_;
  const int i = touch.atom;
  const auto row = [m](const ContactBlock::Row* rows) { return Eigen::Vector3d(rows[0][m], rows[1][m], rows[2][m]); };
  touch.history->shear = row(block.history);
  const Eigen::Vector3d force = row(block.force);
  Eigen::Vector3d torque = row(block.torque);
  if (words_.rolling && is_plain_sphere(i))
    torque += rolling_torque(m, i, touch.wall_type, touch.wall_omega, *touch.history);
  add(atom->f[i], force);
  add(atom->torque[i], torque);
  Eigen::Vector3d from_reference = vector3(atom->x[i]);
  if (words_.surface)
    from_reference -= words_.surface->reference();
  add(&local_sums_[0], -force);
  add(&local_sums_[3], -(from_reference.cross(force) + torque));
  local_sums_[6] += 1.0;
  if (meshes_)
    meshes_->report(touch, force);
}

void FixWallGranCluster::evaluate(int n, bool advance) {
  // Whole vectors, so that rounding does not depend on a contact's place; what is left from before does no harm there.
  constexpr int width = 8;
  const int padded = (n + width - 1) / width * width;
  const auto forces = [&](auto contact_forces_of_choice) {
    contact_forces_of_choice(*block_, padded, update->dt, advance);
  };
  if (words_.damping == DampingLaw::stock && words_.tangential_damping)
    forces(contact_forces<DampingLaw::stock, true, ContactBlock>);
  else if (words_.damping == DampingLaw::stock)
    forces(contact_forces<DampingLaw::stock, false, ContactBlock>);
  else if (words_.tangential_damping)
    forces(contact_forces<DampingLaw::paper, true, ContactBlock>);
  else
    forces(contact_forces<DampingLaw::paper, false, ContactBlock>);
}

void FixWallGranCluster::add_forces() {
  const bool advance = !update->setupflag;
  const int all = static_cast<int>(touches_.size());
  for (int first = 0; first < all; first += ContactBlock::capacity) {
    const int n = std::min(all - first, static_cast<int>(ContactBlock::capacity));
    for (int m = 0; m < n; ++m)
      fill(m, touches_[first + m]);
    evaluate(n, advance);
    for (int m = 0; m < n; ++m)
      scatter(m, touches_[first + m]);
  }
  touches_.clear();
}

void FixWallGranCluster::near_forces() {
  if (!near_spheres_.empty())
    sphere_forces();
  touches_.clear();
  if (words_.surface && !near_clusters_.empty())
    cluster_forces();
  else
    for (const int i : near_clusters_) {
      collect(i);
      if (touches_.size() >= kBatch)
        add_forces();
    }
  add_forces();
}

} // namespace eccentra::cluster
