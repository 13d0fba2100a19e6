// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coupled runs in boxes against closed forms: momentum of a closed box, a bed at rest, the fall of a single sphere, the
// same result on one and on two ranks.
#include "coupled/coupled_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace {

using namespace eccentra::test;

constexpr double kDiameter = 6.35e-3;

std::string sphere(double x, double y, double z) {
  std::ostringstream text;
  text << "create_atoms 1 single " << x << ' ' << y << ' ' << z << " units box\n";
  return text.str();
}

const char* const kSize = "set group all diameter 6.35e-3 density 2619\n";

/// 27 spheres of all speeds in a box that repeats in all directions: nothing outside acts on it.
BoxCase closed_box(const char* momentum) {
  BoxCase box;
  // Euler: the momentum of one time level changes by what is received; backward spreads the same over two levels.
  box.time_scheme = "Euler";
  box.correctors = 30;
  box.tolerance = 1e-14;
  box.coupling = std::string("tolerance 1e-14; momentum ") + momentum + ";";
  std::ostringstream script;
  script << script_head(box, 5e-5);
  for (int i = 0; i < 27; ++i)
    script << sphere(0.005 + 0.02 * (i % 3), 0.006 + 0.02 * (i / 3 % 3), 0.007 + 0.02 * (i / 9));
  script << kSize;
  for (int i = 0; i < 27; ++i)
    script << "set atom " << i + 1 << " vx " << 0.3 + 0.2 * std::sin(i) << " vy " << 0.1 * std::cos(2 * i) << " vz "
           << -0.2 + 0.1 * std::sin(3 * i) << "\n";
  script << "fix mud all fluid/force rheology herschel_bulkley 0 0.01 1 density 1000 drag chien pressure_gradient on\n"
            "fix flow all fluid/couple link solver every 40\nrun 1600\n";
  box.script = script.str();
  return box;
}

void expect_constant_momentum(const Outcome& outcome) {
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  ASSERT_GT(outcome.rows.size(), 30u);
  const auto& start = outcome.rows[2];
  const double scale = std::hypot(start.at("momentum_x"), start.at("momentum_y"), start.at("momentum_z"));
  for (std::size_t i = 3; i < outcome.rows.size(); ++i)
    for (const char* column : {"momentum_x", "momentum_y", "momentum_z"})
      EXPECT_NEAR(outcome.rows[i].at(column), start.at(column), 1e-10 * scale) << column << " at coupling step " << i;
  // And much of it has moved from the particles to the fluid.
  EXPECT_LT(outcome.last("fastest_particle"), 0.8 * outcome.rows.front().at("fastest_particle"));
}

} // namespace

TEST(CoupledBox, SemiImplicitDragKeepsTheMomentumOfAClosedBox) {
  expect_constant_momentum(run(closed_box("semiImplicit"), "momentum_implicit"));
}

TEST(CoupledBox, ExplicitDragKeepsTheMomentumOfAClosedBox) {
  expect_constant_momentum(run(closed_box("explicit"), "momentum_explicit"));
}

// The steps of the fluid become parts of the interval between two coupling steps, more and fewer of them as the flow
// changes.
TEST(CoupledBox, StepsBoundedByTheCourantNumberKeepTheMomentumAndTheMotion) {
  BoxCase box = closed_box("semiImplicit");
  const Outcome whole = run(box, "whole_steps");
  constexpr double kMostCourant = 1e-3;
  box.control = "adjustTimeStep yes; maxCo 1e-3;";
  const Outcome parts = run(box, "parts_of_steps");
  expect_constant_momentum(parts);
  double most = 0;
  for (const auto& row : whole.rows)
    most = std::max(most, row.at("courant"));
  ASSERT_GT(most, 2 * kMostCourant) << "nothing to bound";
  // The Courant number is known only after a step: the first particle that changes its cell makes one step too long.
  const std::size_t warned = 7;
  for (std::size_t i = warned; i < parts.rows.size(); ++i)
    EXPECT_LT(parts.rows[i].at("courant"), 2 * kMostCourant) << "coupling step " << i;
  EXPECT_NEAR(parts.last("time"), whole.last("time"), 1e-9);
  EXPECT_NEAR(parts.last("fastest_particle"), whole.last("fastest_particle"), 0.01 * whole.last("fastest_particle"));
}

TEST(CoupledBox, BedAtRestMakesNoCurrent) {
  BoxCase box;
  box.size[0] = box.size[1] = 4 * kDiameter;
  box.size[2] = 8 * kDiameter;
  box.cells[2] = 12;
  box.periodic[2] = false;
  std::ostringstream script;
  script << script_head(box, 5e-5,
                        "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0\n"
                        "fix weight all gravity 9.81 vector 0 0 -1\n");
  for (int layer = 0; layer < 3; ++layer)
    for (int i = 0; i < 16; ++i)
      script << sphere((i % 4 + 0.5) * kDiameter, (i / 4 + 0.5) * kDiameter, (layer + 0.4999) * kDiameter);
  // The bed comes to rest in a fluid that is thick enough to come to rest with it: currents decay as exp(-39/s t).
  box.viscosity = 10;
  script << kSize
         << "fix mud all fluid/force rheology herschel_bulkley 0 10 1 density 1000 drag chien pressure_gradient on\n"
            "fix flow all fluid/couple link solver every 40\nrun 20000\n";
  box.script = script.str();
  const Outcome outcome = run(box, "rest");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.last("particles"), 48);
  EXPECT_LT(outcome.last("fastest_particle"), 1e-6);
  EXPECT_LT(outcome.last("fastest_fluid"), 1e-6);
  EXPECT_NEAR(outcome.last("solid_concentration"), 48 * M_PI / 6 / (4 * 4 * 8), 1e-9);
}

// Water: the disturbance that the sphere makes and meets again is small. Reference: drag of eq (20)-(23) in still
// water.
TEST(CoupledBox, SphereReachesItsTerminalVelocityInWater) {
  BoxCase box;
  const double wide = 0.24, high = 0.48;
  box.size[0] = box.size[1] = wide;
  box.size[2] = high;
  box.cells[0] = box.cells[1] = 12;
  box.cells[2] = 24;
  for (bool& periodic : box.periodic)
    periodic = false;
  box.viscosity = 1e-3;
  box.step = 5e-3;
  box.tolerance = 1e-8;
  box.coupling = "length 0.05;";
  box.script =
      script_head(box, 1e-4, "fix weight all gravity 9.81 vector 0 0 -1\n") + sphere(0.5 * wide, 0.5 * wide, 0.44) +
      kSize +
      "fix mud all fluid/force rheology herschel_bulkley 0 0.001 1 density 1000 drag chien pressure_gradient on\n"
      "fix flow all fluid/couple link solver every 50\nrun 6000\n";
  const Outcome outcome = run(box, "fall");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NEAR(outcome.last("fastest_particle"), 0.547488752614, 0.02 * 0.547488752614);
}

TEST(CoupledBox, TwoRanksGiveTheResultOfOne) {
  BoxCase box = closed_box("semiImplicit");
  box.correctors = 3;
  box.tolerance = 1e-13;
  const Outcome one = run(box, "one_rank"), two = run(box, "two_ranks", 2);
  ASSERT_EQ(one.status, 0) << one.text;
  ASSERT_EQ(two.status, 0) << two.text;
  ASSERT_EQ(one.rows.size(), two.rows.size());
  for (const char* column : {"com_x", "com_y", "com_z", "fastest_particle", "fastest_fluid", "least_fraction"})
    EXPECT_NEAR(one.last(column), two.last(column), 1e-9) << column;
}
