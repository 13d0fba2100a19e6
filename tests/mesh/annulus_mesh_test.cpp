// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The bipolar grid, and annulusMesh as a user calls it.
#include "flow/flow_case.h"
#include "mesh/annulus_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace eccentra::test {
namespace {

using mesh::AnnulusSection;
using mesh::GridOptions;
using mesh::WallVertices;

constexpr double kHole = 0.0635, kPipe = 0.02413;

std::string mesh_program() {
  return std::string(std::getenv("ECCENTRA_BIN")) + "/annulusMesh";
}

double ring_area(const std::vector<std::array<double, 2>>& points, size_t ring, size_t around) {
  double twice = 0;
  for (size_t j = 0; j < around; ++j) {
    const auto &p = points[ring * around + j], &q = points[ring * around + (j + 1) % around];
    twice += p[0] * q[1] - q[0] * p[1];
  }
  return twice / 2;
}

TEST(AnnulusGrid, WallsAreCirclesOfTheRightCentreAndArea) {
  for (const double e : {0.0, 1e-4, 0.3, 0.5, 0.8, 0.95}) {
    const AnnulusSection section{kHole, kPipe, e};
    const auto on_circle = mesh::annulus_points(section, {8, 48, 1, WallVertices::kOnCircle});
    ASSERT_EQ(on_circle.size(), 9u * 48u);
    for (size_t j = 0; j < 48; ++j) {
      EXPECT_NEAR(std::hypot(on_circle[j][0], on_circle[j][1] + section.offset()), kPipe, 1e-9) << "e " << e;
      EXPECT_NEAR(std::hypot(on_circle[8 * 48 + j][0], on_circle[8 * 48 + j][1]), kHole, 1e-9) << "e " << e;
    }
    const auto equal_area = mesh::annulus_points(section, {8, 48, 1, WallVertices::kEqualArea});
    EXPECT_NEAR(ring_area(equal_area, 8, 48) - ring_area(equal_area, 0, 48), section.area(), 1e-12 * section.area());
  }
}

TEST(AnnulusGrid, GradingWidensTheMiddle) {
  const auto points = mesh::annulus_points({kHole, kPipe, 0}, {9, 8, 4, WallVertices::kOnCircle});
  const auto radius = [&](size_t i) { return std::hypot(points[i * 8][0], points[i * 8][1]); };
  const double wall = radius(1) - radius(0), middle = radius(5) - radius(4), other = radius(9) - radius(8);
  EXPECT_NEAR(middle / wall, 4, 1e-9);
  EXPECT_NEAR(other / wall, 1, 1e-9);
}

/// Number that follows the last occurrence of these arguments.
double number_after(const std::string& text, const std::string& arguments) {
  const size_t at = text.find(arguments);
  return at == std::string::npos ? NAN : std::atof(text.c_str() + at + arguments.size());
}

TEST(AnnulusMesh, QualityAndVolumeAtEveryEccentricity) {
  for (const double e : {0.0, 0.5, 0.8, 0.95}) {
    FlowCase flow_case("mesh");
    flow_case.annulus_mesh(e, 12, 48, 4, 0.3);
    const Outcome made = run_program(flow_case.folder(), mesh_program());
    ASSERT_EQ(made.exit_code, 0) << made.text;
    EXPECT_LT(number_after(made.text, "largest non-orthogonality "), e > 0.8 ? 6 : 2) << made.text;
    EXPECT_NEAR(number_after(made.text, "  volume "), 0.3 * M_PI * (kHole * kHole - kPipe * kPipe), 1e-9);
    const Outcome checked = run_program(flow_case.folder(), "checkMesh");
    EXPECT_NE(checked.text.find("Mesh OK."), std::string::npos) << checked.text;
  }
}

TEST(AnnulusMesh, GravityLeansTowardsTheLowSide) {
  FlowCase flow_case("gravity");
  flow_case.dictionary("system/annulusMeshDict", "holeRadius 0.0635; pipeRadius 0.02413; eccentricity 0.5; length 1.2; "
                                                 "inclination 80; cells (6 24 8); ends inletOutlet;");
  ASSERT_EQ(run_program(flow_case.folder(), mesh_program()).exit_code, 0);
  std::ifstream file(flow_case.folder() + "/constant/g");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  double x, y, z;
  const size_t at = text.rfind("(");
  ASSERT_EQ(std::sscanf(text.c_str() + at, "(%lf %lf %lf)", &x, &y, &z), 3) << text;
  EXPECT_EQ(x, 0);
  EXPECT_NEAR(y, -9.81 * std::sin(80 * M_PI / 180), 1e-6);
  EXPECT_NEAR(z, -9.81 * std::cos(80 * M_PI / 180), 1e-6);
}

TEST(AnnulusMesh, RefusesWithOneSentence) {
  const std::string good = "holeRadius 0.0635; pipeRadius 0.02413; length 0.3; cells (6 24 4); ends periodic; ";
  const struct {
    std::string body, keyword;
  } bad[] = {{good + "eccentricity 1;", "eccentricity"},
             {good + "eccentricity -0.1;", "eccentricity"},
             {good + "eccentricity nan;", "eccentricity"},
             {good + "eccentricity 0.5; pipeRadius 0.07;", "pipeRadius"},
             {good + "eccentricity 0.5; length 0;", "length"},
             {good + "eccentricity 0.5; cells (0 24 4);", "cells"},
             {good + "eccentricity 0.5; ends open;", "ends"},
             {good + "eccentricity 0.5; inclination 200;", "inclination"},
             {good + "eccentricity 0.5; excentricity 0.5;", "excentricity"},
             {good, "eccentricity"}};
  for (const auto& b : bad) {
    FlowCase flow_case("bad_mesh");
    flow_case.dictionary("system/annulusMeshDict", b.body);
    const Outcome outcome = run_program(flow_case.folder(), mesh_program());
    EXPECT_EQ(outcome.exit_code, 1) << b.body << outcome.text;
    const size_t at = outcome.text.find("annulusMesh: error: ");
    ASSERT_NE(at, std::string::npos) << b.body << outcome.text;
    const std::string sentence = outcome.text.substr(at);
    EXPECT_NE(sentence.find("annulusMeshDict"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(b.keyword), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), sentence.size() - 1) << sentence;
  }
  FlowCase empty("no_dictionary");
  const Outcome outcome = run_program(empty.folder(), mesh_program());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.text.find("no such file"), std::string::npos) << outcome.text;
}

} // namespace
} // namespace eccentra::test
