// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Torques of eq (32) of many contacts at once, because a single contact is a long chain of dependent operations.
#pragma once

#include "contact/support_table.h"

#include <array>

namespace eccentra::contact {

/// Sides of contacts (a contact has one per particle) whose torques are pending. World frame, SI.
class EccentricBatch {
 public:
  static constexpr int kCapacity = 64; ///< a multiple of the lanes; all of it stays in the first-level cache

  /// True if evaluate() must come before the next add().
  bool full() const { return size_ == kCapacity; }
  /// A side: particle index, orientation (w x y z, body to world), radius, direction of the force on the particle,
  /// spin, depth in units of the radius, normal force and normal damping [N s/m].
  template <class Vector>
  void add(int particle, const double* orientation, double radius, const Vector& outward, const Vector& spin,
           double depth, double push, double damping) {
    const int m = size_++;
    particle_[m] = particle;
    for (int k = 0; k < 4; ++k)
      orientation_[k][m] = orientation[k];
    for (int k = 0; k < 3; ++k) {
      outward_[k][m] = outward[k];
      spin_[k][m] = spin[k];
    }
    radius_[m] = radius;
    depth_[m] = depth;
    push_[m] = push;
    drag_[m] = damping * radius;
  }

  /// Calls apply(particle, torque [N m] as double[3]) for each side in the order of their addition, and removes them.
  template <class Apply> void evaluate(const SupportTable& shape, Apply&& apply) {
    fill_torques(shape);
    for (int m = 0; m < size_; ++m) {
      const double torque[3] = {torque_[0][m], torque_[1][m], torque_[2][m]};
      apply(particle_[m], torque);
    }
    size_ = 0;
  }

 private:
  using Row = std::array<double, kCapacity>;
  void fill_torques(const SupportTable& shape);
  void fill_by_cell(const SupportTable& shape);

  int size_ = 0;
  std::array<int, kCapacity> particle_{};
  alignas(64) std::array<Row, 4> orientation_{};
  std::array<Row, 3> outward_{};
  std::array<Row, 3> spin_{};
  Row radius_{};
  Row depth_{};
  Row push_{};
  Row drag_{};
  std::array<Row, 3> torque_{};
};

} // namespace eccentra::contact
