// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong input of a coupled case: one sentence that names it, and an exit code that is not zero, on one rank and on two.
#include "coupled/coupled_case.h"

#include <gtest/gtest.h>

namespace {

using namespace eccentra::test;

BoxCase one_sphere() {
  BoxCase box;
  box.script = script_head(box, 5e-5) +
               "create_atoms 1 single 0.03 0.03 0.03 units box\nset group all diameter 6.35e-3 density 2619\n"
               "fix mud all fluid/force rheology herschel_bulkley 0 0.01 1 density 1000 drag chien\n"
               "fix flow all fluid/couple link solver every 40\nrun 80\n";
  return box;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_refusal(const BoxCase& box, const std::string& name, const std::string& part, int ranks = 1) {
  const Outcome outcome = run(box, name, ranks);
  EXPECT_NE(outcome.status, 0) << name;
  EXPECT_NE(outcome.status, 124) << name << " hung";
  EXPECT_NE(outcome.text.find(part), std::string::npos) << name << " said:\n" << outcome.text;
}

} // namespace

TEST(CoupledRefusals, TheSceneItselfRuns) {
  const Outcome outcome = run(one_sphere(), "fine");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.rows.size(), 3u);
}

TEST(CoupledRefusals, StepsThatDoNotFit) {
  BoxCase box = one_sphere();
  box.step = 3e-3;
  const std::string sentence = "40 DEM steps of 5e-05 s make 0.002 s but the fluid step (deltaT) is 0.003 s";
  expect_refusal(box, "steps", sentence);
  expect_refusal(box, "steps2", sentence, 2);
}

TEST(CoupledRefusals, RunThatIsNoWholeNumberOfIntervals) {
  BoxCase box = one_sphere();
  box.script = replaced(box.script, "run 80", "run 90");
  expect_refusal(box, "run", "a run of 90 steps is not a whole number of intervals of 40");
}

TEST(CoupledRefusals, EddiesOfALaminarFlow) {
  BoxCase box = one_sphere();
  box.script = replaced(box.script, "drag chien", "drag chien turbulent_dispersion eddy_interaction");
  expect_refusal(box, "eddies", "turbulent_dispersion of fix fluid/force needs the turbulence of the flow");
  box.turbulence = "kEpsilon";
  const Outcome outcome = run(box, "eddies_of_a_model");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("asked for velocity fraction turbulence;"), std::string::npos) << outcome.text;
}

TEST(CoupledRefusals, DensityOfAnotherFluid) {
  BoxCase box = one_sphere();
  box.density = 1200;
  expect_refusal(box, "density", "1000 kg/m3 in fix fluid/force but 1200 kg/m3 in the solver");
}

TEST(CoupledRefusals, BoxOfAnotherLength) {
  BoxCase box = one_sphere();
  box.script = replaced(box.script, "0 0.06 units", "0 0.07 units");
  expect_refusal(box, "length",
                 "the periodic direction z spans 0 to 0.07 m in the DEM script but 0 to 0.06 m in the mesh");
}

TEST(CoupledRefusals, ScriptWithoutACouplingStep) {
  BoxCase box = one_sphere();
  box.script = replaced(box.script, "fix flow all fluid/couple link solver every 40", "");
  box.script = replaced(box.script, "fix mud", "#");
  expect_refusal(box, "nobody", "never ran a fix fluid/couple");
}

TEST(CoupledRefusals, WrongWordsOfTheFix) {
  BoxCase box = one_sphere();
  box.script = replaced(box.script, "every 40", "every 0");
  expect_refusal(
      box, "every",
      "keyword 'every': '0' is not whole, too small or too large; expected a whole number of DEM steps of at least 1");
  box = one_sphere();
  box.script = replaced(box.script, "link solver", "link solved");
  expect_refusal(box, "word", "keyword 'link': 'solved' is unknown; expected solver or socket");
}

TEST(CoupledRefusals, WrongWordsOfTheDictionary) {
  BoxCase box = one_sphere();
  box.coupling = "voidFraction centred;";
  expect_refusal(box, "method", "voidFraction 'centred' is unknown");
  box.coupling = "momentum implicit;";
  expect_refusal(box, "momentum", "momentum is implicit: use semiImplicit or explicit");
  box.coupling = "smoothing 3;";
  expect_refusal(box, "keyword", "unknown keyword smoothing");
}

TEST(CoupledRefusals, MissingScript) {
  BoxCase box = one_sphere();
  box.coupling = "demScript \"in.other\";";
  expect_refusal(box, "script", "in.other");
}
