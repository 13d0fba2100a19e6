// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Plain spheres on planes and cylinders: stock's own trajectory on planes, the right spin on turning cylinders.
#include "styles/walls/wall_scene.h"

#include "fix.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <cmath>

using eccentra::test::LiggghtsSession;
using eccentra::test::state_of;
using eccentra::test::wall_scene;

namespace {

constexpr double kDiameter = 6.35e-3;
constexpr double kRadius = kDiameter / 2;
constexpr double kOmega50rpm = 5.235987755982989; // rad/s

/// A sphere thrown obliquely with spin onto the floor of two walls that meet: many impacts, sliding and sticking.
std::array<double, 9> thrown_into_corner(const std::string& style, const std::string& rolling) {
  LiggghtsSession session;
  session.script(wall_scene(5e-6));
  session.script(R"(
    create_atoms 1 single 0.09 0.01 -0.09 units box
    set group all diameter 6.35e-3 density 2619
    velocity all set 0.3 0.1 -0.5
    set group all omegax 30 omegay -20 omegaz 15
    fix gravity all gravity 9.81 vector 0 0.1 -1
    fix floor all )" +
                 style + " model hertz tangential history " + rolling +
                 R"( primitive type 2 zplane -0.095
    fix side all )" +
                 style + " model hertz tangential history " + rolling +
                 R"( primitive type 1 xplane 0.094
    fix integrate all nve/sphere
    run 20000
  )");
  return state_of(session, 1);
}

/// Spin about z [rad/s] that a sphere takes on which is held fast against a z cylinder that turns at 50 rpm; `centre`
/// is its distance from the axis.
double spin_beside_cylinder(const std::string& style, const std::string& turning, double cylinder, double centre) {
  LiggghtsSession session;
  session.script(wall_scene(1e-5));
  session.script("create_atoms 1 single " + std::to_string(centre) + R"( 0 0 units box
    set group all diameter 6.35e-3 density 2619
    fix wall all )" +
                 style + " model hertz tangential history primitive type 1 zcylinder " + std::to_string(cylinder) +
                 " 0 0 " + turning + R"(
    fix integrate all nve/sphere
    fix hold all setforce 0 0 0
    run 20000
  )");
  return state_of(session, 1)[8];
}

} // namespace

TEST(WallSpheres, PlaneTrajectoryIsStocks) {
  for (const std::string rolling : {"", "rolling_friction cdt"}) {
    const auto ours = thrown_into_corner("wall/gran/cluster", rolling + " contacts parallel");
    const auto stock = thrown_into_corner("wall/gran", rolling);
    for (int k = 0; k < 9; ++k) {
      // Round-off of 1e-16 per step, amplified by each of the impacts: far below what any other law would give.
      const double scale = k < 3 ? 1e-3 : k < 6 ? 0.1 : 10.0;
      EXPECT_NEAR(ours[k], stock[k], 1e-9 * scale) << "component " << k << " " << rolling;
    }
    EXPECT_NE(stock[7], 0.0);
  }
}

TEST(WallSpheres, SpinOnTurningCylinderIsThatOfItsSurface) {
  constexpr double kPipe = 24.13e-3;
  constexpr double kHole = 63.5e-3;
  constexpr double kOverlap = 2e-6;
  const std::string rotate = "rotate " + std::to_string(kOmega50rpm);
  // Rolling without slip: outside the pipe the sphere turns against it, inside the hole with it.
  const double outside = spin_beside_cylinder("wall/gran/cluster", rotate, kPipe, kPipe + kRadius - kOverlap);
  EXPECT_NEAR(outside, -kOmega50rpm * kPipe / kRadius, 0.005 * 39.79);
  const double inside = spin_beside_cylinder("wall/gran/cluster", rotate, kHole, kHole - kRadius + kOverlap);
  EXPECT_NEAR(inside, kOmega50rpm * kHole / kRadius, 0.005 * 104.7);
  // Stock takes the wall's velocity at the sphere's centre. The test sees that difference.
  const std::string shear = "shear x " + std::to_string(kOmega50rpm);
  const double stock = spin_beside_cylinder("wall/gran", shear, kPipe, kPipe + kRadius - kOverlap);
  EXPECT_GT(std::abs(stock), 1.10 * std::abs(outside));
}

