// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements the hand-written drag loop.
#include "hand_written_drag.h"

#include <cmath>

namespace eccentra::test {

double hand_written_drag(const closures::HalfStep& half_step, const closures::Rheology& fluid) {
  const double plateau = 67.289 * std::exp(-5.03);
  const double yield = 7.0 * closures::kPi / 24.0 * fluid.yield_stress;
  double sum[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < half_step.count; ++i) {
    if (!(half_step.mask[i] & half_step.group))
      continue;
    const double h = (half_step.mask[i] & half_step.integrated) && !(half_step.mask[i] & half_step.frozen)
                         ? half_step.interval / half_step.mass[i]
                         : 0.0;
    const double* v = half_step.velocity[i];
    double* f = half_step.force[i];
    const double* u = half_step.samples.velocity()[i];
    const double sx = u[0] - v[0], sy = u[1] - v[1], sz = u[2] - v[2];
    const double fx = sx - h * f[0], fy = sy - h * f[1], fz = sz - h * f[2];
    const double free2 = fx * fx + fy * fy + fz * fz;
    if (free2 == 0.0)
      continue;
    const double free = std::sqrt(free2);
    const double d = 2.0 * half_step.radius[i];
    double fraction = half_step.samples.fraction()[i];
    fraction = fraction < 0.3 ? 0.3 : fraction > 1.0 ? 1.0 : fraction;
    const double inverse_d = 1.0 / d;
    const double area = closures::kPi / 8.0 * d * d * (fraction < 1.0 ? std::pow(fraction, -1.65) : 1.0);
    double q = 0.0, drag = h > 0.0 ? free / h : 0.0;
    if (h == 0.0 || h * area * 30.0 * yield < free) {
      q = std::sqrt(sx * sx + sy * sy + sz * sz);
      if (!(q > 0.0 && q < free))
        q = free;
      double low = 0.0, high = free;
      for (int n = 0; n < 100; ++n) {
        const double viscous = fluid.consistency * std::pow(q * inverse_d, fluid.index);
        drag = area * (30.0 * (viscous + yield) + plateau * fluid.density * q * q);
        const double slope = area * (30.0 * fluid.index * viscous / q + 2.0 * plateau * fluid.density * q);
        const double excess = q + h * drag - free;
        (excess > 0.0 ? high : low) = q;
        const double change = -excess / (1.0 + h * slope);
        if (std::abs(change) <= 1e-3 * q) {
          drag += slope * change;
          q += change;
          break;
        }
        q += change;
        if (!(q > low && q < high))
          q = low > 0.0 ? std::sqrt(low * high) : 0.1 * high;
      }
    }
    const double beta = drag / free;
    const double dx = beta * fx, dy = beta * fy, dz = beta * fz;
    half_step.impulse[i][0] += dx * half_step.interval;
    half_step.impulse[i][1] += dy * half_step.interval;
    half_step.impulse[i][2] += dz * half_step.interval;
    half_step.drag_coefficient[i] += beta * half_step.interval;
    half_step.last[i][0] += dx;
    half_step.last[i][1] += dy;
    half_step.last[i][2] += dz;
    half_step.last[i][3] += beta;
    sum[0] += dx;
    sum[1] += dy;
    sum[2] += dz;
    if (half_step.mask[i] & half_step.frozen)
      continue;
    if (q == 0.0) {
      f[0] = sx / h;
      f[1] = sy / h;
      f[2] = sz / h;
    } else {
      f[0] += dx;
      f[1] += dy;
      f[2] += dz;
    }
  }
  return sum[2];
}

} // namespace eccentra::test
