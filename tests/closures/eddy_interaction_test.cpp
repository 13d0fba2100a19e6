// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The walk from eddy to eddy against closed forms of homogeneous turbulence.
#include "closures/eddy_interaction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace {

using namespace eccentra::closures;

constexpr double kEnergy = 0.06, kDissipation = 0.3; // [m2/s2], [m2/s3]
constexpr int kParticles = 20000;
/// Four standard errors of a variance estimated from the particles' three components, and from one.
const double kOfThree = 4 * std::sqrt(2.0 / (3.0 * kParticles)), kOfOne = 4 * std::sqrt(2.0 / kParticles);

/// Particles in a fluid at rest in the mean, whose velocities the test prescribes.
class Cloud {
 public:
  Cloud()
      : velocity(kParticles), rows_(kParticles), sampled_(kParticles), turbulence_(kParticles), mask_(kParticles, 1) {
    tags.resize(kParticles);
    std::iota(tags.begin(), tags.end(), 1);
    eddies.resize(kParticles, Eddy{});
    seen.resize(kParticles);
    for (int i = 0; i < kParticles; ++i) {
      rows_[i] = velocity[i].data();
      turbulence_[i] = {kEnergy, kDissipation};
    }
    step.count = kParticles;
    step.velocity = rows_.data();
    step.mask = mask_.data();
    step.group = 1;
    step.samples[eccentra::link::kVelocity] = sampled_.front().data();
    step.samples[eccentra::link::kTurbulence] = turbulence_.front().data();
  }
  void pass(const EddyInteraction& walk, double interval, int number) {
    walk.age(step, interval, tags.data(), number, eddies.data());
    EddyInteraction::see(step, eddies.data(), reinterpret_cast<double(*)[3]>(seen.front().data()));
  }

  std::vector<std::array<double, 3>> velocity, seen;
  std::vector<Eddy> eddies;
  std::vector<int> tags;
  HalfStep step;

 private:
  std::vector<double*> rows_;
  std::vector<std::array<double, 3>> sampled_;
  std::vector<std::array<double, 2>> turbulence_;
  std::vector<int> mask_;
};

TEST(EddyScales, SpreadATracerAsAScalarInTheModel) {
  const EddyScales scales = eddy_scales(kEnergy, kDissipation);
  EXPECT_NEAR(scales.speed, 0.2, 1e-15);
  EXPECT_NEAR(scales.speed * scales.speed * scales.lifetime, 0.09 * kEnergy * kEnergy / kDissipation / 0.9, 1e-15);
  EXPECT_NEAR(scales.length, std::pow(0.09, 0.75) * std::pow(kEnergy, 1.5) / kDissipation, 1e-4 * scales.length);
  EXPECT_EQ(eddy_scales(0, kDissipation).speed, 0);
  EXPECT_EQ(eddy_scales(kEnergy, 0).speed, 0);
}

// Taylor (1921) for an exponential correlation: <x^2> = 2 u'^2 T^2 (t/T - 1 + exp(-t/T)). The sum over steps of a
// correlation exp(-m dt/T) has a closed form, too, so that the step itself leaves no error.
TEST(EddyInteraction, TracersSpreadAsTaylorSays) {
  const EddyScales scales = eddy_scales(kEnergy, kDissipation);
  for (const double part : {0.02, 0.5}) { // step over lifetime
    Cloud cloud;
    const EddyInteraction walk(7);
    const double dt = part * scales.lifetime, keep = std::exp(-part);
    std::vector<std::array<double, 3>> place(kParticles);
    cloud.pass(walk, 0, 0);
    const int steps = std::lround(6 / part);
    for (int n = 1; n <= steps; ++n) {
      for (int i = 0; i < kParticles; ++i) {
        cloud.velocity[i] = cloud.seen[i]; // no slip
        for (int k = 0; k < 3; ++k)
          place[i][k] += dt * cloud.seen[i][k];
      }
      cloud.pass(walk, dt, n);
      if (n != steps && n != steps / 6 && n != steps / 2)
        continue;
      double sum = 0;
      for (const auto& x : place)
        for (const double component : x)
          sum += component * component;
      // sum over i, j of keep^|i - j|
      const double pairs = n * (1 + keep) / (1 - keep) - 2 * keep * (1 - std::pow(keep, n)) / std::pow(1 - keep, 2);
      const double expected = std::pow(scales.speed * dt, 2) * pairs;
      EXPECT_NEAR(sum / (3.0 * kParticles), expected, kOfThree * expected) << part << " after " << n;
      if (part < 0.1) {
        const double t = n * part;
        const double taylor = 2 * std::pow(scales.speed * scales.lifetime, 2) * (t - 1 + std::exp(-t));
        EXPECT_NEAR(expected, taylor, 1e-3 * taylor);
      }
    }
  }
}