TEST(WallSpheres, CylindersAboutAllAxesTurnAlike) {
  // The same scene with axes permuted: the spin component along the axis must be the same number.
  const double z = spin_beside_cylinder("wall/gran/cluster", "rotate 5", 0.02, 0.02 + kRadius - 2e-6);
  for (const char axis : {'x', 'y'}) {
    LiggghtsSession session;
    session.script(wall_scene(1e-5));
    // x cylinder: radial direction y; y cylinder: radial direction z.
    const std::string place = axis == 'x' ? "0 " + std::to_string(0.02 + kRadius - 2e-6) + " 0"
                                          : "0 0 " + std::to_string(0.02 + kRadius - 2e-6);
    session.script("create_atoms 1 single " + place + R"( units box
      set group all diameter 6.35e-3 density 2619
      fix wall all wall/gran/cluster model hertz tangential history primitive type 1 )" +
                   axis + R"(cylinder 0.02 0 0 rotate 5
      fix integrate all nve/sphere
      fix hold all setforce 0 0 0
      run 20000
    )");
    EXPECT_NEAR(state_of(session, 1)[axis == 'x' ? 6 : 7], z, 1e-6 * std::abs(z));
  }
}

TEST(WallSpheres, WallForceAndTorqueBalanceTheParticle) {
  LiggghtsSession session;
  session.script(wall_scene(1e-5));
  session.script(R"(
    create_atoms 1 single 0.03 0.02 -0.0919 units box
    set group all diameter 6.35e-3 density 2619
    set group all omegax 3 omegay -2
    fix floor all wall/gran/cluster model hertz tangential history primitive type 1 plane 0.01 0 -0.095 0 0 2
    fix integrate all nve/sphere
    run 0
  )");
  auto* floor = session.lammps().modify->fix[session.lammps().modify->find_fix("floor")];
  double wall[6];
  for (int k = 0; k < 6; ++k)
    wall[k] = floor->compute_vector(k);
  double body[6] = {};
  const int i = session.local(1);
  if (i >= 0)
    for (int k = 0; k < 3; ++k) {
      body[k] = session.atom().f[i][k];
      body[3 + k] = session.atom().torque[i][k];
    }
  MPI_Allreduce(MPI_IN_PLACE, body, 6, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_GT(body[2], 0.0);
  EXPECT_NE(body[3], 0.0);
  const double arm[3] = {0.03 - 0.01, 0.02, -0.0919 + 0.095};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(wall[k], -body[k], 1e-15);
    const int a = (k + 1) % 3;
    const int b = (k + 2) % 3;
    EXPECT_NEAR(wall[3 + k], -(body[3 + k] + arm[a] * body[b] - arm[b] * body[a]), 1e-15);
  }
  EXPECT_EQ(floor->compute_scalar(), 1.0);
}

TEST(WallSpheres, RollingFrictionSeesTheSpinRelativeToTheWall) {
  const auto torque = [](const std::string& rolling, double spin) {
    LiggghtsSession session;
    session.script(wall_scene(1e-5));
    session.script("create_atoms 1 single " + std::to_string(0.05 - kRadius + 1e-5) + R"( 0 0 units box
      set group all diameter 6.35e-3 density 2619
      set group all omegaz )" +
                   std::to_string(spin) + R"(
      fix wall all wall/gran/cluster model hertz tangential history rolling_friction )" +
                   rolling + R"( primitive type 1 zcylinder 0.05 0 0 rotate 5
      fix integrate all nve/sphere
      run 0
    )");
    double value = 0;
    const int i = session.local(1);
    if (i >= 0)
      value = session.atom().torque[i][2];
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return value;
  };
  EXPECT_EQ(torque("cdt", 5), torque("off", 5)); // turns with the wall: nothing rolls
  EXPECT_LT(torque("cdt", 6), torque("off", 6)); // faster than the wall: is held back
  EXPECT_GT(torque("cdt", 4), torque("off", 4)); // slower: is taken along
}

