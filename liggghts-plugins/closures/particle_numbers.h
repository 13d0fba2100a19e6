// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The dimensionless numbers of a particle in a flow, by which closures state where they hold.
#pragma once

#include "base/vectors.h"
#include "closures/effect.h"
#include "closures/rheology.h"

#include <array>
#include <cmath>

namespace eccentra::closures {

/// All numbers of local atom i; what needs a quantity that is not sampled, or a slip where there is none, is 0.
inline std::array<double, kNumbers> particle_numbers(const HalfStep& half_step, int i, const Rheology& fluid) {
  std::array<double, kNumbers> n{};
  const double d = 2.0 * half_step.radius[i];
  n[kDensityRatio] = half_step.mass[i] / sphere_volume(half_step.radius[i]) / fluid.density;
  double slip[3] = {0.0, 0.0, 0.0}, spin[3] = {0.0, 0.0, 0.0};
  if (half_step.samples.velocity())
    for (int k = 0; k < 3; ++k)
      slip[k] = half_step.samples.velocity()[i][k] - half_step.velocity[i][k];
  const double speed = base::norm(slip);
  if (speed > 0.0) {
    n[kReynolds] = reynolds_herschel_bulkley(fluid, speed, d);
    n[kBingham] = bingham(fluid, speed, d);
    n[kStokesNumber] = n[kDensityRatio] * n[kReynolds] / 9.0;
  }
  if (half_step.samples.vorticity() && (speed > 0.0 || fluid.newtonian())) {
    for (int k = 0; k < 3; ++k)
      spin[k] = 0.5 * half_step.samples.vorticity()[i][k] - half_step.spin[i][k];
    const double viscosity = fluid.newtonian() ? fluid.consistency : particle_viscosity(fluid, speed, d);
    const double per_rate = fluid.density * d * d / viscosity;
    n[kShearReynolds] = per_rate * base::norm(half_step.samples.vorticity()[i]);
    n[kSpinReynolds] = per_rate * base::norm(spin);
    if (n[kReynolds] > 0.0) {
      n[kShearParameter] = 0.5 * n[kShearReynolds] / n[kReynolds];
      n[kSpinParameter] = 0.5 * d * base::norm(spin) / speed;
    }
  }
  return n;
}

} // namespace eccentra::closures
