// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The rolling models do not care how many ranks share a scene, nor whether it was restarted; and their plug-in copies
// of stock models are stock's to the last bit.
#include "styles/rolling/rolling_scene.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <random>

using namespace eccentra::test;

namespace {

/// Spheres that fall into a box with walls and a periodic direction, so that pairs sit across ranks and images.
std::string falling_box(RollingScene scene) {
  scene.boundary = "p f f";
  scene.box = "-0.013 0.013 -0.02 0.02 -0.01 0.06";
  scene.timestep = 2e-5;
  scene.gravity = {0.2, 0, -1};
  std::string text = "processors * 1 1\n" + rolling_scene(scene) +
                     wall_line(scene, "front", "primitive type 1 yplane -0.01") +
                     wall_line(scene, "back", "primitive type 1 yplane 0.01");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-2e-4, 2e-4);
  for (int z = 0; z < 4; ++z)
    for (int x = -1; x < 2; ++x)
      for (int y = -1; y < 2; ++y) {
        const double dx = jitter(random);
        const double dy = jitter(random);
        text += sphere_at({x * 7e-3 + dx, y * 6.5e-3 + dy, 4e-3 + z * 6.8e-3});
      }
  return text + spheres_done();
}

using States = std::map<int, std::vector<double>>;

States read_dump(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  States states;
  std::string line;
  while (std::getline(file, line) && line.rfind("ITEM: ATOMS", 0) != 0) {
  }
  int tag = 0;
  while (file >> tag) {
    std::vector<double>& state = states[tag];
    state.resize(9);
    for (double& value : state)
      file >> value;
  }
  return states;
}

const char* const kDump = "dump_modify d format \"%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\n";

std::string dump_line(const std::string& file, long step) {
  return "dump d all custom " + std::to_string(step) + " " + file + " id x y z vx vy vz omegax omegay omegaz\n" + kDump;
}

States run_script(const std::filesystem::path& folder, const std::string& name, const std::string& text, int ranks,
                  const std::string& program = "eccentra-dem") {
  write_file(folder / (name + ".in"), text);
  std::vector<std::string> arguments;
  if (ranks > 1)
    arguments = {"mpirun", "--oversubscribe", "--bind-to", "none", "-np", std::to_string(ranks)};
  arguments.push_back(program == "liggghts" ? program : required_environment("ECCENTRA_BIN") + "/" + program);
  arguments.insert(arguments.end(), {"-in", name + ".in", "-log", "none"});
  ProgramOptions options;
  options.directory = folder;
  const ProgramResult result = run_program(arguments, options);
  EXPECT_EQ(result.status, 0) << result.output;
  return read_dump(folder / (name + ".dump"));
}

double largest_difference(const States& a, const States& b) {
  EXPECT_FALSE(a.empty());
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (const auto& [tag, state] : a) {
    const auto other = b.find(tag);
    if (other == b.end())
      return HUGE_VAL;
    for (std::size_t k = 0; k < state.size(); ++k)
      largest = std::max(largest, std::abs(state[k] - other->second[k]));
  }
  return largest;
}

} // namespace

/// Model and arguments that follow it.
struct ModelWords {
  const char* name;
  const char* model;
  const char* arguments;
  const char* pair_arguments;
  double mu_shape;
  /// What round-off (1e-16 of 1 m/s) may have grown to after 0.04 s. Arms that turn with the bodies let it grow faster.
  double amplified = 1e-9;
};

class Invariance : public ::testing::TestWithParam<ModelWords> {
 protected:
  RollingScene scene() const {
    RollingScene scene;
    scene.model = GetParam().model;
    scene.arguments = GetParam().arguments;
    scene.pair_arguments = GetParam().pair_arguments;
    scene.mu_shape = GetParam().mu_shape;
    return scene;
  }
};

// Not the form directional: its torque jumps with the sign of a spin of round-off size (page of the model).
class RankInvariance : public Invariance {};

