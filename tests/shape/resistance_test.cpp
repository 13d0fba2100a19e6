// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Resistance in creeping flow: exact values, symmetry, the centre of resistance, rounded bodies and the cache.
#include "base/linear_algebra.h"
#include "shape/resistance.h"
#include "shape/resistance_cache.h"
#include "shape/rounded_surface.h"
#include "shape/surface_panels.h"
#include "shape/union_geometry.h"
#include "support/sanitized.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace eccentra::shape;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kRequired = 5e-3; ///< relative to exact values

ClusterShape shape_of(const std::vector<std::string>& words, double diameter = 2.0) {
  std::size_t used = 0;
  return make_shape(words, 0, used, diameter);
}

ClusterShape clump_of(const std::vector<Sphere>& spheres) {
  return ClusterShape("clump", spheres, measure_union(spheres).properties);
}

/// Axis ratio beta about z; a volume that the chords of its triangles do not lessen.
Resistance spheroid(double beta) {
  Surface surface = octahedral_sphere(17);
  const double equator = std::pow(beta, -1.0 / 3.0);
  const Vector3d axes(equator, equator, equator * beta);
  for (Vector3d& v : surface.vertices)
    v = v.cwiseProduct(axes);
  const double scale = std::cbrt(4 * M_PI / 3 / solid_properties(surface).volume);
  for (Vector3d& v : surface.vertices)
    v *= scale;
  const double side = (axes[0] * axes[0] + axes[2] * axes[2]) / 5, end = 2 * axes[0] * axes[0] / 5;
  return resistance_of(surface, 4 * M_PI / 3, beta == 1 ? Vector3d(end, end, end) : Vector3d(side, side, end));
}

/// Oberbeck 1876 and Jeffery 1922, in 10 digits.
TEST(Resistance, OfSpheroidsIsExactWithinHalfAPercent) {
  struct Exact {
    double beta, along, across, spin_along, spin_across;
  };
  int done = 0;
  for (const Exact& e : {Exact{1, 1, 1, 1, 1}, Exact{5, 1.0437624744, 1.3865496535, 0.7060807806, 4.6405026840},
                         Exact{2, 0.9555685968, 1.0944329068, 0.8066766993, 1.5049262372},
                         Exact{0.5, 1.1406131555, 0.9987487745, 1.4100403238, 1.1316315769},
                         Exact{0.2, 1.4730625568, 1.1278776424, 2.6718384099, 2.2397757426}}) {
    if (done++ == eccentra::test::repetitions(5, 2))
      break;
    const Resistance r = spheroid(e.beta);
    EXPECT_NEAR(r.translation(2, 2), e.along, kRequired * e.along) << e.beta;
    EXPECT_NEAR(r.translation(0, 0), e.across, kRequired * e.across) << e.beta;
    EXPECT_NEAR(r.rotation(2, 2), e.spin_along, kRequired * e.spin_along) << e.beta;
    EXPECT_NEAR(r.rotation(0, 0), e.spin_across, kRequired * e.spin_across) << e.beta;
    const double b = (e.beta * e.beta - 1) / (e.beta * e.beta + 1);
    EXPECT_NEAR(r.bretherton()[1], b, kRequired * std::abs(b)) << e.beta;
    EXPECT_EQ(r.bretherton()[0], -r.bretherton()[1]);
    EXPECT_EQ(r.bretherton()[2], 0);
    EXPECT_NEAR(r.jeffery_period(1), 2 * M_PI * (e.beta + 1 / e.beta), kRequired * r.jeffery_period(1));
  }
}

