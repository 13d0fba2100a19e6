// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Not a test: what each model costs per contact in a settled bed of cubes, and against hertz with history in blocks.
//   ECCENTRA_BENCHMARK="cube 27 turns 5 steps 1000 only TEXT" build/tests/contact_models_benchmark
// The models take turns, so that a machine that is slow for a while is slow for all; the ratio is the median of the
// turns' ratios. `only` chooses the models that contain TEXT; with `turns 0` they run once for callgrind.
#include "styles/pairs/all_materials.h"
#include "support/granular_script.h"

#include "timer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>

using namespace eccentra;
using namespace eccentra::test;

namespace {

struct Chosen {
  std::string cube = "27";
  int turns = 5, steps = 1000;
  std::string only;
} chosen;

constexpr int kBodies = 100;
constexpr const char* kBlocks = "model hertz tangential history";

std::vector<std::string> models() {
  std::vector<std::string> all = {kBlocks, "model hertz tangential history limitForce on"};
  const auto add = [&all](const std::string& words) {
    if (std::find(all.begin(), all.end(), words) == all.end() && words.find(chosen.only) != std::string::npos)
      all.push_back(words);
  };
  for (const std::string& normal : known("model"))
    if (normal != "off" && normal != "hertz")
      add("model " + normal + " tangential history");
  for (const std::string& tangential : known("tangential"))
    if (tangential != "tan_luding" && tangential != "history")
      add("model hooke tangential " + tangential);
  for (const char* form : {"limited", "directional", "epsd"})
    add(std::string("model hertz tangential history rolling_friction shape form ") + form);
  for (const std::string& rolling : known("rolling_friction"))
    if (rolling != "off" && rolling != "eccentric" && rolling != "shape" && rolling != "luding")
      add("model hertz tangential history rolling_friction " + rolling);
  for (const std::string& cohesion : known("cohesion"))
    if (cohesion != "off")
      add("model hertz tangential history cohesion " + cohesion);
  return all;
}

/// A bed of cubes under a model, at rest.
class Bed {
 public:
  explicit Bed(const std::string& words) {
    session_.script("atom_style granular\natom_modify map array\nboundary p p f\nnewton off\n"
                    "communicate single vel yes\nunits si\nregion box block 0 0.036 0 0.036 -0.01 0.12 units box\n"
                    "create_box 1 box\n" +
                    granular_material({5e6, 0.5, 0.5, 0.3}));
    std::map<std::string, std::string> given;
    if (words.find("thornton_ning") != std::string::npos) // adhesive contacts that let go fast are no numbers there
      given = {{"surfaceEnergy", "0"}};
    if (words.find("hertz/stiffness") != std::string::npos) // kn is a modulus [Pa]
      given = {{"kn", "4e6"}, {"kt", "4e6"}, {"gamman", "3e6"}, {"gammat", "1e6"}};
    give_materials(session_, given);
    session_.script("pair_style gran/cluster " + words +
                    "\npair_coeff * *\nfix weight all gravity 9.81 vector 0 0 -1\n" +
                    "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0\n"
                    "fix integrate all nve/cluster\ntimestep 2e-5\n");
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, 1);
    const auto cube = shape_of("cube", chosen.cube);
    for (int n = 0; n < kBodies; ++n) {
      Start start;
      start.position = 9e-3 * Eigen::Vector3d(n % 4 + 0.5, n / 4 % 4 + 0.5, n / 16 + 0.7);
      start.orientation =
          Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
      add_body(session_, cube, start);
    }
    session_.command("run 15000");
  }
  /// Seconds in the pair style over so many steps.
  double time(int steps) {
    session_.command("run " + std::to_string(steps));
    contacts_ = session_.lammps().modify->find_fix_id("cluster_history")->compute_scalar();
    return session_.lammps().timer->array[TIME_PAIR];
  }
  double contacts() const { return contacts_; }

 private:
  LiggghtsSession session_;
  double contacts_ = 0;
};

void read_arguments() {
  const char* text = std::getenv("ECCENTRA_BENCHMARK");
  std::istringstream words(text ? text : "");
  for (std::string name, value; words >> name >> value;)
    if (name == "cube")
      chosen.cube = value;
    else if (name == "turns")
      chosen.turns = std::stoi(value);
    else if (name == "steps")
      chosen.steps = std::stoi(value);
    else if (name == "only")
      chosen.only = value;
}

} // namespace

TEST(Benchmark, EachModelPerContact) {
  read_arguments();
  const std::vector<std::string> all = models();
  if (chosen.turns == 0) {
    Bed bed(chosen.only.empty() ? kBlocks : all.back());
    bed.time(chosen.steps);
    std::printf("%s: %.0f contacts, %d steps\n", chosen.only.c_str(), bed.contacts(), chosen.steps);
    return;
  }
  std::vector<std::unique_ptr<Bed>> beds;
  for (const std::string& words : all)
    beds.push_back(std::make_unique<Bed>(words));
  std::vector<std::vector<double>> each(all.size()), ratio(all.size());
  for (int turn = 0; turn < chosen.turns; ++turn)
    for (std::size_t k = 0; k < all.size(); ++k) {
      each[k].push_back(1e9 * beds[k]->time(chosen.steps) / chosen.steps / beds[k]->contacts());
      ratio[k].push_back(each[k].back() / each[0].back());
    }
  const auto median = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  std::printf("| model | contacts per body | ns per contact | of hertz in blocks |\n|---|---|---|---|\n");
  for (std::size_t k = 0; k < all.size(); ++k)
    std::printf("| %s | %.2f | %.0f | %.2f |\n", all[k].c_str(), beds[k]->contacts() / kBodies, median(each[k]),
                median(ratio[k]));
}
