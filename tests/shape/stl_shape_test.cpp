// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Solids from STL files: exact mass properties, inscribed spheres that stay inside and get better with their number.
#include "shape/shape_refusals.h"
#include "shape/stl_solids.h"
#include "shape/union_geometry.h"
#include "shape/vtk/stl_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {
using namespace eccentra::shape;
using namespace eccentra::test;
using Eigen::Vector3d;

constexpr double float_digits = 1e-6; // STL carries floats

std::string refusal(const std::vector<std::string>& arguments) {
  install_stl_keywords();
  return eccentra::test::refusal(arguments, 0);
}

TEST(Solid, BoxHasItsMassPropertiesWhereverItIs) {
  const Vector3d half(1, 0.5, 0.25), centre(3, -2, 7);
  write_stl("box.stl", box(half, centre));
  const double scale = 1e-3;
  const MassProperties p = Solid("box.stl", scale).properties();
  const double volume = 8 * half.prod() * std::pow(scale, 3);
  EXPECT_NEAR(p.volume, volume, float_digits * volume);
  EXPECT_NEAR(p.surface, 8 * (half[0] * half[1] + half[1] * half[2] + half[2] * half[0]) * scale * scale, 1e-11);
  EXPECT_LT((p.centre - scale * centre).norm(), float_digits * scale);
  const Vector3d square = half.cwiseAbs2() / 3 * scale * scale;
  const Eigen::Matrix3d expected = (square.sum() * Vector3d::Ones() - square).asDiagonal();
  EXPECT_LT((p.inertia_per_mass - expected).norm(), 1e-5 * expected.norm());
}

TEST(Solid, DistancesScaleWithTheSolid) {
  write_stl("ball.stl", ball(1, 4));
  const Solid one("ball.stl", 1);
  for (const double scale : {1e-6, 1e-3, 1e3}) {
    const Solid scaled("ball.stl", scale);
    for (const Vector3d& x : {Vector3d(0, 0, 0), Vector3d(.3, -.2, .8), Vector3d(1, 1, 0)})
      EXPECT_NEAR(scaled.distance(scale * x) / scale, one.distance(x), 1e-6) << scale;
  }
}

TEST(Solid, TurnedInsideOutItIsTheSame) {
  std::vector<Facet> facets = box(Vector3d(1, 1, 1), Vector3d::Zero());
  for (Facet& f : facets)
    std::swap(f[0], f[1]);
  write_stl("inside_out.stl", facets);
  EXPECT_NEAR(Solid("inside_out.stl", 1).properties().volume, 8, 1e-6);
  std::swap(facets[3][0], facets[3][1]); // one facet the right way round, the others not
  write_stl("mixed.stl", facets);
  const Solid mixed("mixed.stl", 1);
  EXPECT_NEAR(mixed.properties().volume, 8, 1e-6);
  EXPECT_NEAR(mixed.distance(Vector3d::Zero()), -1, 1e-6);
  EXPECT_NEAR(mixed.distance(Vector3d(3, 0, 0)), 2, 1e-6);
}

TEST(Solid, EccentricityOfIdealSolidsOnAPlane) {
  write_stl("cube.stl", box(Vector3d(1, 1, 1), Vector3d::Zero()));
  const SolidEccentricity cube = solid_eccentricity(Solid("cube.stl", 1));
  EXPECT_NEAR(cube.mean, 0.646, 0.01 * 0.646);
  EXPECT_NEAR(cube.max, std::sqrt(2.0) / 2 / std::cbrt(3 / (4 * M_PI)), 0.01 * 1.14);
  write_stl("cylinder.stl", cylinder(0.5, 0.4, 200));
  const SolidEccentricity disk = solid_eccentricity(Solid("cylinder.stl", 1));
  EXPECT_NEAR(disk.mean, 0.402, 0.01 * 0.402);
  EXPECT_NEAR(disk.max, 1.186, 0.01 * 1.186);
}

TEST(Inscribed, FirstSphereIsTheLargest) {
  write_stl("box.stl", box(Vector3d(1, 0.6, 0.8), Vector3d(5, 5, 5)));
  const std::vector<Sphere> spheres = inscribed_spheres(Solid("box.stl", 1), {1, 0, 24});
  ASSERT_EQ(spheres.size(), 1u);
  EXPECT_NEAR(spheres[0].radius, 0.6, 1e-5);
  EXPECT_NEAR(spheres[0].centre.y(), 5, 1e-5);
}

TEST(Inscribed, BallIsOneSphere) {
  write_stl("ball.stl", ball(1, 4));
  const Solid solid("ball.stl", 1);
  const std::vector<Sphere> spheres = inscribed_spheres(solid, {0, 0.02, 24});
  EXPECT_EQ(spheres.size(), 1u);
  EXPECT_NEAR(spheres[0].radius, 1, 0.01); // the facets lie below the sphere
  const FitQuality fit = fit_quality(solid, solid_eccentricity(solid), spheres, MassOf::spheres);
  EXPECT_LT(fit.volume, 0.02);
  EXPECT_LT(fit.max_distance, 0.01);
}

class Filled : public testing::TestWithParam<const char*> {};

