// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid and particles at the same time: the error of the staggered step, what stays exact, and going on.
#include "coupled/checkpoint_scene.h"
#include "link/two_jobs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr double kDemStep = 5e-5;
constexpr double kEnd = 0.064; ///< [s]

/// Spheres thrown through a fluid at rest in a closed box, without a contact; `interval` in DEM steps.
BoxCase thrown(const std::string& name, int interval, const std::string& overlap) {
  BoxCase box;
  box.step = interval * kDemStep;
  box.viscosity = 0.5;
  // One time level of momentum, as in tests/coupled/box_test.cpp.
  box.time_scheme = "Euler";
  box.tolerance = 1e-14;
  box.coupling = "tolerance 1e-14; momentum semiImplicit; length 0.019; link socket; address \"" +
                 socket_address(name) + "\"; wait 60;";
  std::ostringstream script;
  script << script_head(box, kDemStep);
  for (int i = 0; i < 8; ++i) {
    const int layer = i / 4;
    script << "create_atoms 1 single " << 0.012 + 0.03 * (i % 2) << ' ' << 0.014 + 0.03 * (i / 2 % 2) << ' '
           << 0.016 + 0.03 * layer << " units box\n";
  }
  script << "set group all diameter 6.35e-3 density 2619\n";
  for (int i = 0; i < 8; ++i)
    script << "set atom " << i + 1 << " vx " << 0.2 + 0.03 * i << " vy " << 0.02 * i - 0.05 << " vz 0.1\n";
  script << "fix mud all fluid/force rheology herschel_bulkley 0 0.5 1 density 1000 drag chien pressure_gradient on\n"
         << "fix flow all fluid/couple link socket " << socket_address(name) << " every " << interval
         << " wait 60 overlap " << overlap << "\nrun " << std::lround(kEnd / kDemStep) << "\n";
  box.script = script.str();
  return box;
}

/// Both jobs, the DEM side in a folder of its own.
Outcome run_both(const BoxCase& box, const std::string& name, int dem_ranks = 1, int fluid_ranks = 1) {
  const fs::path folder = fs::absolute(name + "_dem");
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "in.dem") << box.script;
  BackgroundJob particles(folder.string(), command("eccentra-dem", {"-in", "in.dem", "-log", "log.dem"}, dem_ranks),
                          "out.dem");
  Outcome outcome = run(box, name, fluid_ranks);
  EXPECT_EQ(outcome.status, 0) << outcome.text << particles.text();
  EXPECT_EQ(particles.wait(kStart), 0) << particles.text();
  outcome.text += particles.text();
  return outcome;
}

constexpr const char* kColumns[] = {"com_x", "com_y", "com_z"};

/// Distance of the particles' centre at the end from that of another run [m].
double distance(const Outcome& a, const Outcome& b) {
  double sum = 0;
  for (const char* column : kColumns)
    sum += std::pow(a.last(column) - b.last(column), 2);
  return std::sqrt(sum);
}

} // namespace

TEST(Overlap, ErrorAgainstTakingTurnsIsOfFirstOrderInTheInterval) {
  double before = 0;
  for (const int interval : {80, 40, 20}) {
    const std::string name = "order" + std::to_string(interval);
    const double error =
        distance(run_both(thrown(name, interval, "no"), name), run_both(thrown(name, interval, "yes"), name));
    std::printf("interval %.1f ms: the particles' centre differs by %.3g mm\n", 1e3 * interval * kDemStep, 1e3 * error);
    EXPECT_GT(error, 1e-9) << "nothing was staggered";
    if (before > 0) {
      EXPECT_GT(before / error, 1.7) << interval;
      EXPECT_LT(before / error, 2.5) << interval;
    }
    before = error;
  }
}

TEST(Overlap, MomentumStaysExact) {
  for (const bool parts : {false, true}) {
    const std::string name = parts ? "momentum_parts" : "momentum";
    BoxCase box = thrown(name, 40, "yes");
    box.correctors = 30;
    if (parts)
      box.control = "adjustTimeStep yes; maxCo 0.004;";
    const Outcome outcome = run_both(box, name, 2, 2);
    ASSERT_GT(outcome.rows.size(), 20u);
    const auto& start = outcome.rows.front();
    const double scale = std::hypot(start.at("momentum_x"), start.at("momentum_y"), start.at("momentum_z"));
    ASSERT_GT(scale, 1e-4);
    for (const auto& row : outcome.rows)
      for (const char* column : {"momentum_x", "momentum_y", "momentum_z"})
        EXPECT_NEAR(row.at(column), start.at(column), 1e-9 * scale) << column << " at " << row.at("time");
  }
}

// All of contacts, walls and fluid; the state is that of the last coupling step, the flow's next step still to come.
TEST(Overlap, CheckpointGoesOnWithTheSameDigits) {
  constexpr int kSteps = 24 * kStepsPerCouplingStep;
  constexpr int kMiddle = 16 * kStepsPerCouplingStep;
  const std::string address = socket_address("goes_on");
  BoxCase box = stirred_box("socket " + address + " every 40 checkpoint 8 wait 60 overlap yes", kSteps, true);
  box.coupling += "link socket; address \"" + address + "\"; wait 60;";
  const Outcome straight = run_both(box, "goes_on");
  const std::string dem = fs::absolute("goes_on_dem");
  const std::string bodies = contents(dem + "/end.bodies");
  ASSERT_FALSE(bodies.empty());
  fs::remove(dem + "/end.bodies");
  fs::remove_all(dem + "/checkpoints/" + std::to_string(kSteps));
  BackgroundJob particles(dem, command("eccentra-dem", {"-in", "in.dem", "-log", "none", "-resume"}, 1), "log.resumed");
  BackgroundJob fluid(straight.folder, command("annulusFoam", {"-resume"}, 1), "log.resumed");
  EXPECT_EQ(particles.wait(kStart), 0) << particles.text();
  EXPECT_EQ(fluid.wait(kStart), 0) << fluid.text();
  EXPECT_NE(particles.text().find("goes on from checkpoint " + std::to_string(kMiddle)), std::string::npos)
      << particles.text();
  EXPECT_EQ(contents(dem + "/end.bodies"), bodies);

  // The other way of coupling step is another run.
  replace_in(dem + "/in.dem", "overlap yes", "overlap no");
  BackgroundJob other(dem, command("eccentra-dem", {"-in", "in.dem", "-log", "none", "-resume"}, 1), "log.other");
  BackgroundJob its_fluid(straight.folder, command("annulusFoam", {"-resume"}, 1), "log.other");
  EXPECT_GT(other.wait(kStart), 0);
  EXPECT_GT(its_fluid.wait(kStart), 0);
  for (const BackgroundJob* job : {&other, &its_fluid})
    EXPECT_NE(job->text().find("was written with overlap yes and fix fluid/couple has the other"), std::string::npos)
        << job->text();
}

TEST(Overlap, IsRefusedWhereBothShareTheirRanks) {
  BoxCase box;
  box.script = script_head(box, kDemStep) +
               "fix mud all fluid/force rheology herschel_bulkley 0 0.01 1 density 1000 drag chien\n"
               "fix flow all fluid/couple link solver every 40 overlap yes\nrun 40\n";
  const Outcome outcome = run(box, "solver_link");
  EXPECT_GT(outcome.status, 0);
  EXPECT_NE(outcome.text.find("keyword 'overlap': 'on' belongs to link socket"), std::string::npos) << outcome.text;
}
