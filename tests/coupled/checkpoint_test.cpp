// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A run that goes on from a checkpoint gives the digits of the run that was not interrupted; what is damaged is not
// used.
#include "coupled/checkpoint_scene.h"
#include "support/program_output.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr int kCouplingSteps = 24;
constexpr int kSteps = kCouplingSteps * kStepsPerCouplingStep;
/// Checkpoints after 8, 16 and 24 coupling steps; the last two are kept.
const char* const kWords = "solver every 40 checkpoint 8";
constexpr int kMiddle = 16 * kStepsPerCouplingStep;

/// Rows of the table without the columns that tell wall-clock times.
std::string physics_of(const fs::path& folder) {
  std::ifstream in(folder / "postProcessing/eccentra/coupling.csv");
  std::string line, all;
  while (std::getline(in, line)) {
    std::size_t at = 0;
    for (int column = 0; at != std::string::npos; ++column) {
      const std::size_t end = line.find(',', at);
      if (column < 19 || column > 22)
        all += line.substr(at, end == std::string::npos ? end : end - at) + ' ';
      at = end == std::string::npos ? end : end + 1;
    }
    all += '\n';
  }
  return all;
}

ProgramResult again(const fs::path& folder, int ranks = 1) {
  std::vector<std::string> arguments;
  if (ranks > 1)
    arguments = {"mpirun", "--oversubscribe", "--bind-to", "none", "-np", std::to_string(ranks)};
  arguments.push_back(program("annulusFoam"));
  if (ranks > 1)
    arguments.emplace_back("-parallel");
  arguments.emplace_back("-resume");
  ProgramOptions options;
  options.directory = folder;
  return run_program(arguments, options);
}

struct Result {
  std::string bodies, table;
};

Result result_of(const fs::path& folder) {
  return {contents(folder / "end.bodies"), physics_of(folder)};
}

void replace_entry(const fs::path& file, const std::string& part, const std::string& by) {
  std::string text = contents(file);
  ASSERT_NE(text.find(part), std::string::npos) << file;
  std::ofstream(file) << text.replace(text.find(part), part.size(), by);
}

/// Takes away what came after the middle: the run has been killed somewhere there.
void forget_end(const fs::path& folder) {
  fs::remove(folder / "end.bodies");
  fs::remove_all(folder / "checkpoints" / std::to_string(kSteps));
}

void expect_same_digits(const BoxCase& box, const std::string& name, int ranks) {
  const Outcome outcome = run(box, name, ranks);
  ASSERT_EQ(outcome.status, 0) << outcome.text << contents(fs::path(outcome.folder) / "log.liggghts");
  const Result straight = result_of(outcome.folder);
  ASSERT_FALSE(straight.bodies.empty());
  forget_end(outcome.folder);
  const ProgramResult second = again(outcome.folder, ranks);
  ASSERT_EQ(second.status, 0) << second.output << contents(fs::path(outcome.folder) / "log.liggghts");
  EXPECT_NE(second.output.find("goes on from checkpoint " + std::to_string(kMiddle)), std::string::npos)
      << second.output;
  const Result resumed = result_of(outcome.folder);
  EXPECT_EQ(resumed.bodies, straight.bodies);
  EXPECT_EQ(resumed.table, straight.table);
}

} // namespace

TEST(Checkpoint, SpheresGoOnWithTheSameDigits) {
  expect_same_digits(stirred_box(kWords, kSteps, false), "spheres", 1);
}

TEST(Checkpoint, SpheresOnTwoRanksGoOnWithTheSameDigits) {
  expect_same_digits(stirred_box(kWords, kSteps, false), "spheres_ranks", 2);
}

/// LIGGGHTS's own turn to sort, each 620 steps, comes shortly before the step of the checkpoint, 640: the order of the
/// particles, and with it that of all sums, must be the same after it.
TEST(Checkpoint, SpheresThatWereSortedJustBeforeKeepTheirOrder) {
  BoxCase box = stirred_box(kWords, kMiddle + kStepsPerCouplingStep, false);
  box.script.insert(box.script.find("fix floor"), "atom_modify sort 620 0.0002\nneigh_modify every 1 check no\n"
                                                  "dump order all custom 20 order.txt id\n");
  const Outcome outcome = run(box, "sorted_spheres", 1);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const auto order = [&] { // between two exchanges
    const std::string text = contents(fs::path(outcome.folder) / "order.txt");
    const std::size_t begin = text.find("ITEM: TIMESTEP\n660\n");
    return begin == std::string::npos ? "" : text.substr(begin, text.find("ITEM: TIMESTEP", begin + 1) - begin);
  };
  const std::string straight = order();
  ASSERT_FALSE(straight.empty());
  fs::remove_all(fs::path(outcome.folder) / "checkpoints" / std::to_string(kMiddle + kStepsPerCouplingStep));
  const ProgramResult second = again(outcome.folder);
  ASSERT_EQ(second.status, 0) << second.output;
  EXPECT_EQ(order(), straight);
}

TEST(Checkpoint, ClustersAndTheVerdictOfTheScreenGoOnWithTheSameDigits) {
  expect_same_digits(stirred_box(kWords, kSteps, true, true), "clusters", 1);
}

TEST(Checkpoint, ResumableScriptOfSpheresGoesOnWithTheSameDigits) {
  expect_same_digits(stirred_box(kWords, kSteps, false, false, true), "resumable_spheres", 1);
}

