// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two jobs and a socket between them: the result of one job, and what both say when one of them is missing or lost.
#include "coupled/coupled_case.h"
#include "link/background_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

/// Seconds that a fault may take to be noticed, and that starting and ending a program may take besides.
constexpr double kNotice = 5.0;
constexpr double kStart = 40.0;

/// Spheres in a fluid in a periodic box.
BoxCase scene(const std::string& link, int steps) {
  BoxCase box;
  std::ostringstream script;
  script << script_head(box, 5e-5);
  for (int i = 0; i < 27; ++i) {
    const int row = i / 3 % 3, layer = i / 9;
    script << "create_atoms 1 single " << 0.005 + 0.02 * (i % 3) << ' ' << 0.006 + 0.02 * row << ' '
           << 0.007 + 0.02 * layer << " units box\n";
  }
  script << "set group all diameter 6.35e-3 density 2619\n";
  for (int i = 0; i < 27; ++i)
    script << "set atom " << i + 1 << " vx " << 0.3 + 0.2 * std::sin(i) << " vy " << 0.1 * std::cos(2 * i) << " vz "
           << -0.2 + 0.1 * std::sin(3 * i) << "\n";
  script << "fix mud all fluid/force rheology herschel_bulkley 0 0.01 1 density 1000 drag chien pressure_gradient on\n"
         << "fix flow all fluid/couple link " << link << " every 40\nrun " << steps << "\n";
  box.script = script.str();
  return box;
}

/// Unix sockets have short names only.
std::string address(const std::string& name) {
  return "ipc://" + (fs::temp_directory_path() / ("eccentra-" + std::to_string(getpid()) + "-" + name)).string();
}

std::vector<std::string> command(const std::string& program, const std::vector<std::string>& arguments, int ranks) {
  std::vector<std::string> all;
  if (ranks > 1)
    all = {"mpirun", "--oversubscribe", "--bind-to", "none", "-np", std::to_string(ranks)};
  all.push_back(std::string(std::getenv("ECCENTRA_BIN")) + '/' + program);
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

/// The DEM side in a folder of its own.
std::unique_ptr<BackgroundJob> dem(const std::string& name, const std::string& script, int ranks = 1) {
  const fs::path folder = fs::absolute(name + "_dem");
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "in.dem") << script;
  return std::make_unique<BackgroundJob>(folder.string(),
                                         command("eccentra-dem", {"-in", "in.dem", "-log", "none"}, ranks), "log");
}

BoxCase socket_scene(const std::string& name, int steps) {
  BoxCase box = scene("socket " + address(name) + " wait 60", steps);
  box.coupling = "link socket; address \"" + address(name) + "\"; wait 60;";
  return box;
}

/// `said`: what the DEM side says about how its particles travel; empty: nothing.
void expect_same(const BoxCase& box, const Outcome& reference, const std::string& name, int dem_ranks, int fluid_ranks,
                 const std::string& said = "") {
  const auto particles = dem(name, box.script, dem_ranks);
  const Outcome outcome = run(box, name, fluid_ranks);
  ASSERT_EQ(outcome.status, 0) << outcome.text << particles->text();
  EXPECT_EQ(particles->wait(kStart), 0) << particles->text();
  const bool over_root = particles->text().find("travel over rank 0: ") != std::string::npos;
  EXPECT_EQ(over_root, !said.empty()) << particles->text();
  EXPECT_NE(particles->text().find(said), std::string::npos) << particles->text();
  ASSERT_EQ(outcome.rows.size(), reference.rows.size());
  for (const char* column : {"com_x", "com_y", "com_z", "fastest_particle", "fastest_fluid", "least_fraction",
                             "momentum_x", "momentum_y", "momentum_z", "particles", "time"})
    EXPECT_NEAR(outcome.last(column), reference.last(column), 1e-9) << column;
}

/// A coupled run of two jobs that would go on for long, caught in the middle.
struct LongRun {
  std::unique_ptr<BackgroundJob> particles, fluid;

  explicit LongRun(const std::string& name) {
    BoxCase box = socket_scene(name, 80);
    // A first short run makes the mesh.
    particles = dem(name, box.script);
    const Outcome outcome = run(box, name);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(particles->wait(kStart), 0);
    fs::remove_all(fs::path(outcome.folder) / "postProcessing");
    fs::remove_all(fs::path(outcome.folder) / "0.004");
    fluid = std::make_unique<BackgroundJob>(outcome.folder, command("annulusFoam", {}, 1), "log.long");
    particles = dem(name, scene("socket " + address(name) + " wait 60", 4000000).script);
    EXPECT_TRUE(fluid->says("t 0.02 s", kStart)) << fluid->text() << particles->text();
  }
};

void expect_notice(BackgroundJob& survivor, const std::string& sentence) {
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_TRUE(survivor.says(sentence, kNotice)) << survivor.text();
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(), kNotice);
  const int code = survivor.wait(kNotice);
  EXPECT_NE(code, 0);
  EXPECT_NE(code, -1) << "still runs";
  EXPECT_LT(code, 128) << "died of a signal";
}

} // namespace

