// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The screen keeps what decides and drops what does not, the same on any ranks and after a restart.
#include "closures/log_histogram.h"
#include "link/flow_quantities.h"

#include "fluid_scene.h"
#include "styles/entry/style_registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <sstream>

using namespace eccentra::test;
using namespace eccentra::closures;
using namespace eccentra::link;
using namespace eccentra::styles;

namespace {

/// 32 spheres apart from each other, sinking in a fluid that shears in z.
std::string scene(const std::string& flow, const std::string& arguments,
                  const std::string& fluid = "herschel_bulkley 1 0.28 0.65") {
  return scene_head() + "lattice sc 0.05\ncreate_atoms 1 box\nset group all diameter 0.00635 density 2619\n" +
         gravity() + "timestep 1e-4\nfix integrate all nve/sphere\nfix mud all fluid/force density 1000 rheology " +
         fluid + " " + arguments + "\nfix flow all fluid/uniform velocity 0 0 0 " + flow + "\n";
}

/// Mean velocity of all spheres.
std::array<double, 3> mean_velocity(LiggghtsSession& session) {
  double sums[4] = {0, 0, 0, double(session.atom().nlocal)};
  for (int i = 0; i < session.atom().nlocal; ++i)
    for (int k = 0; k < 3; ++k)
      sums[k] += session.atom().v[i][k];
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return {sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]};
}

unsigned needs(LiggghtsSession& session) {
  return FixFluidForce::find(&session.lammps())->needs();
}

bool acts(LiggghtsSession& session, const std::string& effect) {
  return FixFluidForce::find(&session.lammps())->acts(effect);
}

struct Scene {
  const char* name;
  const char* effect;
  bool decides;
  std::string fluid; ///< rheology, and density where it is not that of water
  std::string flow;
  std::string arguments; ///< what is not up to the screen
};

void PrintTo(const Scene& scene, std::ostream* stream) {
  *stream << scene.name;
}

class Screen : public ::testing::TestWithParam<Scene> {};

TEST_P(Screen, KeepsWhatDecidesAndStaysWithinTwiceTheTolerance) {
  const Scene& c = GetParam();
  constexpr double tolerance = 0.01;
  std::array<double, 3> all{}, screened{};
  {
    LiggghtsSession session;
    const std::string everything = "drag chien shear_lift saffman_mei rotational_lift oesterle_bui_dinh "
                                   "pressure_gradient on viscous_stress on drag_torque dennis ";
    session.script(scene(c.flow, everything + c.arguments, c.fluid) + "run 4000\n");
    all = mean_velocity(session);
  }
  {
    LiggghtsSession session;
    session.script(scene(c.flow, c.arguments + " screen 0.01 screen_steps 2000 screen_recheck 0", c.fluid) + "run 1\n");
    EXPECT_TRUE(acts(session, c.effect)) << "everything is on while the screen looks";
    session.command("run 3999");
    EXPECT_EQ(acts(session, c.effect), c.decides);
    screened = mean_velocity(session);
  }
  const double size = std::sqrt(all[0] * all[0] + all[1] * all[1] + all[2] * all[2]);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(screened[k], all[k], 2 * tolerance * size);
}

