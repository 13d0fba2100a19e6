// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: contacts through LIGGGHTS's own contact models, one sub-contact after the other.
#include "base/eigen_views.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include "atom.h"
#include "update.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace eccentra::styles {

StockSubContact FixWallGranCluster::stock_contact(const contact::WallTouch& touch) {
  StockSubContact s;
  const int i = touch.atom;
  s.a = i;
  s.b = touch.triangle >= 0 ? touch.triangle : -touch.wall_type;
  s.type_a = atom->type[i];
  s.type_b = touch.wall_type;
  s.radius_a = touch.radius;
  s.radius_b = 0;
  const double distance = touch.radius - touch.overlap;
  const Eigen::Vector3d arm = touch.lever + (touch.radius - 0.5 * touch.overlap) * touch.normal;
  const Eigen::Vector3d omega = base::vector3(atom->omega[i]);
  const Eigen::Vector3d velocity = base::vector3(atom->v[i]) + omega.cross(arm);
  for (int k = 0; k < 3; ++k) {
    s.separation[k] = distance * touch.normal[k];
    s.velocity_a[k] = velocity[k];
    s.velocity_b[k] = touch.wall_velocity[k];
    s.omega_a[k] = omega[k];
    s.omega_b[k] = 0;
    s.arm_a[k] = arm[k];
    s.arm_b[k] = 0;
  }
  s.mass_a = s.mass = atom->rmass[i];
  s.mass_b = 0;
  if (!is_plain_sphere(i) && !bodies_->is_round(i))
    s.volume_a = bodies_->shapes()[bodies_->shape_id(i)].volume();
  s.step = update->dt;
  s.advance = false;
  no_history_.assign(stock_->history_size() + 1, 0.);
  s.history = no_history_.data();
  if (touch.history) {
    touch.history->more.resize(stock_->history_size(), 0.);
    s.history = touch.history->more.data();
  }
  return s;
}

template <class Block>
void FixWallGranCluster::stock_stiffness(Block& block, const contact::WallTouch* touches, int n) {
  for (int m = 0; m < n; ++m) {
    block.kn[m] = block.kt[m] = block.gamma_n[m] = block.gamma_t[m] = 0;
    block.overlap[m] = std::max(0., touches[m].overlap);
    if (touches[m].overlap <= 0)
      continue;
    StockSubContact s = stock_contact(touches[m]);
    stock_->stiffness(s);
    block.kn[m] = s.kn;
    block.kt[m] = s.kt;
    block.gamma_n[m] = s.gamma_n;
    block.gamma_t[m] = s.gamma_t;
  }
  for (int m = n; m < contact::whole_vectors(n); ++m)
    block.kn[m] = block.overlap[m] = block.gamma_n[m] = block.gamma_t[m] = 0;
  if (arguments_.shared)
    share_groups(block, n);
}

template <class Block>
void FixWallGranCluster::stock_evaluate(Block& block, const contact::WallTouch* touches, int n, bool advance) {
  if (stock_contacts_.size() < static_cast<std::size_t>(n))
    stock_contacts_.resize(n + contact::ContactBlock::capacity);
  for (int m = 0; m < n; ++m) {
    StockSubContact& s = stock_contacts_[m] = stock_contact(touches[m]);
    if (double* spring = stock_->displacement(s.history))
      for (int k = 0; k < 3; ++k)
        spring[k] = block.history[k][m];
    s.advance = advance;
  }
  stock_->begin(stock_contacts_.data(), n);
  for (int m = 0; m < n; ++m) {
    block.kn[m] = stock_contacts_[m].kn;
    block.overlap[m] = std::max(0., touches[m].overlap);
    block.gamma_n[m] = block.gamma_t[m] = 1;
  }
  for (int m = n; m < contact::whole_vectors(n); ++m)
    block.kn[m] = block.overlap[m] = block.gamma_n[m] = block.gamma_t[m] = 0;
  if (arguments_.shared && groups_ > 0)
    share_groups(block, n);
  for (int m = 0; m < n; ++m)
    stock_contacts_[m].share = arguments_.shared && groups_ > 0 ? block.share[m] : 1;
  stock_->finish(stock_contacts_.data(), n);
  for (int m = 0; m < n; ++m) {
    const StockSubContact& s = stock_contacts_[m];
    const Eigen::Map<const Eigen::Vector3d> force(s.force), arm(s.arm_a), torque(s.torque_a);
    const Eigen::Vector3d about_centre = torque + arm.cross(force);
    const double* spring = stock_->displacement(s.history);
    for (int k = 0; k < 3; ++k) {
      block.force[k][m] = force[k];
      block.torque[k][m] = about_centre[k];
      block.history[k][m] = spring ? spring[k] : 0;
    }
    block.kn[m] = s.kn;
    block.kt[m] = s.kt;
    block.gamma_n[m] = s.gamma_n;
    block.gamma_t[m] = s.gamma_t;
    block.overlap[m] = touches[m].overlap;
  }
}

template void FixWallGranCluster::stock_stiffness(contact::LargeContactBlock&, const contact::WallTouch*, int);
template void FixWallGranCluster::stock_evaluate(contact::ContactBlock&, const contact::WallTouch*, int, bool);
template void FixWallGranCluster::stock_evaluate(contact::LargeContactBlock&, const contact::WallTouch*, int, bool);

} // namespace eccentra::styles