TEST(SocketRun, TwoJobsGiveTheResultOfOne) {
  const Outcome reference = run(scene("solver", 800), "one_job");
  ASSERT_EQ(reference.status, 0) << reference.text;
  expect_same(socket_scene("serial", 800), reference, "two_jobs", 1, 1);
  const std::pair<int, int> ranks[] = {{1, 2}, {2, 1}, {3, 2}, {2, 3}};
  for (const auto& [dem_ranks, fluid_ranks] : ranks) {
    const std::string name = "jobs_of_" + std::to_string(dem_ranks) + "_and_" + std::to_string(fluid_ranks);
    expect_same(socket_scene(name, 800), reference, name, dem_ranks, fluid_ranks);
  }
}

TEST(SocketRun, OverRankZeroTheResultIsTheSame) {
  const Outcome reference = run(scene("solver", 400), "one_job_root");
  BoxCase box = scene("socket " + address("root") + " wait 60 lanes no", 400);
  box.coupling = "link socket; address \"" + address("root") + "\"; wait 60;";
  expect_same(box, reference, "over_root", 3, 2, "the script says lanes no");
  std::string longest = "long";
  longest += std::string(sizeof "ipc://" - 1 + 107 - address(longest).size(), 'x');
  expect_same(socket_scene(longest, 400), reference, "longest", 2, 2, "too long to be the beginning");
}

// Spheres in one half of the box only: a rank of DEM has none.
TEST(SocketRun, RankWithoutParticles) {
  const auto half = [](BoxCase box) {
    box.script.replace(box.script.find("fix mud"), 0,
                       "region top block INF INF INF INF 0.025 INF units box\ndelete_atoms region top\n");
    return box;
  };
  const Outcome reference = run(half(scene("solver", 400)), "half");
  ASSERT_EQ(reference.status, 0) << reference.text;
  expect_same(half(socket_scene("half", 400)), reference, "half_of_ranks", 3, 2);
}

TEST(SocketRun, DisagreementIsSaidOnBothSides) {
  BoxCase box = socket_scene("terms", 80);
  box.density = 1200;
  const auto particles = dem("terms", box.script);
  const Outcome outcome = run(box, "terms");
  const std::string sentence = "1000 kg/m3 in fix fluid/force but 1200 kg/m3 in the solver";
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.text.find(sentence), std::string::npos) << outcome.text;
  EXPECT_GT(particles->wait(kStart), 0);
  EXPECT_NE(particles->text().find(sentence), std::string::npos) << particles->text();
}

TEST(SocketRun, ErrorOfTheScriptIsSaidOnBothSides) {
  BoxCase box = socket_scene("length", 80);
  box.script += "run 90\n";
  const auto particles = dem("length", box.script);
  const Outcome outcome = run(box, "length");
  const std::string sentence = "a run of 90 steps is not a whole number of intervals";
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.text.find(sentence), std::string::npos) << outcome.text;
  EXPECT_GT(particles->wait(kStart), 0);
  EXPECT_NE(particles->text().find(sentence), std::string::npos) << particles->text();
}

TEST(SocketRun, FluidThatNeverComes) {
  const auto particles = dem("no_fluid", scene("socket " + address("nobody"), 80).script, 2);
  EXPECT_GT(particles->wait(kNotice + kStart), 0);
  EXPECT_NE(particles->text().find("the fluid side did not come to"), std::string::npos) << particles->text();
}

TEST(SocketRun, ParticlesThatNeverCome) {
  BoxCase box = socket_scene("nobody_either", 80);
  box.coupling += " wait 1;";
  const Outcome outcome = run(box, "no_particles", 2);
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.status, 124) << "hung";
  EXPECT_NE(outcome.text.find("the DEM side did not come to"), std::string::npos) << outcome.text;
}

TEST(SocketRun, KilledFluid) {
  LongRun jobs("killed_fluid");
  jobs.fluid->signal(SIGKILL);
  expect_notice(*jobs.particles, "the fluid side at");
}

TEST(SocketRun, KilledParticles) {
  LongRun jobs("killed_dem");
  jobs.particles->signal(SIGKILL);
  expect_notice(*jobs.fluid, "the DEM side at");
}

TEST(SocketRun, StalledFluid) {
  LongRun jobs("stalled_fluid");
  jobs.fluid->signal(SIGSTOP);
  expect_notice(*jobs.particles, "the fluid side at");
}

TEST(SocketRun, StalledParticles) {
  LongRun jobs("stalled_dem");
  jobs.particles->signal(SIGSTOP);
  expect_notice(*jobs.fluid, "the DEM side at");
}

TEST(SocketRun, AddressOfOtherMachinesIsRefusedOnBothSides) {
  const std::string sentence = "can be reached from other machines, which needs keys";
  const auto particles = dem("open", scene("socket tcp://0.0.0.0:5555", 80).script);
  EXPECT_GT(particles->wait(kStart), 0);
  EXPECT_NE(particles->text().find(sentence), std::string::npos) << particles->text();
  BoxCase box = socket_scene("open", 80);
  box.coupling += "address \"tcp://0.0.0.0:5555\";";
  const Outcome outcome = run(box, "open");
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.text.find(sentence), std::string::npos) << outcome.text;
}
