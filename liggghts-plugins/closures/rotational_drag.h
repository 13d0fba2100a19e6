// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The loop around the torque of the fluid on spinning particles, implicit in their own spin.
#pragma once

#include "base/vectors.h"
#include "closures/effect.h"
#include "closures/implicit_step.h"
#include "closures/rotation_laws.h"

#include <algorithm>
#include <vector>

namespace eccentra::closures {

/// Torque against the spin relative to the fluid, of Dennis et al. (1980): implicit in the spin.
template <class Stress> class RotationalDrag : public Effect {
 public:
  /// Reads density and stress scale of `fluid`.
  explicit RotationalDrag(const Rheology& fluid)
      : stress_(fluid), density_(fluid.density), newtonian_(fluid.newtonian()) {}

  const char* name() const override { return "drag_torque"; }
  unsigned needs() const override { return newtonian_ ? link::kVorticity : link::kVorticity | link::kVelocity; }
  void prepare(const ShapeCatalogue& shapes) override {
    gyration_.clear();
    for (int kind = 0; kind < shapes.kinds(); ++kind)
      gyration_.push_back(shapes.inertia_factor(kind));
  }

  bool is_torque() const override { return true; }
  std::vector<Validity> validity() const override { return {{kSpinReynolds, 0.0, Dennis::kHighestRe}}; }
  void apply(const HalfStep& half_step) override {
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < half_step.count; ++i) {
      if (!(half_step.mask[i] & half_step.group))
        continue;
      const double d = 2.0 * half_step.radius[i];
      const double compliance =
          half_step.compliance(i) / (gyration_[half_step.kind[i]] * half_step.radius[i] * half_step.radius[i]);
      double slip_rate = 0.0;
      if (!newtonian_) {
        double slip[3];
        for (int k = 0; k < 3; ++k)
          slip[k] = half_step.samples.velocity()[i][k] - half_step.velocity[i][k];
        slip_rate = base::norm(slip) / d;
      }
      double spin[3], free[3];
      for (int k = 0; k < 3; ++k) {
        spin[k] = 0.5 * half_step.samples.vorticity()[i][k] - half_step.spin[i][k];
        free[k] = spin[k] - compliance * half_step.torque[i][k];
      }
      const double free_spin = base::norm(free);
      if (!(free_spin > 0.0))
        continue;
      const Resistance<SpinStress<Stress>, Dennis> drag{
          {stress_, slip_rate}, Dennis(), Dennis::kAreaPart * d * d * d, 1.0, density_ * d * d};
      const ImplicitSlip step = implicit_slip(drag, free_spin, compliance, base::norm(spin));
      const double coefficient = step.resistance / free_spin;
      const bool held = half_step.mask[i] & half_step.frozen;
      for (int k = 0; k < 3; ++k) {
        const double t = coefficient * free[k];
        sum[k] += t;
        if (!held)
          half_step.torque[i][k] = step.speed == 0.0 ? spin[k] / compliance : half_step.torque[i][k] + t;
      }
    }
    std::copy(sum, sum + 3, total_);
  }

 private:
  Stress stress_;
  double density_;
  bool newtonian_;
  std::vector<double> gyration_; ///< smallest moment of inertia over m R_eq^2, by kind
};

} // namespace eccentra::closures