/// Of the union's own surface, computed with another method's panels: prototypes with 1200 panels, 0.3 % each.
TEST(Resistance, OfBuiltInShapes) {
  struct Known {
    std::vector<std::string> words;
    double k_x, k_z, spin_x, spin_z, b;
  };
  int done = 0;
  for (const Known& known :
       {Known{{"sphere", "6"}, 1.006, 1.006, 1.021, 1.021, 0}, Known{{"cube", "27"}, 1.041, 1.041, 1.148, 1.148, 0},
        Known{{"cube", "64"}, 1.044, 1.044, 1.166, 1.166, 0}, Known{{"disk", "7"}, 1.075, 1.236, 1.430, 1.879, -.647},
        Known{{"disk", "48"}, 1.041, 1.232, 1.378, 1.748, -.717}}) {
    if (done++ == eccentra::test::repetitions(5, 1))
      break;
    const Resistance r = resistance_of(shape_of(known.words));
    const std::string name = known.words[0] + known.words[1];
    EXPECT_NEAR(r.translation(0, 0), known.k_x, 5e-3) << name;
    EXPECT_NEAR(r.translation(2, 2), known.k_z, 5e-3) << name;
    EXPECT_NEAR(r.rotation(0, 0), known.spin_x, 1e-2) << name;
    EXPECT_NEAR(r.rotation(2, 2), known.spin_z, 1e-2) << name;
    EXPECT_NEAR(r.bretherton()[1], known.b, 5e-3) << name;
    // Exactly symmetric.
    EXPECT_EQ(r.translation(0, 0), r.translation(1, 1)) << name;
    EXPECT_EQ(r.rotation(0, 0), r.rotation(1, 1)) << name;
    if (known.words[0] != "disk") {
      EXPECT_EQ(r.translation, Matrix3d(r.translation(0, 0) * Matrix3d::Identity())) << name;
      EXPECT_EQ(r.rotation, Matrix3d(r.rotation(0, 0) * Matrix3d::Identity())) << name;
      EXPECT_EQ(r.strain.norm(), 0) << name;
    }
    EXPECT_EQ(r.coupling.norm(), 0) << name;
    EXPECT_EQ(r.centre.norm(), 0) << name;
    EXPECT_EQ(Matrix3d(r.translation.diagonal().asDiagonal()), r.translation) << name;
    EXPECT_EQ(Matrix3d(r.rotation.diagonal().asDiagonal()), r.rotation) << name;
  }
}

TEST(Resistance, OfOneSphereIsOneToTheLastDigit) {
  const Resistance r = resistance_of(shape_of({"sphere", "1"}));
  EXPECT_EQ(r.translation, Matrix3d::Identity());
  EXPECT_EQ(r.rotation, Matrix3d::Identity());
  EXPECT_EQ(r.strain.norm() + r.coupling.norm() + r.centre.norm(), 0);
}

/// A clump without any symmetry, and the same one turned: the resistance turns with it, and is positive definite.
TEST(Resistance, OfAnIrregularClumpObeysItsLaws) {
  const std::vector<Sphere> spheres = {
      {Vector3d(0, 0, 0), 1.0}, {Vector3d(1.1, .3, 0), .7}, {Vector3d(.2, -1.0, .5), .6}, {Vector3d(1.9, .8, .3), .5}};
  const ClusterShape shape = clump_of(spheres);
  const Resistance r = resistance_of(shape);
  Eigen::Matrix<double, 6, 6> grand;
  grand << 3 * r.translation, r.coupling.transpose(), r.coupling, r.rotation;
  EXPECT_EQ((Eigen::LLT<Eigen::Matrix<double, 6, 6>>(grand).info()), Eigen::Success); // positive definite
  // Reciprocal theorem: the discretisation keeps it only as far as it converges.
  EXPECT_LT((r.translation - r.translation.transpose()).norm(), 1e-12);
  // About the centre of resistance the coupling is symmetric: T_P = T_O - r x F.
  Matrix3d cross;
  cross << 0, -r.centre[2], r.centre[1], r.centre[2], 0, -r.centre[0], -r.centre[1], r.centre[0], 0;
  const Matrix3d there = r.coupling - cross * 3 * r.translation;
  EXPECT_LT((there - there.transpose()).norm(), 1e-12);
  EXPECT_GT(r.centre.norm(), 1e-3);
  // K lies between that of the largest sphere inside and that of the bounding sphere (Hill & Power 1956).
  const Vector3d k = eccentra::base::symmetric_modes(r.translation).values;
  EXPECT_GT(k[0] * shape.equivalent_radius(), 1.0);
  EXPECT_LT(k[2] * shape.equivalent_radius(), shape.bounding_radius());
  // The body frame follows the clump.
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Sphere> turned = spheres;
  for (Sphere& s : turned)
    s.centre = turn * s.centre + Vector3d(5, 6, 7);
  const Vector3d k_turned = eccentra::base::symmetric_modes(resistance_of(clump_of(turned)).translation).values;
  EXPECT_LT((k_turned - k).norm(), 2e-3 * k.norm());
}