// A particle that falls fast leaves its eddies: the fluctuation that it sees has the integral time
// 1/(1/T + w/L), whatever its own inertia. The walk's slip contains the fluctuation: (u'/w)^2 = 1/400 of the rate.
TEST(EddyInteraction, FallingParticlesCrossTheEddies) {
  const EddyScales scales = eddy_scales(kEnergy, kDissipation);
  const double fall = 20 * scales.speed, rate = 1 / scales.lifetime + fall / scales.length;
  Cloud cloud;
  for (auto& v : cloud.velocity)
    v = {0, 0, -fall};
  const EddyInteraction walk(3);
  const double dt = 0.05 / rate, keep = std::exp(-0.05);
  const int steps = 400;
  std::vector<double> way(kParticles);
  cloud.pass(walk, 0, 0);
  for (int n = 1; n <= steps; ++n) {
    for (int i = 0; i < kParticles; ++i)
      way[i] += dt * cloud.seen[i][0];
    cloud.pass(walk, dt, n);
  }
  double sum = 0;
  for (const double x : way)
    sum += x * x;
  const double pairs = steps * (1 + keep) / (1 - keep) - 2 * keep * (1 - std::pow(keep, steps)) / std::pow(1 - keep, 2);
  const double expected = std::pow(scales.speed * dt, 2) * pairs;
  EXPECT_NEAR(sum / kParticles, expected, (kOfOne + 1.0 / 400) * expected);
}

TEST(EddyInteraction, FluctuationsAreNormalAndIsotropic) {
  Cloud cloud;
  cloud.pass(EddyInteraction(1), 0, 5);
  double mean[3] = {}, product[3][3] = {}, fourth = 0;
  for (const Eddy& eddy : cloud.eddies)
    for (int r = 0; r < 3; ++r) {
      mean[r] += eddy.direction[r] / kParticles;
      fourth += std::pow(eddy.direction[r], 4) / (3.0 * kParticles);
      for (int c = 0; c < 3; ++c)
        product[r][c] += eddy.direction[r] * eddy.direction[c] / kParticles;
    }
  for (int r = 0; r < 3; ++r) {
    EXPECT_NEAR(mean[r], 0, 4 / std::sqrt(kParticles));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(product[r][c], r == c, r == c ? kOfOne : 4 / std::sqrt(kParticles));
  }
  EXPECT_NEAR(fourth, 3, 4 * std::sqrt(96.0 / (3.0 * kParticles)));
}

TEST(EddyInteraction, DependsOnSeedParticleAndStepAlone) {
  Cloud one, same, other;
  one.pass(EddyInteraction(1), 0, 5);
  std::reverse(same.tags.begin(), same.tags.end()); // the particles in another order, as after a sort
  same.pass(EddyInteraction(1), 0, 5);
  other.pass(EddyInteraction(2), 0, 5);
  for (int i = 0; i < kParticles; ++i) {
    EXPECT_EQ(one.seen[i], same.seen[kParticles - 1 - i]);
    EXPECT_NE(one.seen[i], other.seen[i]);
  }
  const std::vector<std::array<double, 3>> before = one.seen;
  one.pass(EddyInteraction(1), 0, 6);
  EXPECT_EQ(one.seen, before) << "an eddy that does not age stays";
}

TEST(EddyInteraction, StillFluidIsSeenAsItIs) {
  Cloud cloud;
  std::vector<double> still(2 * kParticles, 0.0);
  cloud.step.samples[eccentra::link::kTurbulence] = still.data();
  cloud.pass(EddyInteraction(1), 1.0, 1);
  for (const auto& u : cloud.seen)
    for (const double component : u)
      EXPECT_EQ(component, 0.0);
}

} // namespace
