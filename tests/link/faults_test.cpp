// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two jobs and what may befall them: each is noticed, said in one sentence, and what was reached is not lost.
#include "coupled/checkpoint_scene.h"
#include "link/two_jobs.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr int kEvery = 8; ///< coupling steps from one checkpoint to the next
constexpr int kCouplingSteps = 120;

BoxCase two_job_scene(const std::string& name, int steps, const std::string& more = "") {
  BoxCase box = stirred_box("socket " + socket_address(name) + " every 40 checkpoint " + std::to_string(kEvery) +
                                " wait 60" + more,
                            steps, false);
  box.coupling += "link socket; address \"" + socket_address(name) + "\"; wait 60;";
  return box;
}

constexpr int kSteps = kCouplingSteps * kStepsPerCouplingStep;

/// A coupled run that is caught in its middle. The DEM side runs in the case's folder, too.
struct Jobs {
  std::string folder;
  int fluid_ranks = 1;
  std::unique_ptr<BackgroundJob> particles, fluid;

  explicit Jobs(const std::string& name, int steps = 100 * kSteps) {
    // A mesh is made by a first run, which ends at once for want of a DEM side.
    BoxCase box = two_job_scene(name, steps);
    const std::string patient = box.coupling;
    box.coupling += " wait 0.01;";
    folder = run(box, name).folder;
    replace_in(folder + "/constant/couplingProperties", "wait 0.01;", "");
    fs::remove_all(folder + "/postProcessing");
  }
  /// The fluid side then has two ranks.
  void decompose() {
    BackgroundJob divide(folder, {"decomposePar", "-force"}, "log.decompose");
    ASSERT_EQ(divide.wait(kStart), 0) << divide.text();
    fluid_ranks = 2;
  }
  void start(const std::vector<std::string>& more = {}, int ranks = 1) {
    std::vector<std::string> fluid_arguments = more;
    if (fluid_ranks > 1)
      fluid_arguments.push_back("-parallel");
    fluid = std::make_unique<BackgroundJob>(folder, command("annulusFoam", fluid_arguments, fluid_ranks), "log.fluid");
    std::vector<std::string> arguments = {"-in", "in.dem", "-log", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    // Another number of ranks on one side only.
    particles = std::make_unique<BackgroundJob>(folder, command("eccentra-dem", arguments, ranks), "log.dem");
  }
  /// Once some checkpoints are there.
  void wait_for_middle() {
    const auto begun = std::chrono::steady_clock::now();
    while (eccentra::link::numbered_entries(folder + "/checkpoints", "").size() < 2) {
      ASSERT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(60))
          << fluid->text() << particles->text();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  /// Both end within the time that the issue allows, not by a signal; both say `part`.
  void expect_end(const std::string& of_fluid, const std::string& of_particles) {
    const auto begun = std::chrono::steady_clock::now();
    for (BackgroundJob* job : {fluid.get(), particles.get()}) {
      const int code = job->wait(kNotice);
      EXPECT_NE(code, 0);
      EXPECT_NE(code, -1) << "still runs";
    }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(), kNotice);
    EXPECT_NE(fluid->text().find(of_fluid), std::string::npos) << fluid->text();
    EXPECT_NE(particles->text().find(of_particles), std::string::npos) << particles->text();
  }
  void expect_done() {
    EXPECT_EQ(particles->wait(kStart), 0) << particles->text();
    EXPECT_EQ(fluid->wait(kStart), 0) << fluid->text();
  }
};

/// The end of a run that nobody interrupts, from one job.
std::string undisturbed() {
  static const std::string bodies = [] {
    const Outcome outcome =
        run(stirred_box("solver every 40 checkpoint " + std::to_string(kEvery), kSteps, false), "undisturbed");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return contents(outcome.folder + "/end.bodies");
  }();
  return bodies;
}

void expect_stop_by(int signal, const char* name, bool to_fluid) {
  Jobs jobs(std::string("stop_") + name);
  jobs.start();
  jobs.wait_for_middle();
  (to_fluid ? jobs.fluid : jobs.particles)->signal(signal);
  const std::string sentence = std::string(name) + " asked to stop: checkpoint ";
  jobs.expect_end(sentence, sentence);
  // What it wrote is whole.
  jobs.start({"-resume"});
  EXPECT_TRUE(jobs.particles->says("goes on from checkpoint", kStart));
  EXPECT_TRUE(jobs.fluid->says(" %  left", kStart)) << jobs.fluid->text() << jobs.particles->text();
  EXPECT_EQ(jobs.particles->text().find("passed over"), std::string::npos) << jobs.particles->text();
}

} // namespace

