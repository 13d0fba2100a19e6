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
  double density;
  /// -rho_f g: the hydrostatic part of -grad p.
  double operator()(const HalfStep& kick, int, int k) const { return -density * kick.gravity[k]; }
};

struct PressureField {
  static constexpr const char* kName = "pressure_gradient";
  static constexpr unsigned kNeeds = link::kPressureGradient;
  double density;
  /// -grad p_rgh; the fluid has its opposite in alpha grad p already (model A).
  double operator()(const HalfStep& kick, int i, int k) const { return -kick.samples.pressure_gradient[i][k]; }
};

struct StressField {
  static constexpr const char* kName = "viscous_stress";
  static constexpr unsigned kNeeds = link::kStressDivergence;
  double density;
  /// div tau; with it, -grad p_rgh is the whole stress of model A on the particle.
  double operator()(const HalfStep& kick, int i, int k) const { return kick.samples.stress_divergence[i][k]; }
};

template <class Field> class BodyForce : public Effect {
 public:
  explicit BodyForce(const Rheology& fluid) : field_{fluid.density} {}

  const char* name() const override { return Field::kName; }
  unsigned needs() const override { return Field::kNeeds; }
  void apply(const HalfStep& kick) override {
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < kick.count; ++i) {
      if (!(kick.mask[i] & kick.group))
        continue;
      const double volume = sphere_volume(kick.radius[i]);
      const double held = kick.mask[i] & kick.frozen ? 0.0 : 1.0;
      for (int k = 0; k < 3; ++k) {
        const double f = volume * field_(kick, i, k);
        kick.force[i][k] += held * f;
        sum[k] += f;
      }
    }
    std::copy(sum, sum + 3, total_);
  }

 private:
  Field field_;
};

} // namespace eccentra::closures
