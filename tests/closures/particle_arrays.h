// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Particles in arrays as LIGGGHTS keeps them, without LIGGGHTS: for timing effects and comparing them.
#pragma once

#include "closures/drag_laws.h"
#include "closures/effect.h"

#include <algorithm>
#include <random>
#include <vector>

namespace eccentra::test {

/// Spheres of the reference case near their terminal velocity in a sheared suspension, positions irrelevant.
class ParticleArrays : public closures::ShapeCatalogue {
 public:
  explicit ParticleArrays(int count, unsigned seed = 1)
      : velocity_(3 * count), force_(3 * count), spin_(3 * count), torque_(3 * count), impulse_(3 * count),
        last_(4 * count), mass_(count, kMass), radius_(count, kRadius), coefficient_(count), kind_(count, 1),
        mask_(count, 1), rows_(4 * count) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto fill = [&](std::vector<double>& values, double scale) {
      for (double& value : values)
        value = scale * normal(random);
    };
    fill(velocity_, 0.1);
    fill(spin_, 5.0);
    for (const link::FlowQuantity& quantity : link::kFlowQuantities) {
      std::vector<double>& values = flow_[quantity.bit];
      values.resize(std::size_t(quantity.columns) * count);
      fill(values, scale_of(quantity.bit));
      half_step_.samples[quantity.bit] = values.data();
    }
    for (double& a : flow_[link::kFraction])
      a = std::uniform_real_distribution<double>(0.5, 1.0)(random);
    for (int i = 0; i < count; ++i) {
      rows_[i] = &velocity_[3 * i];
      rows_[count + i] = &force_[3 * i];
      rows_[2 * count + i] = &spin_[3 * i];
      rows_[3 * count + i] = &torque_[3 * i];
    }
    using Rows3 = double(*)[3];
    half_step_.count = count;
    half_step_.interval = 2e-5;
    half_step_.velocity = &rows_[0];
    half_step_.force = &rows_[count];
    half_step_.spin = &rows_[2 * count];
    half_step_.torque = &rows_[3 * count];
    half_step_.mass = mass_.data();
    half_step_.radius = radius_.data();
    half_step_.kind = kind_.data();
    half_step_.mask = mask_.data();
    half_step_.group = half_step_.integrated = 1;
    half_step_.gravity[2] = -9.81;
    half_step_.impulse = reinterpret_cast<Rows3>(impulse_.data());
    half_step_.drag_coefficient = coefficient_.data();
    half_step_.last = reinterpret_cast<double(*)[4]>(last_.data());
  }

  const closures::HalfStep& half_step() const { return half_step_; }
  const std::vector<double>& forces() const { return force_; }
  void clear_forces() {
    std::fill(force_.begin(), force_.end(), 0.0);
    std::fill(torque_.begin(), torque_.end(), 0.0);
    std::fill(last_.begin(), last_.end(), 0.0);
  }

  int kinds() const override { return 2; }
  closures::ShapeFactors factors(int) const override { return {}; }
  double inertia_factor(int) const override { return 0.4; }
  double crosswise_sphericity(int, const double*) const override { return 1.0; }

 private:
  /// Standard deviation of each component: velocities [m/s], force densities [N/m3], rates of shear [1/s].
  static double scale_of(link::Quantity quantity) {
    return quantity == link::kVelocity                                      ? 0.1
           : quantity & (link::kPressureGradient | link::kStressDivergence) ? 300.0
                                                                            : 10.0;
  }

  static constexpr double kRadius = 3.175e-3;
  static constexpr double kMass = 2619.0 * 4.0 / 3.0 * closures::kPi * kRadius * kRadius * kRadius;
  std::vector<double> velocity_, force_, spin_, torque_, impulse_, last_;
  link::PerQuantity<std::vector<double>> flow_;
  std::vector<double> mass_, radius_, coefficient_;
  std::vector<int> kind_, mask_;
  std::vector<double*> rows_;
  closures::HalfStep half_step_;
};

} // namespace eccentra::test