const std::string kMud = "herschel_bulkley 1 0.28 0.65", kOil = "newtonian 0.1";
const std::string kAir = "newtonian 2e-5 density 1.2", kGas = "newtonian 1e-5 density 0.1";
// u_z grows along x: the spheres lag behind a sheared flow.
const std::string kShear = "velocity_gradient 0 0 0 0 0 0 20 0 0 origin 0.05 0 0";
const std::string kWeakShear = "velocity_gradient 0 0 0 0 0 0 0.001 0 0 origin 0.05 0 0";
// Spheres that do not turn with the flow (no rotational drag) feel their spin relative to it.
const std::string kNoTorque = "drag_torque none";
INSTANTIATE_TEST_SUITE_P(
    Scenes, Screen,
    ::testing::Values(
        Scene{"gradient_strong_in_mud", "pressure_gradient", true, kMud, "pressure_gradient 0 3000 0", ""},
        Scene{"gradient_strong_in_oil", "pressure_gradient", true, kOil, "pressure_gradient 2000 0 0", ""},
        Scene{"gradient_weak_in_mud", "pressure_gradient", false, kMud, "pressure_gradient 0 30 0", ""},
        Scene{"gradient_weak_in_oil", "pressure_gradient", false, kOil, "pressure_gradient 0 0 40", ""},
        Scene{"stress_strong_in_mud", "viscous_stress", true, kMud, "stress_divergence 1000 0 0", ""},
        Scene{"stress_strong_in_oil", "viscous_stress", true, kOil, "stress_divergence 0 0 2000", ""},
        Scene{"stress_weak_in_mud", "viscous_stress", false, kMud, "stress_divergence 20 0 0", ""},
        Scene{"stress_weak_in_oil", "viscous_stress", false, kOil, "stress_divergence 20 0 0", ""},
        Scene{"shear_strong_in_mud", "shear_lift", true, kMud, kShear, kNoTorque},
        Scene{"shear_strong_in_oil", "shear_lift", true, kOil, kShear, ""},
        Scene{"shear_weak_in_oil", "shear_lift", false, kOil, kWeakShear, ""},
        Scene{"shear_none_in_mud", "shear_lift", false, kMud, "", ""},
        Scene{"spin_strong_in_mud", "rotational_lift", true, kMud, kShear, kNoTorque},
        Scene{"spin_strong_in_oil", "rotational_lift", true, kOil, kShear, kNoTorque},
        Scene{"spin_follows_in_oil", "rotational_lift", false, "newtonian 1", kWeakShear, ""},
        Scene{"spin_none_in_mud", "rotational_lift", false, kMud, "", ""},
        Scene{"drag_in_mud", "drag", true, kMud, "", ""}, Scene{"drag_in_oil", "drag", true, kOil, "", ""},
        Scene{"drag_in_thin_gas", "drag", false, kGas, "", ""},
        Scene{"drag_of_air_on_short_falls", "drag", false, kAir, "", ""},
        Scene{"buoyancy_in_mud", "buoyancy", true, kMud, "", ""},
        Scene{"buoyancy_in_oil", "buoyancy", true, kOil, "", ""},
        Scene{"buoyancy_in_air", "buoyancy", false, kAir, "", ""},
        Scene{"buoyancy_in_thin_gas", "buoyancy", false, kGas, "", ""}),
    [](const auto& info) { return std::string(info.param.name); });

// Gas does not hold up spheres of 6 mm, but it does a sphere of 0.1 mm, which is one of 32.
TEST(ScreenClasses, AFewSmallBodiesAreNotOutvoted) {
  for (const bool small : {false, true}) {
    LiggghtsSession session;
    session.script(scene("", "screen 0.01 screen_steps 2000 screen_recheck 0", kGas) +
                   (small ? "set atom 1 diameter 1e-4 density 2619\n" : "") + "run 2001\n");
    EXPECT_EQ(acts(session, "drag"), small);
  }
}

/// A sphere slides on a floor and friction makes it roll: is the fluid's torque worth its price beside that of
/// friction?
bool torque_stays(const std::string& fluid, double speed) {
  LiggghtsSession session;
  session.script(scene_head("p p f") + "create_atoms 1 single 0.05 0.05 0.003175 units box\n" +
                 "set group all diameter 0.00635 density 2619\nvelocity all set " + std::to_string(speed) + " 0 0\n" +
                 gravity() + "timestep 5e-5\nfix integrate all nve/sphere\n" +
                 "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0.0\n" +
                 "fix mud all fluid/force rheology " + fluid + " rotational_lift none screen 0.01 screen_steps 200\n" +
                 "fix flow all fluid/uniform velocity 0 0 0\nrun 250\n");
  return acts(session, "drag_torque");
}

TEST(ScreenState, WeighsTheTorqueOfTheFluidAgainstFriction) {
  EXPECT_FALSE(torque_stays(kAir, 0.3));
  EXPECT_FALSE(torque_stays(kGas, 0.5));
  EXPECT_TRUE(torque_stays("newtonian 10 density 1000", 0.3));
  EXPECT_TRUE(torque_stays("herschel_bulkley 20 2 0.65 density 1000", 0.5));
}

TEST(ScreenState, RecheckSwitchesOnWhatHasComeToMatter) {
  LiggghtsSession session;
  session.script("variable gx equal 2000*(step>600)\n" +
                 scene("pressure_gradient v_gx 0 0",
                       "drag chien drag_torque none screen 0.01 screen_steps 200 screen_recheck 500") +
                 "run 250\n");
  EXPECT_FALSE(needs(session) & kPressureGradient);
  session.command("run 1000");
  EXPECT_TRUE(needs(session) & kPressureGradient);
}

