// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Uneven loads are reported, and fix balance/bodies evens them in coupled runs over both links without changing what
// comes out.
#include "coupled/checkpoint_scene.h"
#include "link/two_jobs.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr int kSteps = 16 * kStepsPerCouplingStep;

/// All bodies lie in the lower half of the box, which is one rank's.
BoxCase heaped(const std::string& link, bool balanced) {
  BoxCase box = stirred_box(link, kSteps, false);
  // Where the linear solvers stop would otherwise depend on the division.
  box.tolerance = 1e-14;
  box.coupling += " tolerance 1e-14;";
  // Balancing lists neighbours anew; where that happens at other steps contacts carry other digits on.
  std::string more = "neigh_modify every 10 delay 0 check no\n";
  if (balanced)
    more += "fix share all balance/bodies every 10 threshold 1.02\n";
  box.script.insert(box.script.find("thermo 400\n"), more);
  return box;
}

/// What a rank of DEM sends in a coupling step; -1 if the run has not said so.
double messages_of_dem(const std::string& text) {
  const std::string words = "sent by a rank in a coupling step, mean: DEM ";
  const auto at = text.find(words);
  return at == std::string::npos ? -1 : std::atof(text.c_str() + at + words.size());
}

/// The number after `arguments` in what the run has printed about its load.
double reported(const std::string& text, const std::string& arguments) {
  const auto line = text.find("rank(s) of DEM in ");
  const auto at = text.find(arguments, line);
  return line == std::string::npos || at == std::string::npos ? -1 : std::atof(text.c_str() + at + arguments.size());
}

void expect_same(const std::vector<double>& bodies, const std::vector<double>& reference) {
  constexpr double kRoundOff = 1e-8;
  ASSERT_FALSE(reference.empty());
  ASSERT_EQ(bodies.size(), reference.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    EXPECT_NEAR(bodies[i], reference[i], kRoundOff * std::max(1.0, std::abs(reference[i])));
}

} // namespace

TEST(Load, BalancingKeepsWorkingInCoupledRunsAndIsReported) {
  const Outcome uneven = run(heaped("solver every 40", false), "uneven", 2);
  ASSERT_EQ(uneven.status, 0) << uneven.text;
  EXPECT_NEAR(reported(uneven.text, "particles "), 2.0, 0.1) << uneven.text;
  // Seconds depend on what else the machine does: the busiest over the mean is there, and at least 1.
  EXPECT_GE(reported(uneven.text, "computing "), 1.0) << uneven.text;
  EXPECT_NE(uneven.text.find("cells 1.000"), std::string::npos) << uneven.text;
  // Who has no body near the plane sends nothing but that it has none, where neighbours are listed anew: every ten
  // steps.
  EXPECT_GT(messages_of_dem(uneven.text), kStepsPerCouplingStep / 10) << uneven.text;
  EXPECT_LT(messages_of_dem(uneven.text), kStepsPerCouplingStep) << uneven.text;
  const std::vector<double> reference = numbers_in(uneven.folder + "/end.bodies");

  const Outcome even = run(heaped("solver every 40", true), "even", 2);
  ASSERT_EQ(even.status, 0) << even.text;
  EXPECT_LT(reported(even.text, "particles "), 1.5) << even.text;
  // With bodies on both sides of it their places go over in each step; 16 of 17 coupling steps end an interval.
  EXPECT_GT(messages_of_dem(even.text), kSteps / 17.0) << even.text;
  expect_same(numbers_in(even.folder + "/end.bodies"), reference);

  const std::string address = socket_address("balance");
  BoxCase box = heaped("socket " + address + " every 40 wait 60", true);
  box.coupling += " link socket; address \"" + address + "\"; wait 60;";
  const fs::path folder = fs::absolute("balance_dem");
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "in.dem") << box.script;
  BackgroundJob particles(folder.string(), command("eccentra-dem", {"-in", "in.dem", "-log", "none"}, 2), "log.dem");
  const Outcome fluid = run(box, "even_socket", 1); // it tells of the ranks of DEM all the same
  EXPECT_EQ(particles.wait(kStart), 0) << particles.text();
  ASSERT_EQ(fluid.status, 0) << fluid.text;
  // Both sides tell.
  for (const std::string& text : {fluid.text, particles.text()})
    EXPECT_LT(std::abs(reported(text, "particles ") - reported(even.text, "particles ")), 0.05) << text;
  EXPECT_NEAR(messages_of_dem(fluid.text), messages_of_dem(even.text), 0.1 * messages_of_dem(even.text)) << fluid.text;
  expect_same(numbers_in(folder / "end.bodies"), reference);
}
