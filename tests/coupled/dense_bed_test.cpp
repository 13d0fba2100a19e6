// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A dense bed on a held layer that is pushed once comes to rest, in water as in thick mud: what particles and fluid do
// to each other from coupling step to coupling step must not grow.
#include "coupled/coupled_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace {

using namespace eccentra::test;

constexpr double kDiameter = 6.35e-3;
constexpr double kPush = 0.01; ///< [m/s]
constexpr int kLayers = 8, kWide = 4;

/// Square layers, each in the pits of the one below (solid fraction 0.74); the lowest one is held.
Outcome pushed_bed(double viscosity, double step, int coupling_steps, const std::string& name) {
  constexpr double kDemStep = 5e-5;
  BoxCase box;
  box.size[0] = box.size[1] = kWide * kDiameter;
  box.size[2] = 6 * kDiameter;
  box.cells[0] = box.cells[1] = kWide;
  box.cells[2] = 6;
  box.periodic[2] = false;
  box.step = step;
  box.viscosity = viscosity;
  std::ostringstream script;
  script << script_head(box, kDemStep, "fix weight all gravity 9.81 vector 0 0 -1\n");
  for (int layer = 0; layer < kLayers; ++layer)
    for (int i = 0; i < kWide * kWide; ++i) {
      const double shift = layer % 2 ? 0.5 : 0.0;
      const int row = i / kWide;
      script << "create_atoms 1 single " << std::fmod(i % kWide + 0.5 + shift, kWide) * kDiameter << ' '
             << std::fmod(row + 0.5 + shift, kWide) * kDiameter << ' ' << (layer * std::sqrt(0.5) + 0.5) * kDiameter
             << " units box\n";
    }
  const int every = static_cast<int>(std::lround(step / kDemStep));
  script << "set group all diameter 6.35e-3 density 2619\n"
         << "region low block INF INF INF INF INF " << 0.6 * kDiameter << " units box\ngroup held region low\n"
         << "fix hold held freeze\ngroup free subtract all held\nvelocity free set NULL NULL " << kPush << '\n'
         << "fix mud all fluid/force rheology herschel_bulkley 0 " << viscosity
         << " 1 density 1000 drag chien pressure_gradient on\nfix flow all fluid/couple link solver every " << every
         << "\nrun " << every * coupling_steps << '\n';
  box.script = script.str();
  return run(box, name);
}

void expect_rest(double viscosity, double step, int coupling_steps, double speed) {
  std::ostringstream name;
  name << "dense_bed_" << viscosity << '_' << step;
  const Outcome outcome = pushed_bed(viscosity, step, coupling_steps, name.str());
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_LT(outcome.last("fastest_particle"), speed) << name.str();
  EXPECT_LT(outcome.last("fastest_fluid"), kPush) << name.str();
  EXPECT_LT(outcome.last("least_fraction"), 0.3) << "not dense";
}

} // namespace

// Added mass: what accelerates the particles accelerates the fluid between them, one coupling step late.
TEST(DenseBed, ComesToRestInWater) {
  expect_rest(1e-3, 2e-3, 100, 1e-6);
  expect_rest(1e-3, 1e-2, 30, 1e-4);
}

// Drag ties fluid and particles to each other within a coupling step, on the springs of the contacts.
TEST(DenseBed, ComesToRestInThickFluids) {
  expect_rest(0.1, 2e-3, 100, 1e-5);
  expect_rest(1, 2e-3, 200, 1e-5);
  expect_rest(10, 2e-3, 150, 2e-4);
}