TEST(Faults, SigtermToTheParticles) {
  expect_stop_by(SIGTERM, "SIGTERM", false);
}

TEST(Faults, SigintToTheFluid) {
  expect_stop_by(SIGINT, "SIGINT", true);
}

TEST(Faults, WarningOfABatchSystemToTheFluid) {
  expect_stop_by(SIGUSR1, "SIGUSR1", true);
}

TEST(Faults, RunKilledAtRandomMomentsEndsAsIfNothingHadBeen) {
  Jobs jobs("killed", kSteps);
  std::mt19937 random(std::random_device{}());
  std::uniform_real_distribution<double> moment(0.3, 1.5);
  const char* const asked = std::getenv("ECCENTRA_KILLS");
  const int kills = asked ? std::atoi(asked) : 3;
  for (int kill = 0; kill < kills; ++kill) {
    jobs.start({"-resume"});
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    (kill % 2 ? jobs.fluid : jobs.particles)->signal(SIGKILL);
    jobs.particles->wait(kNotice);
    jobs.fluid->wait(kNotice);
  }
  jobs.start({"-resume"});
  jobs.expect_done();
  EXPECT_EQ(contents(jobs.folder + "/end.bodies"), undisturbed());
}

TEST(Faults, FullDiskOfTheParticles) {
  Jobs jobs("full");
  jobs.start();
  jobs.wait_for_middle();
  jobs.particles->limit_files(8192);
  jobs.expect_end("cannot write", "cannot write");
}

TEST(Faults, FullDiskOfTheFluid) {
  Jobs jobs("full_fluid");
  jobs.start();
  jobs.wait_for_middle();
  jobs.fluid->limit_files(8192);
  // Its own arguments do not fit on the disk either.
  jobs.expect_end("", "cannot write");
  // What was there before is whole.
  jobs.start({"-resume"});
  EXPECT_TRUE(jobs.fluid->says(" %  left", kStart)) << jobs.fluid->text() << jobs.particles->text();
  EXPECT_EQ(jobs.particles->text().find("passed over"), std::string::npos) << jobs.particles->text();
}

TEST(Faults, FluidThatBlowsUp) {
  Jobs jobs("overflow");
  std::ofstream(jobs.folder + "/constant/flowProperties")
      << "FoamFile { version 2.0; format ascii; class dictionary; object flowProperties; }\n"
         "drive { type pressureGradient; gradient 1e300; direction (1 0 0); }\n";
  jobs.start();
  EXPECT_TRUE(jobs.fluid->says("has blown up", kStart)) << jobs.fluid->text();
  jobs.expect_end("has blown up", "the fluid side");
}

TEST(Faults, ParticlesThatBlowUp) {
  Jobs jobs("nan");
  replace_in(jobs.folder + "/in.dem", "timestep 5e-5\nfix floor",
             "timestep 5e-5\nfix mad all addforce 1e280 0 0\nfix floor");
  jobs.start();
  EXPECT_NE(jobs.particles->wait(kStart), 0);
  EXPECT_NE(jobs.particles->code(), -1) << "hung";
  EXPECT_GT(jobs.fluid->wait(kNotice), 0) << jobs.fluid->text();
}

