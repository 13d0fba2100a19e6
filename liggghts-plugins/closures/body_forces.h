// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that are proportional to a particle's volume: buoyancy, pressure gradient (eq 31), divergence of stress.
#pragma once

#include "closures/effect.h"

#include <algorithm>

namespace eccentra::closures {

/// Per-volume force fields; each gives N/m3 at atom i.
struct BuoyancyField {
  static constexpr const char* kName = "buoyancy";
  static constexpr unsigned kNeeds = 0;
  double density; ///< of the fluid [kg/m3]
  /// -rho_f g: the hydrostatic part of -grad p.
  double operator()(const HalfStep& half_step, int, int k) const { return -density * half_step.gravity[k]; }
};

/// The generalised buoyancy of a flow that is solved.
struct PressureField {
  static constexpr const char* kName = "pressure_gradient";
  static constexpr unsigned kNeeds = link::kPressureGradient;
  double density; ///< of the fluid [kg/m3]
  /// -grad p_rgh; the fluid has its opposite in alpha grad p already (model A).
  double operator()(const HalfStep& half_step, int i, int k) const {
    return -half_step.samples.pressure_gradient()[i][k];
  }
};

/// The resolved viscous stress of the flow.
struct StressField {
  static constexpr const char* kName = "viscous_stress";
  static constexpr unsigned kNeeds = link::kStressDivergence;
  double density; ///< of the fluid [kg/m3]
  /// div tau; with it, -grad p_rgh is the whole stress of model A on the particle.
  double operator()(const HalfStep& half_step, int i, int k) const {
    return half_step.samples.stress_divergence()[i][k];
  }
};

/// The force V times a field, explicit.
template <class Field> class BodyForce : public Effect {
 public:
  /// Reads the density alone.
  explicit BodyForce(const Rheology& fluid) : field_{fluid.density} {}

  const char* name() const override { return Field::kName; }
  unsigned needs() const override { return Field::kNeeds; }
  void apply(const HalfStep& half_step) override {
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < half_step.count; ++i) {
      if (!(half_step.mask[i] & half_step.group))
        continue;
      const double volume = sphere_volume(half_step.radius[i]);
      const double held = half_step.mask[i] & half_step.frozen ? 0.0 : 1.0;
      for (int k = 0; k < 3; ++k) {
        const double f = volume * field_(half_step, i, k);
        half_step.force[i][k] += held * f;
        sum[k] += f;
      }
    }
    std::copy(sum, sum + 3, total_);
  }

 private:
  Field field_;
};

} // namespace eccentra::closures