TEST(ScreenState, RestartContinuesBitForBit) {
  const std::string arguments = "screen 0.01 screen_steps 200 screen_recheck 300";
  const std::string flow = "velocity_gradient 0 0 0 0 0 0 3 0 0 pressure_gradient 0 100 0";
  std::array<double, 3> straight{}, restarted{};
  unsigned needs_straight = 0;
  for (const int stop : {150, 350, 500}) { // in the first measurement, in the pause, about to measure again
    {
      LiggghtsSession session;
      session.script(scene(flow, arguments) + "run " + std::to_string(stop) +
                     "\nwrite_restart screen.restart\nrun 400\n");
      straight = mean_velocity(session);
      needs_straight = needs(session);
    }
    LiggghtsSession session;
    std::string script = scene(flow, arguments);
    const auto box = script.find("region box"), neighbor = script.find("neighbor");
    script.replace(box, neighbor - box, "read_restart screen.restart\n");
    const auto create = script.find("lattice"), after = script.find("fix gravity");
    script.erase(create, after - create);
    session.script(script + "run 400\n");
    restarted = mean_velocity(session);
    EXPECT_EQ(needs(session), needs_straight);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(restarted[k], straight[k]) << "stopped at " << stop;
  }
}

TEST(ScreenState, SpinStaysDampedWhereItMakesLift) {
  LiggghtsSession session;
  session.script(scene("velocity_gradient 0 0 0 0 0 0 20 0 0 origin 0.05 0 0",
                       "shear_lift none screen 0.001 screen_steps 200", kOil) +
                 "run 250\n");
  EXPECT_TRUE(needs(session) & kVorticity);
}

/// A LIGGGHTS instance of this rank alone.
class SerialSession {
 public:
  SerialSession() {
    static char name[] = "liggghts", log[] = "-log", screen[] = "-screen", none[] = "none";
    char* arguments[] = {name, log, none, screen, none};
    lammps_ = std::make_unique<LAMMPS_NS::LAMMPS>(5, arguments, MPI_COMM_SELF);
    eccentra::styles::enter(lammps_.get());
  }
  void script(const std::string& lines) {
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);)
      if (line.find_first_not_of(" \t") != std::string::npos)
        lammps_->input->one(line.c_str());
  }
  LAMMPS_NS::LAMMPS& lammps() { return *lammps_; }

 private:
  std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

TEST(ScreenState, VerdictsDoNotDependOnRanks) {
  const std::string script = scene("velocity_gradient 0 0 0 0 0 0 3 0 0 pressure_gradient 0 150 0",
                                   "screen 0.01 screen_steps 200 screen_recheck 300") +
                             "run 800\n";
  LiggghtsSession together;
  together.script(script);
  SerialSession alone;
  alone.script(script);
  const FixFluidForce& fluid = *FixFluidForce::find(&alone.lammps());
  int dropped = 0;
  for (const char* effect :
       {"drag", "shear_lift", "rotational_lift", "drag_torque", "pressure_gradient", "viscous_stress", "buoyancy"}) {
    EXPECT_EQ(acts(together, effect), fluid.acts(effect)) << effect;
    dropped += !fluid.acts(effect);
  }
  EXPECT_GT(dropped, 0);
  const LAMMPS_NS::Atom& atom = *alone.lammps().atom;
  for (int i = 0; i < atom.nlocal; ++i) {
    const int j = together.local(atom.tag[i]);
    for (int k = 0; j >= 0 && k < 3; ++k)
      EXPECT_EQ(together.atom().v[j][k], atom.v[i][k]);
  }
}

TEST(LogHistogram, QuantilesAreThoseOfTheData) {
  LogHistogram histogram;
  for (int n = 1; n <= 1000; ++n)
    histogram.add(1e-3 * n);
  EXPECT_NEAR(histogram.quantile(.95), .95, .05 * .95);
  EXPECT_NEAR(histogram.quantile(.5), .5, .05 * .5);
  EXPECT_DOUBLE_EQ(histogram.largest(), 1.0);
  EXPECT_NEAR(histogram.mean(), .5005, 1e-12);
  histogram.add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(histogram.largest(), 1e12);
  LogHistogram zeros;
  zeros.add(0.0);
  EXPECT_EQ(zeros.quantile(.95), 0.0);
}

} // namespace
