// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Drag on every particle, implicit in its own slip: eq (20)-(23) with any drag law and any rheology.
#pragma once

#include "closures/drag_laws.h"
#include "closures/effect.h"
#include "closures/implicit_step.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace eccentra::closures {

/// Fluid fraction below which a drag law is evaluated at this value: beyond random close packing no law was measured.
/// Only the law's argument is limited; no volume is lost.
constexpr double kDragFractionFloor = 0.3;

/// Drag of every particle as an implicit step against its slip: `Stress` is the stress scale X, `Law` the coefficient
/// G(Re).
template <class Stress, class Law> class DragEffect : public Effect {
 public:
  /// `name` is that of the law in scripts.
  DragEffect(const char* name, const Rheology& fluid)
      : name_("drag " + std::string(name)), fluid_(fluid), stress_(fluid) {}

  const char* name() const override { return name_.c_str(); }
  const char* slot() const override { return "drag"; }
  unsigned needs() const override { return link::kVelocity | link::kFraction; }
  void prepare(const ShapeCatalogue& shapes) override {
    shapes_ = &shapes;
    laws_.clear();
    for (int kind = 0; kind < shapes.kinds(); ++kind)
      laws_.push_back(make_law<Law>(shapes.factors(kind), fluid_));
  }

  std::vector<Validity> validity() const override { return {{kReynolds, Law::kLowestRe, Law::kHighestRe}}; }
  void apply(const HalfStep& half_step) override {
    double sum[3] = {0.0, 0.0, 0.0};
    // Copies: a force that is written could be one of the members, as far as the compiler knows.
    const Stress stress = stress_;
    const double density = fluid_.density;
    const Law* laws = laws_.data();
    for (int i = 0; i < half_step.count; ++i) {
      if (!(half_step.mask[i] & half_step.group))
        continue;
      const double d = 2.0 * half_step.radius[i];
      const double compliance = half_step.compliance(i);
      double slip[3], free[3], f[3];
      double slip2 = 0.0, free2 = 0.0;
      for (int k = 0; k < 3; ++k) {
        slip[k] = half_step.samples.velocity()[i][k] - half_step.velocity[i][k];
        free[k] = slip[k] - compliance * half_step.force[i][k];
        slip2 += slip[k] * slip[k];
        free2 += free[k] * free[k];
      }
      if (!(free2 > 0.0))
        continue;
      const double free_speed = std::sqrt(free2);
      DragPlace place;
      place.fraction = std::clamp(half_step.samples.fraction()[i], kDragFractionFloor, 1.0);
      if constexpr (Law::kOriented)
        place.crosswise = shapes_->crosswise_sphericity(i, free);
      const auto law = laws[half_step.kind[i]].in(place);
      const auto drag = drag_resistance<Law>(stress, law, d, density, place.fraction);
      const ImplicitSlip step = implicit_slip(drag, free_speed, compliance, std::sqrt(slip2));
      // What is exchanged is the force that was really given, so the fluid receives exactly what the particle lost. Its
      // linearisation is the answer of the stepped particle to the fluid's velocity: at most m/interval, also at rest.
      const double coefficient = step.resistance / free_speed;
      for (int k = 0; k < 3; ++k) {
        f[k] = coefficient * free[k];
        sum[k] += f[k];
      }
      half_step.exchange(i, f, coefficient);
      if (half_step.mask[i] & half_step.frozen)
        continue;
      for (int k = 0; k < 3; ++k)
        half_step.force[i][k] = step.speed == 0.0 ? slip[k] / compliance : half_step.force[i][k] + f[k];
    }
    std::copy(sum, sum + 3, total_);
  }

 private:
  std::string name_;
  Rheology fluid_;
  Stress stress_;
  std::vector<Law> laws_;
  const ShapeCatalogue* shapes_ = nullptr;
};

} // namespace eccentra::closures
