// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements the walk from eddy to eddy.
#include "closures/eddy_interaction.h"

#include "base/vectors.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace eccentra::closures {

EddyScales eddy_scales(double energy, double dissipation) {
  if (!(energy > 0.0 && dissipation > 0.0))
    return {0.0, 0.0, 0.0};
  return {std::sqrt(2.0 / 3.0 * energy), kEddyLifetime * energy / dissipation,
          kEddyLength * energy * std::sqrt(energy) / dissipation};
}

namespace {

/// Knuth's, modulo 2^64: cheap to begin, and each eddy takes only a few of its numbers.
using Generator = std::linear_congruential_engine<std::uint64_t, 6364136223846793005u, 1442695040888963407u, 0>;

EddyScales scales_at(const HalfStep& half_step, int i) {
  const double* turbulence = half_step.samples.turbulence()[i];
  return eddy_scales(turbulence[0], turbulence[1]);
}

} // namespace

// A generator for each eddy, begun from the particle and the step: no state that ranks or restarts would have to share.
void EddyInteraction::meet(int tag, std::int64_t step, Eddy& eddy) const {
  std::seed_seq sequence{std::uint32_t(seed_), std::uint32_t(tag), std::uint32_t(step), std::uint32_t(step >> 32)};
  Generator generator(sequence);
  std::normal_distribution<double> normal;
  for (double& component : eddy.direction)
    component = normal(generator);
  eddy.left = std::exponential_distribution<double>()(generator);
}

void EddyInteraction::age(const HalfStep& half_step, double interval, const int* tag, std::int64_t step,
                          Eddy* eddies) const {
  for (int i = 0; i < half_step.count; ++i) {
    if (!(half_step.mask[i] & half_step.group))
      continue;
    const EddyScales scales = scales_at(half_step, i);
    if (scales.speed == 0.0)
      continue;
    Eddy& eddy = eddies[i];
    double slip[3];
    for (int k = 0; k < 3; ++k)
      slip[k] = half_step.samples.velocity()[i][k] + scales.speed * eddy.direction[k] - half_step.velocity[i][k];
    eddy.left -= interval * (1.0 / scales.lifetime + base::norm(slip) / scales.length);
    if (eddy.left <= 0.0)
      meet(tag[i], step, eddy);
  }
}

void EddyInteraction::see(const HalfStep& half_step, const Eddy* eddies, double (*seen)[3]) {
  for (int i = 0; i < half_step.count; ++i) {
    std::copy_n(half_step.samples.velocity()[i], 3, seen[i]);
    if (!(half_step.mask[i] & half_step.group))
      continue;
    const double speed = scales_at(half_step, i).speed;
    for (int k = 0; k < 3; ++k)
      seen[i][k] += speed * eddies[i].direction[k];
  }
}

} // namespace eccentra::closures
