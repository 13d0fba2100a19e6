// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reynolds numbers in the wide gap of an eccentric annulus and of particles, against values computed apart.
#include "rheology/particle_reynolds.h"
#include "rheology/slot_flow.h"

#include "closures/rheology.h"

#include <gtest/gtest.h>

namespace eccentra::rheology {
namespace {

constexpr double kPipe = 0.02413, kHole = 0.0635;
constexpr HerschelBulkley kMud{1e-3, 0.28e-3, 0.65, 1};

TEST(WideGap, NumbersOfThePapersScene) {
  // Slots side by side in another program: velocity 0.58, 0.72, 1.165 m/s, yield stress 1 Pa.
  const double velocity[] = {0.58, 0.72, 1.165};
  const double expected[][3] = {{1791.8, 2429.1, 4761.4}, {1983.4, 2695.1, 5305.7}};
  const double eccentricity[] = {0.5, 0.8};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 3; ++j) {
      const AnnulusGap annulus{kPipe, kHole, eccentricity[i] * (kHole - kPipe)};
      const double wide = wide_gap_velocity(kMud, annulus, velocity[j]);
      EXPECT_NEAR(metzner_reed(kMud, 2 * annulus.widest(), wide), expected[i][j], 0.5);
    }
}

TEST(WideGap, NewtonianSlotsObeyTheCubeOfTheGap) {
  // u = G h^2/(12 nu), and the mean over the circumference of h^3 is c^3 (1 + 3/2 e^2).
  constexpr HerschelBulkley water{0, 1e-6, 1, 1};
  const AnnulusGap annulus{kPipe, kHole, 0.7 * (kHole - kPipe)};
  EXPECT_NEAR(wide_gap_velocity(water, annulus, 1), 1.7 * 1.7 / (1 + 1.5 * 0.49), 1e-9);
  EXPECT_NEAR(wide_gap_velocity(water, {kPipe, kHole, 0}, 1), 1, 1e-9);
}

TEST(WideGap, MudAtRestInTheNarrowGapPassesThroughTheRest) {
  // tau0 = 2 Pa at e = 0.8 and a low rate: the narrow slots do not yield, and the volume rate is still the given one.
  constexpr HerschelBulkley thick{2e-3, 0.28e-3, 0.65, 1};
  const AnnulusGap annulus{kPipe, kHole, 0.8 * (kHole - kPipe)};
  const double gradient = slots_gradient(thick, annulus, 0.05);
  EXPECT_LT(0.5 * gradient * annulus.at(std::acos(-1.0)), thick.tau0);
  EXPECT_NEAR(slots_velocity(thick, annulus, gradient), 0.05, 1e-9);
  EXPECT_EQ(wide_gap_velocity(thick, annulus, 0), 0);
}

TEST(Limits, OfDodgeAndMetzner) {
  EXPECT_DOUBLE_EQ(laminar_limit(1), 2100);
  EXPECT_DOUBLE_EQ(turbulent_limit(1), 2900);
  EXPECT_NEAR(laminar_limit(0.65), 2579.5, 1e-9);
  EXPECT_NEAR(turbulent_limit(0.65), 3379.5, 1e-9);
}

TEST(ParticleReynolds, IsThatOfTheClosures) {
  for (const double tau0 : {0.0, 1.0})
    for (const double n : {0.65, 1.0})
      for (const double slip : {1e-3, 0.1, 1.0}) {
        closures::Rheology fluid;
        fluid.yield_stress = tau0;
        fluid.consistency = 0.28;
        fluid.index = n;
        fluid.density = 1050;
        const HerschelBulkley kinematic{tau0 / 1050, 0.28 / 1050, n, 1};
        const double expected = closures::reynolds_herschel_bulkley(fluid, slip, 6.35e-3);
        EXPECT_NEAR(particle_reynolds(kinematic, slip, 6.35e-3), expected, 1e-12 * expected);
      }
  EXPECT_EQ(particle_reynolds(kMud, 0, 1e-3), 0);
}

} // namespace
} // namespace eccentra::rheology
