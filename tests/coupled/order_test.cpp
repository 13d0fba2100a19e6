// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// In which order LIGGGHTS keeps its particles is nothing that a coupled run may depend on.
#include "coupled/checkpoint_scene.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace eccentra::test;

constexpr int kCouplingSteps = 5;

struct Bodies {
  const char* name;
  bool clusters;
  const char* rolling; ///< words behind rolling_friction of pairs and walls
  const char* pair;    ///< further words of the pairs
};

void replace_all(std::string& text, const std::string& part, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += by.size())
    text.replace(at, part.size(), by);
}

/// The fluid comes to bodies that have been in a run without it, as after pouring.
BoxCase box_of(const Bodies& bodies, const std::string& sorting) {
  BoxCase box = stirred_box("solver every 40", kCouplingSteps * kStepsPerCouplingStep, bodies.clusters);
  const std::string friction = std::string("tangential history rolling_friction ") + bodies.rolling;
  replace_all(box.script, "tangential history primitive", friction + " primitive");
  replace_all(box.script, "tangential history\n", friction + " " + bodies.pair + "\n");
  box.script.insert(box.script.find("fix m1"),
                    "fix m5 all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
                    "fix m6 all property/global shapeRollingFriction peratomtypepair 1 0.3\n");
  box.script.insert(box.script.find("fix mud"), "run 0\natom_modify sort " + sorting + "\n");
  return box;
}

std::vector<double> end_of(const Bodies& bodies, const std::string& name, const std::string& sorting) {
  const Outcome outcome = run(box_of(bodies, sorting), std::string(bodies.name) + name);
  EXPECT_EQ(outcome.status, 0) << outcome.text << contents(std::filesystem::path(outcome.folder) / "log.liggghts");
  const std::string text = contents(std::filesystem::path(outcome.folder) / "end.bodies");
  const std::string head = "omegaz";
  std::istringstream in(text.substr(std::min(text.size(), text.find(head) + head.size())));
  std::vector<double> values;
  for (double value = 0; in >> value;)
    values.push_back(value);
  return values;
}

} // namespace

class ParticleOrder : public ::testing::TestWithParam<Bodies> {};

// Sums come in another order, which contacts amplify (to 1e-12). The samples of other particles change spins by 0.02 to
// 3 rad/s.
TEST_P(ParticleOrder, ChangesRoundOffAlone) {
  const std::vector<double> kept = end_of(GetParam(), "_kept", "0 0.0002");
  const std::vector<double> sorted = end_of(GetParam(), "_sorted", "40 0.0002");
  constexpr std::size_t bodies = 32, columns = 10;
  ASSERT_EQ(kept.size(), bodies * columns);
  ASSERT_EQ(sorted.size(), kept.size());
  double largest = 0;
  for (std::size_t k = 0; k < kept.size(); ++k)
    largest = std::max(largest, std::abs(kept[k] - sorted[k]));
  EXPECT_LT(largest, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Coupled, ParticleOrder,
                         ::testing::Values(Bodies{"spheres", false, "off", ""}, Bodies{"limited", false, "shape", ""},
                                           Bodies{"eccentric", false, "eccentric", "shape cube 8"},
                                           Bodies{"clusters", true, "off", ""},
                                           Bodies{"clusters_limited", true, "shape", ""}),
                         [](const auto& info) { return std::string(info.param.name); });