TEST(WallSpheres, SlidingAcrossRanksIsStocks) {
  const auto slide = [](const std::string& style) {
    LiggghtsSession session;
    session.script(wall_scene(1e-5, "0.5"));
    session.script(R"(
      create_atoms 1 single -0.002 0.01 -0.0918 units box
      set group all diameter 6.35e-3 density 2619
      velocity all set 0.4 0.05 0
      fix gravity all gravity 9.81 vector 0 0 -1
      fix floor all )" +
                   style + R"( primitive type 1 zplane -0.095
      fix integrate all nve/sphere
      run 3000
    )");
    return state_of(session, 1);
  };
  const auto ours = slide("wall/gran/cluster model hertz tangential history contacts parallel");
  const auto stock = slide("wall/gran model hertz tangential history");
  EXPECT_GT(ours[0], 0.002); // it has crossed the border between the ranks
  for (int k = 0; k < 9; ++k)
    EXPECT_NEAR(ours[k], stock[k], 1e-11 * (k < 6 ? 1 : 100));
}

TEST(WallSpheres, RestartGoesOnToTheLastDigit) {
  const std::string wall =
      "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane -0.095\n";
  const std::string physics = R"(
    fix gravity all gravity 9.81 vector 0.3 0 -1
    fix integrate all nve/sphere
  )";
  const auto run = [&](const std::string& steps) {
    LiggghtsSession session;
    session.script(wall_scene(1e-5));
    session.script(R"(
      create_atoms 1 single 0.01 0.01 -0.0919 units box
      set group all diameter 6.35e-3 density 2619
    )");
    session.script(physics + wall + steps);
    return state_of(session, 1);
  };
  const auto straight = run("run 1000\nrun 1500");
  run("run 1000\nwrite_restart walls.restart");
  // From the file: materials are input, not state.
  LiggghtsSession session;
  session.script(R"(
    atom_style granular
    atom_modify map array
    newton off
    communicate single vel yes
    units si
    read_restart walls.restart
    neighbor 0.002 bin
    neigh_modify delay 0
    fix m1 all property/global youngsModulus peratomtype 5e6 5e6
    fix m2 all property/global poissonsRatio peratomtype 0.3 0.3
    fix m3 all property/global coefficientRestitution peratomtypepair 2 0.9 0.9 0.9 0.9
    fix m4 all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5
    fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1
    pair_style gran model hertz tangential history
    pair_coeff * *
    timestep 1e-5
  )");
  session.script(physics + wall + "run 1500");
  const auto restarted = state_of(session, 1);
  for (int k = 0; k < 9; ++k)
    EXPECT_EQ(restarted[k], straight[k]) << "component " << k;
}

TEST(WallSpheres, RollingFrictionShapeIsThatOfStockWalls) {
  for (const std::string form : {"limited", "directional", "epsd"}) {
    const auto rolling = [&](const std::string& style, bool words_last) {
      LiggghtsSession session;
      session.script(wall_scene(1e-5, "0.5", "0.02"));
      const std::string arguments = " form " + form + " torsionTorque off";
      session.script("fix m6 all property/global shapeRollingFriction peratomtypepair 2 0.03 0.03 0.03 0.03\n"
                     "pair_style gran model hertz tangential history rolling_friction shape" +
                     arguments + R"(
        pair_coeff * *
        create_atoms 1 single -0.02 0.01 -0.0919 units box
        set group all diameter 6.35e-3 density 2619
        velocity all set 0.1 0.02 0
        fix gravity all gravity 9.81 vector 0 0 -1
      )");
      const std::string wall = " primitive type 1 zplane -0.095";
      session.script("fix floor all " + style + " model hertz tangential history rolling_friction shape" +
                     (words_last ? wall + arguments : arguments + " contacts parallel" + wall) +
                     "\nfix integrate all nve/sphere\nrun 10000");
      return state_of(session, 1);
    };
    const auto ours = rolling("wall/gran/cluster", false);
    const auto stock = rolling("wall/gran", true);
    EXPECT_GT(ours[0], -0.015) << "it has rolled on";
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(ours[k], stock[k], 1e-9 * (k < 3 ? 1e-3 : k < 6 ? 0.1 : 10.0)) << form << ", component " << k;
  }
}