TEST_P(Filled, SpheresStayInsideConnectedAndImprove) {
  const std::string name = GetParam();
  write_stl("filled.stl", name == "cube"    ? box(Vector3d(1, 1, 1), Vector3d::Zero())
                          : name == "plate" ? box(Vector3d(1, 1, 0.2), Vector3d::Zero())
                                            : cylinder(0.5, 0.4, 64));
  const Solid solid("filled.stl", 1);
  const std::vector<Sphere> spheres = inscribed_spheres(solid, {64, 0, 24});
  ASSERT_EQ(spheres.size(), 64u);
  for (const Sphere& s : spheres)
    EXPECT_LE(solid.distance(s.centre), -s.radius * (1 - 1e-9));
  double before = 1, distance_before = 10;
  for (const int count : {1, 4, 16, 64}) {
    const std::vector<Sphere> part(spheres.begin(), spheres.begin() + count);
    EXPECT_NO_THROW(require_connected(part));
    const FitQuality fit = fit_quality(solid, solid_eccentricity(solid), part, MassOf::spheres);
    EXPECT_LT(fit.volume, before);
    EXPECT_LT(fit.mean_distance, distance_before);
    EXPECT_GT(fit.volume, 0);
    before = fit.volume;
    distance_before = fit.mean_distance;
  }
  EXPECT_LT(before, 0.3);
  const std::vector<Sphere> again = inscribed_spheres(solid, {16, 0, 24});
  for (std::size_t k = 0; k < again.size(); ++k)
    EXPECT_EQ(again[k].centre, spheres[k].centre) << "fewer spheres must be the first of more";
}

INSTANTIATE_TEST_SUITE_P(Solids, Filled, testing::Values("cube", "plate", "cylinder"));

TEST(Inscribed, StopsAtTheErrorAskedFor) {
  write_stl("cube.stl", box(Vector3d(1, 1, 1), Vector3d::Zero()));
  const Solid solid("cube.stl", 1);
  const double error = 0.2;
  std::vector<Sphere> spheres = inscribed_spheres(solid, {0, error, 24});
  EXPECT_LE(fit_quality(solid, solid_eccentricity(solid), spheres, MassOf::spheres).volume, error);
  spheres.pop_back();
  EXPECT_GT(fit_quality(solid, solid_eccentricity(solid), spheres, MassOf::spheres).volume, error);
}

TEST(StlWords, MassOfTheSolidOrOfTheSpheres) {
  install_stl_keywords();
  write_stl("box.stl", box(Vector3d(500, 300, 400), Vector3d(100, 0, 0)));
  const std::vector<std::string> arguments{"stl",  "box.stl",    "spheres", "20",  "scale",
                                           "1e-3", "resolution", "20",      "mass"};
  auto with = [&](const std::string& mass, double diameter) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {mass, "diameter"});
    std::size_t used = 0;
    ClusterShape shape = make_shape(all, 0, used, diameter);
    EXPECT_EQ(used, all.size() - 1);
    return shape;
  };
  const ClusterShape solid = with("solid", 0), spheres = with("union", 0);
  EXPECT_NEAR(solid.volume(), 0.48, 1e-6);
  EXPECT_LT(spheres.volume(), 0.95 * solid.volume());
  EXPECT_NEAR(solid.inertia_per_mass().x(), (0.09 + 0.16) / 3, 1e-6);
  EXPECT_NEAR(solid.given_centre().x(), 0.1, 1e-6);
  EXPECT_NEAR(with("solid", 0.2).equivalent_radius(), 0.1, 1e-9);
  EXPECT_NEAR(with("union", 0.2).equivalent_radius(), 0.1, 1e-9);
}

TEST(StlWords, BadOnesEarnASentence) {
  write_stl("cube.stl", box(Vector3d(1, 1, 1), Vector3d::Zero()));
  std::vector<Facet> holed = box(Vector3d(1, 1, 1), Vector3d::Zero());
  holed.pop_back();
  write_stl("holed.stl", holed);
  std::ofstream("words.stl") << "these are words\n";
  std::ofstream("empty.stl");
  write_stl("flat.stl", {{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)},
                         {Vector3d(0, 0, 0), Vector3d(0, 1, 0), Vector3d(1, 0, 0)}});
  expect_sentence(refusal({"stl"}), {"STL file"});
  expect_sentence(refusal({"stl", "cube.stl"}), {"cube.stl", "spheres N"});
  expect_sentence(refusal({"stl", "nowhere.stl", "spheres", "5"}), {"nowhere.stl", "cannot read"});
  expect_sentence(refusal({"stl", "holed.stl", "spheres", "5"}), {"holed.stl", "not a closed surface", "3 edges"});
  expect_sentence(refusal({"stl", "words.stl", "spheres", "5"}), {"words.stl"});
  expect_sentence(refusal({"stl", "empty.stl", "spheres", "5"}), {"empty.stl", "no triangles"});
  expect_sentence(refusal({"stl", "flat.stl", "spheres", "5"}), {"flat.stl", "no volume"});
  expect_sentence(refusal({"stl", "cube.stl", "spheres", "none"}), {"none", "whole number"});
  expect_sentence(refusal({"stl", "cube.stl", "spheres", "2", "mass", "air"}), {"air", "union or solid"});
  expect_sentence(refusal({"stl", "cube.stl", "spheres", "2", "scale", "-1"}), {"scale", "-1"});
  expect_sentence(refusal({"stl", "cube.stl", "spheres", "4000", "resolution", "8"}), {"only", "4000", "resolution"});
  expect_sentence(refusal({"stl", "cube.stl", "error", "1e-4", "resolution", "8"}), {"only", "resolution"});
}

} // namespace