// Sums of forces come in another order: round-off, which contacts amplify over 0.04 s.
TEST_P(RankInvariance, OneRankEqualsTwo) {
  const RollingScene scene = this->scene();
  const std::filesystem::path folder = fresh_folder(std::string("ranks_") + GetParam().name);
  const long steps = 2000;
  const auto last = [&](const std::string& name) {
    return falling_box(scene) + "run " + std::to_string(steps - 1) + "\n" + dump_line(name + ".dump", steps) +
           "run 1\n";
  };
  const States one = run_script(folder, "one", last("one"), 1);
  const States two = run_script(folder, "two", last("two"), 2);
  EXPECT_LT(largest_difference(one, two), GetParam().amplified);
}

TEST_P(Invariance, RestartContinues) {
  const RollingScene scene = this->scene();
  const std::filesystem::path folder = fresh_folder(std::string("restart_") + GetParam().name);
  const States through = run_script(folder, "through",
                                    falling_box(scene) + "run 1000\nwrite_restart half.restart\nrun 499\n" +
                                        dump_line("through.dump", 1500) + "run 1\n",
                                    1);
  std::string again = settings(scene);
  again.replace(again.find("boundary f f f"), 14, "boundary p f f");
  RollingScene same = scene;
  same.timestep = 2e-5;
  same.gravity = {0.2, 0, -1};
  const std::string resumed = again + "read_restart half.restart\nneighbor 0.002 bin\nneigh_modify delay 0\n" +
                              materials(same) + forces(same) +
                              wall_line(same, "front", "primitive type 1 yplane -0.01") +
                              wall_line(same, "back", "primitive type 1 yplane 0.01") +
                              "fix integrate all nve/sphere\nrun 499\n" + dump_line("resumed.dump", 1500) + "run 1\n";
  const States after = run_script(folder, "resumed", resumed, 1);
  EXPECT_EQ(largest_difference(through, after), 0);
}

namespace {
const ModelWords kLimited{"limited", "shape", "form limited", "", 0.32};
const ModelWords kSprings{"epsd", "shape", "form epsd", "", 0.32};
const ModelWords kDirectional{"directional", "shape", "form directional", "", 0.32};
const ModelWords kEccentric{"eccentric", "eccentric", "", "shape cube 64", 0, 1e-7};
std::string name_of(const ::testing::TestParamInfo<ModelWords>& info) {
  return info.param.name;
}
} // namespace

INSTANTIATE_TEST_SUITE_P(Models, RankInvariance, ::testing::Values(kLimited, kSprings, kEccentric), name_of);
INSTANTIATE_TEST_SUITE_P(Models, Invariance, ::testing::Values(kLimited, kSprings, kDirectional, kEccentric), name_of);

class StockModels : public ::testing::TestWithParam<const char*> {};

// The same script through the stock program, which dispatches slowly, and with our compiled combination.
TEST_P(StockModels, CompiledEqualsStock) {
  RollingScene scene;
  scene.model = GetParam();
  scene.mu_r = 0.32;
  const std::filesystem::path folder = fresh_folder(std::string("stock_") + GetParam());
  const auto text = [&](const std::string& name) {
    return falling_box(scene) + "run 1999\n" + dump_line(name + ".dump", 2000) + "run 1\n";
  };
  const auto with_coefficients = [&](const std::string& name) {
    std::string script = text(name);
    const std::string extra = "fix m7 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.3\n"
                              "fix m8 all property/global rollingStiffness scalar 2.25\n"
                              "fix m9 all property/global coeffRollingStiffness peratomtypepair 1 0.3\n";
    return script.insert(script.find("pair_style"), extra);
  };
  const States stock = run_script(folder, "stock", with_coefficients("stock"), 1, "liggghts");
  const States ours = run_script(folder, "ours", with_coefficients("ours"), 1);
  EXPECT_EQ(largest_difference(stock, ours), 0);
}

INSTANTIATE_TEST_SUITE_P(Stock, StockModels, ::testing::Values("epsd", "epsd2", "epsd3", "luding"),
                         [](const auto& info) { return std::string(info.param); });
