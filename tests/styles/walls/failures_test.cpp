// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bad wall lines: one sentence that names the word, its value and the remedy.
#include "styles/walls/wall_arguments.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

using eccentra::styles::read_wall_arguments;

namespace {

std::string sentence_for(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> arguments;
  for (std::string word; stream >> word;)
    arguments.push_back(word);
  try {
    read_wall_arguments(arguments);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "accepted";
}

void expect_names(const std::string& line, const std::string& part) {
  const std::string sentence = sentence_for(line);
  EXPECT_NE(sentence.find(part), std::string::npos) << line << " -> " << sentence;
}

const std::string kModel = "model hertz tangential history ";

} // namespace

TEST(WallArguments, GoodLinesAreRead) {
  EXPECT_EQ(sentence_for(kModel + "primitive type 1 zcylinder 0.02 0 0 rotate 5.2"), "accepted");
  EXPECT_EQ(sentence_for(kModel + "rolling_friction cdt torsionTorque on contacts shared primitive type 1 xplane 0"),
            "accepted");
  EXPECT_EQ(sentence_for(kModel + "mesh n_meshes 2 meshes a b"), "accepted");
  EXPECT_EQ(sentence_for(kModel + "rolling_friction shape primitive type 1 xplane 0 form epsd torsionTorque off"),
            "accepted");
}

TEST(WallArguments, BadLinesAreNamed) {
  expect_names("model hookes tangential history primitive type 1 xplane 0", "'hookes'");
  expect_names(kModel, "no wall is given");
  expect_names(kModel + "primitive type 1 zcylinder 0.02 0", "the line ends");
  expect_names(kModel + "primitive type 1 zcylinder -0.02 0 0", "greater than 0 for the radius");
  expect_names(kModel + "primitive type 1 zcylinder 0.02m 0 0", "'0.02m'");
  expect_names(kModel + "primitive type 1 zcylinder nan 0 0", "'nan'");
  expect_names(kModel + "primitive type 0 xplane 0", "at least 1");
  expect_names(kModel + "primitive type 1 cone 0", "'cone'");
  expect_names(kModel + "primitive type 1 plane 0 0 0 0 0 0", "length 0");
  expect_names(kModel + "primitive type 1 zplane 0 velocity 0 0 1", "away from its place");
  expect_names(kModel + "rolling_friction epsdd primitive type 1 xplane 0", "'epsdd'");
  expect_names(kModel + "contacts sharde primitive type 1 xplane 0", "'sharde'");
  expect_names(kModel + "primitive type 1 xplane 0 turn 5", "'turn'");
  expect_names(kModel + "primitive type 1 xplane 0 shear x 5", "rotate OMEGA");
  expect_names(kModel + "rolling_friction shape form epsdd primitive type 1 xplane 0", "'epsdd'");
  expect_names(kModel + "damping none primitive type 1 xplane 0", "'none'");
  expect_names(kModel + "primitive type 1 xplane 0 mesh n_meshes 1 meshes a", "one wall per fix");
}
