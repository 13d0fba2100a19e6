// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of pair_style gran/cluster through LIGGGHTS's own contact models, one sub-contact after the other.
#include "styles/pairs/pair_gran_cluster.h"

#include "update.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace eccentra::styles {

namespace {

/// Velocity of a body's matter at `arm` from its centre.
void velocity_at(const contact::BodyState& body, const double* arm, double* v) {
  const double* w = body.omega;
  v[0] = body.v[0] + (w[1] * arm[2] - w[2] * arm[1]);
  v[1] = body.v[1] + (w[2] * arm[0] - w[0] * arm[2]);
  v[2] = body.v[2] + (w[0] * arm[1] - w[1] * arm[0]);
}

} // namespace

/// What contact m of the block is for stock's models.
template <class Block> void PairGranCluster::fill_stock(const Block& c, int m, StockSubContact& s) {
  const int pair = block_pair_[m];
  const PairInBlock& p = in_block_[pair];
  const contact::BodyState &a = near_->body(p.a), &b = near_->body(p.b);
  s.a = p.a;
  s.b = p.b;
  s.type_a = a.type;
  s.type_b = b.type;
  s.radius_a = c.radius_a[m];
  s.radius_b = c.radius_b[m];
  for (int k = 0; k < 3; ++k) {
    s.separation[k] = c.separation[k][m];
    s.arm_a[k] = c.arm[k][m];
    s.arm_b[k] = c.arm[k][m] - c.separation[k][m] - pairs_.offset[k][pair];
    s.omega_a[k] = a.omega[k];
    s.omega_b[k] = b.omega[k];
  }
  velocity_at(a, s.arm_a, s.velocity_a);
  velocity_at(b, s.arm_b, s.velocity_b);
  s.mass_a = a.mass;
  s.mass_b = b.mass;
  s.mass = c.mass[m];
  if (reach_ > 1) { // liquid bridges count per volume
    const auto volume = [this](int i) {
      return bodies_->is_round(i) ? 0. : bodies_->shapes()[bodies_->shape_id(i)].volume();
    };
    s.volume_a = volume(p.a);
    s.volume_b = volume(p.b);
  }
  s.step = update->dt;
  s.history = block_more_.data() + near_->next.width * m;
  s.advance = advance_;
}

template <class Block> void PairGranCluster::compute_stock(Block& c) {
  move_history_on();
  const int width = near_->next.width;
  double* histories = near_->next.more.data() + near_->next.more.size() - static_cast<std::size_t>(width) * filled_;
  if (stock_contacts_.size() < static_cast<std::size_t>(filled_))
    stock_contacts_.resize(filled_ + contact::ContactBlock::capacity);
  for (int m = 0; m < filled_; ++m) {
    StockSubContact& s = stock_contacts_[m];
    fill_stock(c, m, s);
    s.history = histories + width * m;
    if (double* spring = stock_->displacement(s.history)) // commands that turn bodies know this one
      for (int k = 0; k < 3; ++k)
        spring[k] = c.history[k][m];
    s.share = 1;
  }
  stock_->begin(stock_contacts_.data(), filled_);
  for (int m = 0; m < filled_; ++m)
    for (int k = 0; k < 3; ++k)
      c.normal[k][m] = stock_contacts_[m].normal[k];
  if (arguments_.sharing == ContactSharing::shared && !single_contacts_)
    share_stock(c);
  stock_->finish(stock_contacts_.data(), filled_);
  excess_torques_.assign(pairs_in_block_, Eigen::Vector3d::Zero());
  for (int m = 0; m < filled_; ++m) {
    const StockSubContact& s = stock_contacts_[m];
    // About the bodies' centres.
    const Eigen::Map<const Eigen::Vector3d> force(s.force), arm_a(s.arm_a), arm_b(s.arm_b), on_a(s.torque_a),
        on_b(s.torque_b);
    const Eigen::Vector3d torque = on_a + arm_a.cross(force);
    const int pair = block_pair_[m];
    const Eigen::Vector3d offset(pairs_.offset[0][pair], pairs_.offset[1][pair], pairs_.offset[2][pair]);
    excess_torques_[pair] += on_b - arm_b.cross(force) - (offset.cross(force) - torque);
    c.overlap[m] = s.overlap; // for whoever writes the contacts down
    const double* spring_after = stock_->displacement(s.history);
    for (int k = 0; k < 3; ++k) {
      c.force[k][m] = force[k];
      c.torque[k][m] = torque[k];
      c.history[k][m] = spring_after ? spring_after[k] : 0;
    }
  }
}

/// History moves on where it stays until the next step: fix rolling/limited writes to it after all forces.
void PairGranCluster::move_history_on() {
  std::vector<double>& more = near_->next.more;
  const std::size_t count = static_cast<std::size_t>(near_->next.width) * filled_, needed = more.size() + count;
  if (needed > more.capacity()) {
    std::vector<double> wider;
    wider.reserve(2 * needed);
    wider.assign(more.begin(), more.end());
    more.swap(wider);
    outgrown_.push_back(std::move(wider)); // what has been told about it still is memory
  }
  more.insert(more.end(), block_more_.data(), block_more_.data() + count);
}

/// What each contact of the block keeps of its dampers, which depends on all contacts of its pair.
template <class Block> void PairGranCluster::share_stock(Block& c) {
  for (int m = 0; m < filled_; ++m) {
    c.overlap[m] = std::max(0., stock_contacts_[m].overlap);
    c.kn[m] = stock_contacts_[m].kn;
    c.gamma_n[m] = c.gamma_t[m] = 1;
  }
  for (int m = filled_; m < contact::whole_vectors(filled_); ++m)
    c.kn[m] = c.overlap[m] = c.gamma_n[m] = c.gamma_t[m] = 0;
  shares_.apply(
      c, filled_, block_pair_.data(), pairs_in_block_,
      [this](int k) {
        return contact::ContactGroup{in_block_[k].first, in_block_[k].last};
      },
      pairs_);
  for (int m = 0; m < filled_; ++m)
    stock_contacts_[m].share = c.gamma_n[m];
}

template void PairGranCluster::compute_stock(contact::ContactBlock& block);
template void PairGranCluster::compute_stock(contact::LargeContactBlock& block);

} // namespace eccentra::styles
