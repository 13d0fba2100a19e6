// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Single particles in prescribed flows, in LIGGGHTS: suspensions, spin, lift, stability, invariance, momentum.
#include "fluid_scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eccentra::test;
using eccentra::styles::FixFluidForce;

namespace {

constexpr double kPiTest = 3.14159265358979323846;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

std::string integrate(double step) {
  return "timestep " + number(step) + "\nfix integrate all nve/sphere\n";
}

/// Steady settling speed of one sphere in a bed of fluid fraction a that is fluidised: -grad p_rgh carries (1-a) of the
/// weight.
double settling_speed(const std::string& rheology, const std::string& arguments, double fraction, double step,
                      int steps) {
  LiggghtsSession session;
  const double excess = (1.0 - fraction) * (kSolidDensity - kFluidDensity) * kGravity;
  session.script(scene_head() + one_sphere() + gravity() + integrate(step) + "fix mud all fluid/force rheology " +
                 rheology + " density 1000 pressure_gradient on " + arguments +
                 "\nfix flow all fluid/uniform velocity 0 0 0 fraction " + number(fraction) +
                 " pressure_gradient 0 0 -" + number(excess) + "\nrun " + std::to_string(steps) + "\n");
  return -velocity_of(session, 1, 2);
}

TEST(Suspension, HinderedSettlingOfThePaper) {
  const std::string fluid = "herschel_bulkley 0 0.28 0.65";
  constexpr double alone = .283247422422;
  const double reference[][2] = {{.95, .827042}, {.9, .672088}, {.7, .232011}, {.5, .046306}};
  // Hindered settling is measured where there is no net flux: the velocity of the particles is fraction * slip.
  for (const auto& [fraction, ratio] : reference)
    EXPECT_NEAR(fraction * settling_speed(fluid, "drag chien", fraction, 2e-4, 2500) / alone, ratio, 1e-3 * ratio)
        << "fraction " << fraction;
}

TEST(Suspension, OnsetOfFluidisation) {
  // Superficial velocity = fraction * slip.
  struct Onset {
    const char* fluid;
    const char* drag;
    double fraction, superficial;
  };
  const Onset onsets[] = {{"newtonian 1e-3", "chien", .4, .063560},    {"newtonian 1e-3", "chien", .45, .083978},
                          {"newtonian 0.1", "chien", .4, .009817},     {"newtonian 0.1", "chien", .45, .014971},
                          {"newtonian 1e-3", "wen_yu", .4, .054083},   {"newtonian 1e-3", "wen_yu", .45, .075835},
                          {"newtonian 1e-3", "gidaspow", .4, .056817}, {"newtonian 0.1", "gidaspow", .45, .007008}};
  for (const Onset& c : onsets)
    EXPECT_NEAR(c.fraction * settling_speed(c.fluid, std::string("drag ") + c.drag, c.fraction, 5e-4, 2000),
                c.superficial, 1e-3 * c.superficial)
        << c.fluid << " " << c.drag << " " << c.fraction;
}

TEST(Suspension, VoidReynoldsGivesRichardsonAndZaki) {
  // Viscous drag: U/ut = alpha^4.65 with alpha Re... of (30/(alpha Re)) alpha^-1.65 and the share alpha of the weight.
  const double alone = settling_speed("newtonian 50", "drag chien void_reynolds on", 1.0, 1e-5, 200);
  const double half = settling_speed("newtonian 50", "drag chien void_reynolds on", 0.5, 1e-5, 200);
  EXPECT_NEAR(std::log(half / alone) / std::log(0.5), 1.0 + 1.65 + 1.0, 5e-3);
}

TEST(RotationalDrag, SpinDecaysWithTheTimeOfKirchhoff) {
  LiggghtsSession session;
  constexpr double viscosity = 0.1, step = 1e-4;
  constexpr int steps = 150;
  session.script(scene_head() + one_sphere() + "set group all omegax 0 omegay 0 omegaz 10\n" + integrate(step) +
                 "fix mud all fluid/force rheology newtonian 0.1 density 1000 drag_torque dennis\n"
                 "fix flow all fluid/uniform velocity 0 0 0\nrun " +
                 std::to_string(steps) + "\n");
  const double time = kSolidDensity * kDiameter * kDiameter / (60.0 * viscosity);
  const double expected = 10.0 * std::exp(-steps * step / time);
  const int i = session.local(1);
  if (i >= 0) { // first order: t dt/(2 time^2) = 0.24 %
    EXPECT_NEAR(session.atom().omega[i][2], expected, 5e-3 * expected);
  }
}

TEST(RotationalDrag, SpinInShearTendsToHalfTheVorticity) {
  for (const char* fluid : {"newtonian 0.1", "herschel_bulkley 1 0.28 0.65"}) {
    LiggghtsSession session;
    session.script(
        scene_head() + one_sphere() + integrate(1e-4) + "fix mud all fluid/force rheology " + fluid +
        " density 1000 drag chien drag_torque dennis\n"
        "fix flow all fluid/uniform velocity 0 0 0 velocity_gradient 0 8 0 0 0 0 0 0 0 origin 0.05 0.05 0.2\n"
        "run 4000\n");
    const int i = session.local(1);
    if (i >= 0) {
      EXPECT_NEAR(session.atom().omega[i][2], -4.0, 1e-6) << fluid;
    }
  }
}

TEST(Lift, DrivesALaggingParticleToTheFasterSide) {
  LiggghtsSession session;
  session.script(
      scene_head() + one_sphere() + integrate(1e-4) +
      "fix mud all fluid/force rheology newtonian 0.1 density 1000 shear_lift saffman_mei\n"
      "fix flow all fluid/uniform velocity 0.1 0 0 velocity_gradient 0 5 0 0 0 0 0 0 0 origin 0.05 0.05 0.2\n"
      "run 100\n");
  EXPECT_GT(velocity_of(session, 1, 1), 1e-5);
}

TEST(Forces, DoNotDependOnAMovingFrame) {
  double relative[2];
  for (const bool moving : {false, true}) {
    LiggghtsSession session;
    const double frame = moving ? 0.7 : 0.0;
    session.script(scene_head() + one_sphere() + "velocity all set " + number(0.2 + frame) + " 0.1 0\n" +
                   integrate(1e-4) +
                   "fix mud all fluid/force rheology herschel_bulkley 1 0.28 0.65 density 1000 drag chien shear_lift "
                   "saffman_mei rotational_lift oesterle_bui_dinh drag_torque dennis\n"
                   "fix flow all fluid/uniform velocity " +
                   number(frame) + " 0 0 velocity_gradient 0 0 3 0 0 0 0 0 0 origin 0 0 0.2\nrun 200\n");
    relative[moving] = velocity_of(session, 1, 0) - frame;
    EXPECT_GT(relative[moving], 0.0);
  }
  EXPECT_NEAR(relative[0], relative[1], 1e-12);
}

class Stiffness : public ::testing::TestWithParam<double> {};

// Ratios of density from a bubble-like to a heavy particle, with steps far beyond every time scale of the drag.
TEST_P(Stiffness, SlipNeverReversesAndTheTerminalVelocityStands) {
  const double ratio = GetParam();
  for (const double step : {1e-4, 1e-2}) {
    LiggghtsSession session;
    session.script(scene_head() + one_sphere(ratio * kFluidDensity) + "velocity all set 0.5 0 0\n" + integrate(step) +
                   "neigh_modify delay 0 every 1 check no\n"
                   "fix mud all fluid/force rheology herschel_bulkley 0.2 20 0.5 density 1000 drag chien\n"
                   "fix flow all fluid/uniform velocity 0 0 0\n");
    double before = 0.5;
    for (int block = 0; block < 20; ++block) {
      session.command("run 1");
      const double now = velocity_of(session, 1, 0);
      EXPECT_GE(now, 0.0);
      EXPECT_LE(now, before * (1 + 1e-12));
      before = now;
    }
    EXPECT_LE(before, 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(DensityRatios, Stiffness, ::testing::Values(0.05, 0.5, 1.0, 2.619, 8.0));

TEST(Stiffness, LightAndHeavyParticlesReachTheirBalance) {
  // Newtonian and viscous: drag 30 (pi/8) mu d U = (pi/6) d^3 (rho_p - rho_f) g.
  for (const double ratio : {0.05, 8.0})
    for (const double step : {1e-4, 1e-2}) {
      LiggghtsSession session;
      session.script(scene_head() + one_sphere(ratio * kFluidDensity) + gravity() + integrate(step) +
                     "neigh_modify delay 0 every 1 check no\n"
                     "fix mud all fluid/force rheology newtonian 100 density 1000 drag chien\n"
                     "fix flow all fluid/uniform velocity 0 0 0\nrun 100\n");
      const double expected =
          -kPiTest / 6 * kDiameter * kDiameter * (ratio - 1) * kFluidDensity * kGravity / (30 * kPiTest / 8 * 100);
      EXPECT_NEAR(velocity_of(session, 1, 2), expected, 1e-3 * std::abs(expected));
    }
}

TEST(YieldStress, BringsAMovingParticleToExactRest) {
  LiggghtsSession session;
  session.script(scene_head() + one_sphere() + "velocity all set 0.05 0.02 0.01\n" + integrate(1e-4) + gravity() +
                 "fix mud all fluid/force rheology herschel_bulkley 6 0.28 0.65 density 1000 drag chien\n"
                 "fix flow all fluid/uniform velocity 0 0 0\nrun 3000\n");
  for (int k = 0; k < 3; ++k)
    EXPECT_LE(std::abs(velocity_of(session, 1, k)), 1e-15);
}

/// m v of the only particle in the direction k minus what the fix says that the fluid gave it.
double momentum_without_fluid(LiggghtsSession& session, int k, double& given) {
  const int i = session.local(1);
  double mine[2] = {0.0, 0.0};
  if (i >= 0) {
    mine[0] = session.atom().rmass[i] * session.atom().v[i][k];
    mine[1] = FixFluidForce::find(&session.lammps())->received(i)[k];
  }
  double all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  given = all[1];
  return all[0] - all[1];
}

TEST(Momentum, ReactionIsWhatTheParticleReceived) {
  LiggghtsSession session;
  session.script(scene_head() + one_sphere() + "velocity all set 2.0 0.3 -1.0\n" + integrate(1e-4) +
                 "fix mud all fluid/force rheology herschel_bulkley 1 0.28 0.65 density 1000 drag chien shear_lift "
                 "saffman_mei rotational_lift oesterle_bui_dinh drag_torque dennis buoyancy off\n"
                 "fix flow all fluid/uniform velocity 0.3 0 0 velocity_gradient 0 0 6 0 0 0 0 0 0\n");
  double given = 0.0;
  double start[3];
  for (int k = 0; k < 3; ++k)
    start[k] = momentum_without_fluid(session, k, given);
  // Over several runs, through neighbour lists and from rank to rank (the particle crosses the periodic box).
  for (const char* run : {"run 1", "run 700", "run 333"}) {
    session.command(run);
    for (int k = 0; k < 3; ++k) {
      const double now = momentum_without_fluid(session, k, given);
      EXPECT_NE(given, 0.0);
      EXPECT_NEAR(now, start[k], 1e-15) << run << " of " << given;
    }
  }
}

TEST(Restart, ContinuesBitForBit) {
  const std::string flow =
      "fix mud all fluid/force rheology herschel_bulkley 1 0.28 0.65 density 1000 drag chien shear_lift "
      "saffman_mei rotational_lift oesterle_bui_dinh drag_torque dennis\n"
      "fix flow all fluid/uniform velocity 0.3 0 0 velocity_gradient 0 0 6 0 0 0 0 0 0\n";
  double straight[3], restarted[3], impulse[2] = {0, 0};
  {
    LiggghtsSession session;
    session.script(scene_head() + one_sphere() + "velocity all set 2.0 0.3 -1.0\n" + gravity() + integrate(1e-4) +
                   flow + "run 300\nwrite_restart fluid.restart\nrun 300\n");
    for (int k = 0; k < 3; ++k)
      straight[k] = velocity_of(session, 1, k);
    const int i = session.local(1);
    if (i >= 0)
      impulse[0] = FixFluidForce::find(&session.lammps())->received(i)[0];
  }
  {
    LiggghtsSession session;
    std::string head = scene_head();
    const auto box = head.find("region box");
    const auto neighbor = head.find("neighbor");
    head.replace(box, neighbor - box, "read_restart fluid.restart\n");
    session.script(head + gravity() + integrate(1e-4) + flow + "run 300\n");
    for (int k = 0; k < 3; ++k)
      restarted[k] = velocity_of(session, 1, k);
    const int i = session.local(1);
    if (i >= 0)
      impulse[1] = FixFluidForce::find(&session.lammps())->received(i)[0];
  }
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(straight[k], restarted[k]);
  EXPECT_EQ(impulse[0], impulse[1]);
}

TEST(Frozen, ParticlesLoadTheFluidAndDoNotMove) {
  LiggghtsSession session;
  session.script(scene_head() + one_sphere() + integrate(1e-4) +
                 "fix mud all fluid/force rheology newtonian 0.1 density 1000 drag chien\n"
                 "fix flow all fluid/uniform velocity 0.3 0 0\nfix hold all freeze\nrun 100\n");
  EXPECT_EQ(velocity_of(session, 1, 0), 0.0);
  const int i = session.local(1);
  const double re = kFluidDensity * 0.3 * kDiameter / 0.1;
  const double drag = kPiTest / 8 * kFluidDensity * kDiameter * kDiameter * 0.09 * (30 / re + 67.289 * std::exp(-5.03));
  if (i >= 0) {
    EXPECT_NEAR(FixFluidForce::find(&session.lammps())->reaction().impulse[i][0], drag * 100.5e-4, 1e-9 * drag);
  }
}

} // namespace
