// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The loops around the two lifts.
#pragma once

#include "closures/effect.h"
#include "closures/lift_laws.h"

#include <algorithm>

namespace eccentra::closures {

/// Calls force(i, viscosity, d, slip, out) for every particle that slips, and adds what comes out.
class Lift : public Effect {
 public:
  /// Density and viscosity are those of `fluid`.
  explicit Lift(const Rheology& fluid) : fluid_(fluid) {}
  unsigned needs() const override { return link::kVelocity | link::kVorticity; }

 protected:
  /// `d` [m] is the diameter of the sphere of equal volume, `slip` [m/s] that of the fluid relative to the particle.
  template <class Force> void for_each(const HalfStep& half_step, Force&& force) {
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < half_step.count; ++i) {
      if (!(half_step.mask[i] & half_step.group))
        continue;
      double slip[3], f[3];
      for (int k = 0; k < 3; ++k)
        slip[k] = half_step.samples.velocity()[i][k] - half_step.velocity[i][k];
      const double speed = base::norm(slip);
      if (!(speed > 0.0))
        continue;
      const double d = 2.0 * half_step.radius[i];
      // The viscosity behind Re_HB, so that all Reynolds numbers of a particle speak of one fluid.
      const double viscosity = fluid_.newtonian() ? fluid_.consistency : particle_viscosity(fluid_, speed, d);
      force(i, viscosity, d, slip, f);
      half_step.exchange(i, f, 0.0);
      const double held = half_step.mask[i] & half_step.frozen ? 0.0 : 1.0;
      for (int k = 0; k < 3; ++k) {
        half_step.force[i][k] += held * f[k];
        sum[k] += f[k];
      }
    }
    std::copy(sum, sum + 3, total_);
  }
  Rheology fluid_; ///< as given
};

/// Lift of a shear flow: Saffman (1965) with Mei's (1992) factor.
class ShearLift : public Lift {
 public:
  using Lift::Lift;
  const char* name() const override { return "shear_lift"; }
  std::vector<Validity> validity() const override {
    return {{kReynolds, 0.0, Mei::kHighestRe}, {kShearParameter, Mei::kLowestBeta, Mei::kHighestBeta}};
  }
  void apply(const HalfStep& half_step) override {
    for_each(half_step, [&](int i, double viscosity, double d, const double* slip, double* f) {
      shear_lift_force(fluid_.density, viscosity, d, slip, half_step.samples.vorticity()[i], f);
    });
  }
};

/// Lift of a spin relative to the fluid: Oesterle & Bui Dinh (1998).
class RotationalLift : public Lift {
 public:
  using Lift::Lift;
  const char* name() const override { return "rotational_lift"; }
  /// A spin that nothing damps would make this lift grow.
  const char* requires_slot() const override { return "drag_torque"; }
  std::vector<Validity> validity() const override {
    return {{kReynolds, OesterleBuiDinh::kLowestRe, OesterleBuiDinh::kHighestRe},
            {kSpinParameter, OesterleBuiDinh::kLowestSpin, OesterleBuiDinh::kHighestSpin}};
  }
  void apply(const HalfStep& half_step) override {
    for_each(half_step, [&](int i, double viscosity, double d, const double* slip, double* f) {
      double spin[3];
      for (int k = 0; k < 3; ++k)
        spin[k] = 0.5 * half_step.samples.vorticity()[i][k] - half_step.spin[i][k];
      rotational_lift_force(fluid_.density, viscosity, d, slip, spin, f);
    });
  }
};

} // namespace eccentra::closures