/// Two touching spheres, a fine classic: 0.645 and 0.724 of two lone spheres (Stimson & Jeffery 1926, Goldman 1966).
TEST(Resistance, OfTwoTouchingSpheres) {
  const ClusterShape shape = clump_of({{Vector3d(0, 0, .999), 1.0}, {Vector3d(0, 0, -.999), 1.0}});
  const Resistance r = resistance_of(shape);
  const double alone = 2 / shape.equivalent_radius(); // both, in units of the sphere of equal volume
  EXPECT_NEAR(r.translation(2, 2), .6451 * alone, kRequired * alone);
  EXPECT_NEAR(r.translation(0, 0), .7243 * alone, kRequired * alone);
}

TEST(Resistance, OfRoundedBodies) {
  // A ball, as a point with a radius and as a slightly drawn-out segment.
  const RoundedHull ball("ball", box_core(Vector3d::Zero()), 1.0);
  EXPECT_NEAR(resistance_of(ball).translation(0, 0), 1, kRequired);
  const RoundedHull cube("cube", box_core(Vector3d::Constant(0.9)), 0.1);
  const Resistance of_cube = resistance_of(cube);
  EXPECT_EQ(of_cube.translation, Matrix3d(of_cube.translation(0, 0) * Matrix3d::Identity()));
  EXPECT_EQ(of_cube.strain.norm() + of_cube.coupling.norm(), 0);
  // A sharp cube has 1.0857 (Pettyjohn & Christiansen 1948: 0.843 log10(phi/0.065)), C64 1.046.
  EXPECT_GT(of_cube.translation(0, 0), 1.046);
  EXPECT_LT(of_cube.translation(0, 0), 1.0857);
  // More than the spheroid inside and less than the ball around (Hill & Power 1956).
  const RoundedHull disk("disk", DiskCore{0.8, 0.2}, 0.2);
  const Resistance of_disk = resistance_of(disk), inside = spheroid(0.4);
  EXPECT_EQ(of_disk.translation(0, 0), of_disk.translation(1, 1));
  for (const int k : {0, 2}) {
    EXPECT_GT(2 * disk.equivalent_radius() * of_disk.translation(k, k), 2 * std::cbrt(0.4) * inside.translation(k, k));
    EXPECT_LT(disk.equivalent_radius() * of_disk.translation(k, k), disk.bounding_radius());
  }
  EXPECT_GT(of_disk.translation(2, 2), of_disk.translation(0, 0));
  EXPECT_LT(of_disk.bretherton()[1], -0.4);
}

std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(ResistanceCache, ServesAllSizesAndRefusesWhatWasChanged) {
  const std::filesystem::path folder = std::filesystem::current_path() / "cache";
  std::filesystem::remove_all(folder);
  setenv("ECCENTRA_CACHE", folder.c_str(), 1);
  const Resistance solved = cached_resistance(shape_of({"disk", "19"}, 2.0));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  ASSERT_EQ(files.size(), 1U);
  const std::string text = file_text(files[0]);
  const auto expect_same = [&](const Resistance& r) {
    EXPECT_EQ(r.translation, solved.translation);
    EXPECT_EQ(r.rotation, solved.rotation);
    EXPECT_EQ(r.strain, solved.strain);
  };
  // Another size: the same file, which is not written again.
  const auto written = std::filesystem::last_write_time(files[0]);
  expect_same(cached_resistance(shape_of({"disk", "19"}, 6.35e-3)));
  EXPECT_EQ(std::filesystem::last_write_time(files[0]), written);
  // Cut short, a digit changed, of another version: solved and written anew.
  std::string changed = text;
  changed[text.find("1.23")] = '7';
  std::string other = text;
  other.replace(other.find("version 1"), 9, "version 0");
  int done = 0;
  for (const std::string& bad : {text.substr(0, text.size() / 2), changed, other, std::string()}) {
    if (done++ == eccentra::test::repetitions(4, 1))
      break;
    std::ofstream(files[0], std::ios::binary) << bad;
    expect_same(cached_resistance(shape_of({"disk", "19"}, 2.0)));
    EXPECT_EQ(file_text(files[0]), text);
  }
  // Another shape has another file; no folder, no file, the same numbers.
  cached_resistance(shape_of({"disk", "7"}, 2.0));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 2);
  setenv("ECCENTRA_CACHE", "none", 1);
  expect_same(cached_resistance(shape_of({"disk", "19"}, 2.0)));
  setenv("ECCENTRA_CACHE", "/proc/no/such/place", 1);
  expect_same(cached_resistance(shape_of({"disk", "19"}, 2.0)));
}

} // namespace
