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
void FixWallGranCluster::fill(int m, const contact::WallTouch& touch) {
  contact::ContactBlock& block = *block_;
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
  block.contact_radius[m] = std::max(0., touch.contact_radius());
  block.mass[m] = atom->rmass[i];
  block.youngs[m] = youngs_[type][touch.wall_type];
  block.shear_modulus[m] = shear_[type][touch.wall_type];
  block.damping[m] = -damping_[type][touch.wall_type];
  block.friction[m] = friction_[type][touch.wall_type];
  block.share[m] = touch.share;
}

Eigen::Vector3d FixWallGranCluster::rolling_torque(int m, int i, int wall_type, const Eigen::Vector3d& wall_spin,
                                                   contact::WallHistoryEntry& entry) {
  const contact::ContactBlock& block = *block_;
  const Eigen::Vector3d normal(block.normal[0][m], block.normal[1][m], block.normal[2][m]);
  const Eigen::Vector3d force(block.force[0][m], block.force[1][m], block.force[2][m]);
  const double kn = 4. / 3. * block.youngs[m] * block.contact_radius[m];
  const double kt = 8 * block.shear_modulus[m] * block.contact_radius[m];
  // Dashpots as contact_forces has them.
  const bool stock = arguments_.damping == contact::DampingLaw::stock;
  const double factor = (stock ? 2 * std::sqrt(5. / 6.) : 2.) * block.damping[m] * block.share[m];
  const double gamma_n = factor * std::sqrt((stock ? 1.5 : 1.) * kn * block.mass[m]);
  const double gamma_t = factor * std::sqrt((stock ? 1. : 2. / 7.) * kt * block.mass[m]);
  return arguments_.rolling->torque({i, atom->type[i], wall_type, block.mass[m], kn, kn * block.overlap[m],
                                     block.radius_a[m], normal, base::vector3(atom->omega[i]) - wall_spin, wall_spin,
                                     entry.rolling.data(), !update->setupflag, force.dot(normal), kt, gamma_n,
                                     arguments_.tangential_damping ? gamma_t : 0.0});
}

void FixWallGranCluster::scatter(int m, const contact::WallTouch& touch) {
  const contact::ContactBlock& block = *block_;
  const int i = touch.atom;
  if (records_)
    records_->add(block, m, i, ContactRecord::wall, touch.key.sub(), 0);
  const auto row = [m](const contact::ContactBlock::Row* rows) {
    return Eigen::Vector3d(rows[0][m], rows[1][m], rows[2][m]);
  };
  touch.history->shear = row(block.history);
  Eigen::Vector3d force = row(block.force), torque = row(block.torque);
  if (touch.weight < 0) {
    const Eigen::Vector3d correction = 4. / 3 * block.youngs[m] * touch.contact_radius() * touch.overlap * touch.normal;
    force += correction;
    torque += touch.lever.cross(correction);
  }
  if (arguments_.rolling && is_plain_sphere(i))
    torque += rolling_torque(m, i, touch.wall_type, touch.wall_omega, *touch.history);
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

void FixWallGranCluster::evaluate(int n, bool advance) {
  // Whole vectors, so that rounding does not depend on a contact's place; what is left from before does no harm there.
  constexpr int width = 8;
  const int padded = (n + width - 1) / width * width;
  const auto forces = [&](auto contact_forces_of_choice) {
    contact_forces_of_choice(*block_, padded, update->dt, advance);
  };
  if (arguments_.damping == contact::DampingLaw::stock && arguments_.tangential_damping)
    forces(contact::contact_forces<contact::DampingLaw::stock, true, contact::ContactBlock>);
  else if (arguments_.damping == contact::DampingLaw::stock)
    forces(contact::contact_forces<contact::DampingLaw::stock, false, contact::ContactBlock>);
  else if (arguments_.tangential_damping)
    forces(contact::contact_forces<contact::DampingLaw::paper, true, contact::ContactBlock>);
  else
    forces(contact::contact_forces<contact::DampingLaw::paper, false, contact::ContactBlock>);
}

void FixWallGranCluster::add_forces() {
  const bool advance = !update->setupflag;
  const int all = static_cast<int>(touches_.size());
  for (int first = 0; first < all; first += contact::ContactBlock::capacity) {
    const int n = std::min(all - first, static_cast<int>(contact::ContactBlock::capacity));
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