TEST(Checkpoint, ResumableScriptOfClustersGoesOnWithTheSameDigits) {
  expect_same_digits(stirred_box(kWords, kSteps, true, true, true), "resumable_clusters", 1);
}

namespace {

/// Turbulence whose eddies move the particles; the box stirs it.
BoxCase turbulent_box() {
  BoxCase box = stirred_box(kWords, kSteps, false);
  box.turbulence = "kEpsilon";
  box.viscosity = 0.01;
  const std::string drag = "drag chien";
  box.script.replace(box.script.find(drag), drag.size(), "drag chien turbulent_dispersion eddy_interaction");
  const std::string mud = "herschel_bulkley 0 0.05 1";
  box.script.replace(box.script.find(mud), mud.size(), "herschel_bulkley 0 0.01 1");
  return box;
}

/// What a checkpoint of two ranks leads to on one and on three. Ranks change the order of sums, and with it the last
/// digits, which contacts carry on.
void expect_round_off(BoxCase box, const std::string& name) {
  constexpr double kRoundOff = 1e-9;
  // Where the linear solvers stop depends on the ranks, too.
  box.tolerance = 1e-14;
  box.coupling += " tolerance 1e-14;";
  const Outcome outcome = run(box, name, 2);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const fs::path folder = outcome.folder;
  const std::vector<double> straight = numbers_in(folder / "end.bodies");
  ASSERT_FALSE(straight.empty());
  const auto expect_same = [&](int ranks) {
    forget_end(folder);
    const ProgramResult second = again(folder, ranks);
    ASSERT_EQ(second.status, 0) << second.output << contents(folder / "log.liggghts");
    EXPECT_NE(second.output.find("goes on from checkpoint " + std::to_string(kMiddle)), std::string::npos);
    EXPECT_NE(second.output.find("2 rank(s) is divided anew among " + std::to_string(ranks)), std::string::npos)
        << second.output;
    const std::vector<double> resumed = numbers_in(folder / "end.bodies");
    ASSERT_EQ(resumed.size(), straight.size());
    for (std::size_t i = 0; i < straight.size(); ++i)
      EXPECT_NEAR(resumed[i], straight[i], kRoundOff * std::max(1.0, std::abs(straight[i]))) << ranks << " ranks";
  };
  // The checkpoint of the middle is written by two ranks; those that the runs below write come after it.
  const fs::path kept = fs::path(folder).concat("_kept");
  fs::remove_all(kept);
  fs::copy(folder / "checkpoints", kept, fs::copy_options::recursive);
  expect_same(1);
  fs::remove_all(folder / "checkpoints");
  fs::copy(kept, folder / "checkpoints", fs::copy_options::recursive);
  replace_entry(folder / "system/decomposeParDict", "numberOfSubdomains 2", "numberOfSubdomains 3");
  replace_entry(folder / "system/decomposeParDict", "(1 1 2)", "(1 1 3)");
  ProgramOptions options;
  options.directory = folder;
  ASSERT_EQ(run_program({"decomposePar", "-force", "-time", "0"}, options).status, 0);
  expect_same(3);
}

} // namespace

TEST(Checkpoint, AnyNumberOfRanksGoesOnToRoundOff) {
  expect_round_off(stirred_box(kWords, kSteps, false), "other_ranks");
}

TEST(Checkpoint, TurbulenceAndItsEddiesGoOnWithTheSameDigits) {
  const BoxCase box = turbulent_box();
  expect_same_digits(box, "turbulent", 1);
  expect_same_digits(box, "turbulent_ranks", 2);
  // The eddies are at work: without them the bodies come elsewhere.
  BoxCase still = box;
  const std::string eddies = " turbulent_dispersion eddy_interaction";
  still.script.erase(still.script.find(eddies), eddies.size());
  const Outcome outcome = run(still, "turbulent_without_eddies");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(result_of(outcome.folder).bodies, result_of("turbulent").bodies);
}

TEST(Checkpoint, TurbulenceOnAnyNumberOfRanksGoesOnToRoundOff) {
  expect_round_off(turbulent_box(), "other_ranks_turbulent");
}

TEST(Checkpoint, DamagedOnesArePassedOver) {
  const Outcome outcome = run(stirred_box(kWords, kSteps, false), "damaged");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const fs::path folder = outcome.folder;
  const Result straight = result_of(folder);
  // As a crash while writing would leave it, or a disk that lies.
  fs::resize_file(folder / "checkpoints" / std::to_string(kSteps) / "dem.restart", 1000);
  fs::create_directories(folder / "checkpoints" / (std::to_string(kSteps + 320) + ".tmp"));
  ProgramResult second = again(folder);
  EXPECT_EQ(second.status, 0) << second.output;
  EXPECT_NE(second.output.find("has 1000 bytes instead of"), std::string::npos) << second.output;
  EXPECT_NE(second.output.find("goes on from checkpoint " + std::to_string(kMiddle)), std::string::npos);
  EXPECT_EQ(result_of(folder).bodies, straight.bodies);
  // And on the fluid's side: one byte.
  std::fstream field(folder / "checkpoints" / ("fluid-" + std::to_string(kSteps)) / "rank0" / "UNow",
                     std::ios::in | std::ios::out);
  field.seekp(2000);
  field.put('#');
  field.close();
  second = again(folder);
  EXPECT_EQ(second.status, 0) << second.output;
  EXPECT_NE(second.output.find("is damaged"), std::string::npos) << second.output;
  EXPECT_EQ(result_of(folder).bodies, straight.bodies);
  EXPECT_EQ(result_of(folder).table, straight.table);
}