TEST(Faults, LostRankOfTheParticles) {
  Jobs jobs("rank");
  jobs.start({}, 2);
  jobs.wait_for_middle();
  const int rank = jobs.particles->child();
  ASSERT_GT(rank, 0);
  ::kill(rank, SIGKILL);
  jobs.expect_end("the DEM side at", "signal 9");
}

// Ranks that wait on connections of their own end with the others, also where those wait for somebody else.
TEST(Faults, LostRankOfManyOnBothSides) {
  for (const bool of_fluid : {false, true}) {
    Jobs jobs(of_fluid ? "rank_fluid" : "rank_dem");
    jobs.decompose();
    jobs.start({}, 3);
    jobs.wait_for_middle();
    const int rank = (of_fluid ? jobs.fluid : jobs.particles)->child(1);
    ASSERT_GT(rank, 0);
    ::kill(rank, SIGKILL);
    jobs.expect_end(of_fluid ? "signal 9" : "the DEM side", of_fluid ? "the fluid side" : "signal 9");
  }
}

TEST(Faults, StalledRankOfTheFluid) {
  Jobs jobs("stalled_rank");
  jobs.decompose();
  jobs.start({}, 3);
  jobs.wait_for_middle();
  const int rank = jobs.fluid->child(1);
  ASSERT_GT(rank, 0);
  ::kill(rank, SIGSTOP);
  // The rank of DEM whose samples that one owes notices.
  EXPECT_TRUE(jobs.particles->says("has gone", kNotice)) << jobs.particles->text();
  EXPECT_GT(jobs.particles->wait(kNotice), 0);
  ::kill(rank, SIGCONT);
  EXPECT_GT(jobs.fluid->wait(kNotice), 0) << jobs.fluid->text();
}

TEST(Faults, SignalToManyRanksEndsAllAndTheyGoOn) {
  Jobs jobs("stop_ranks");
  jobs.decompose();
  jobs.start({}, 3);
  jobs.wait_for_middle();
  ::kill(jobs.particles->child(1), SIGTERM);
  const std::string sentence = "SIGTERM asked to stop: checkpoint ";
  jobs.expect_end(sentence, sentence);
  jobs.start({"-resume"}, 2);
  EXPECT_TRUE(jobs.fluid->says(" %  left", kStart)) << jobs.fluid->text() << jobs.particles->text();
}

// Another order of sums: the difference of round-off that collisions have made grow over 320 steps.
TEST(Faults, ParticlesGoOnOnOtherRanks) {
  Jobs jobs("ranks", kSteps);
  jobs.start();
  jobs.expect_done();
  const std::vector<double> straight = numbers_in(jobs.folder + "/end.bodies");
  fs::remove(jobs.folder + "/end.bodies");
  fs::remove_all(jobs.folder + "/checkpoints/" + std::to_string(kSteps));
  jobs.start({"-resume"}, 2);
  jobs.expect_done();
  const std::vector<double> resumed = numbers_in(jobs.folder + "/end.bodies");
  ASSERT_GT(straight.size(), 300u);
  ASSERT_EQ(resumed.size(), straight.size());
  for (std::size_t i = 0; i < straight.size(); ++i)
    EXPECT_NEAR(resumed[i], straight[i], 1e-8 * std::max(1.0, std::abs(straight[i])));
}

TEST(Faults, OneRanksCheckpointGoesOnInTwoJobsWithTheSameDigits) {
  Jobs jobs("digits", kSteps);
  jobs.start();
  jobs.expect_done();
  EXPECT_EQ(contents(jobs.folder + "/end.bodies"), undisturbed());
  fs::remove(jobs.folder + "/end.bodies");
  fs::remove_all(jobs.folder + "/checkpoints/" + std::to_string(kSteps));
  jobs.start({"-resume"});
  jobs.expect_done();
  EXPECT_EQ(contents(jobs.folder + "/end.bodies"), undisturbed());
}
