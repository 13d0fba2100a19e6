// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shape arguments and .clump files: what they mean, the body frame, and the sentences that bad ones earn.
#include "shape/clump_file.h"
#include "shape/cluster_shape.h"
#include "shape/shape_refusals.h"
#include "shape/union_geometry.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace {
using namespace eccentra::shape;
using eccentra::test::expect_sentence;
using Eigen::Vector3d;

std::string write_file(const std::string& name, const std::string& text) {
  std::ofstream(name) << text;
  return name;
}

ClusterShape from_arguments(const std::vector<std::string>& arguments, double diameter = 0) {
  std::size_t used = 0;
  ClusterShape shape = make_shape(arguments, 0, used, diameter);
  EXPECT_EQ(used, arguments.size());
  return shape;
}

std::string refusal(const std::vector<std::string>& arguments, double diameter = 1) {
  return eccentra::test::refusal(arguments, diameter);
}

TEST(ShapeWords, FilesKeepTheirSizeOrAreScaledOrSized) {
  const std::string name = write_file("pair.clump", "# two spheres\n\n0 0 0 1 # first\n\t1.5 0 0 1\n");
  EXPECT_DOUBLE_EQ(from_arguments({"file", name}).smallest_radius(), 1);
  EXPECT_DOUBLE_EQ(from_arguments({"file", name, "scale", "1e-3"}).smallest_radius(), 1e-3);
  EXPECT_NEAR(from_arguments({"file", name}, 0.2).equivalent_radius(), 0.1, 1e-12);
}

TEST(ShapeWords, StopsAtWordsThatAreNotItsOwn) {
  std::size_t used = 0;
  make_shape({"fix", "1", "shape", "disk", "7", "diameter", "0.1"}, 3, used, 0.1);
  EXPECT_EQ(used, 2u);
}

TEST(ShapeWords, BodyFrameOfATurnedClusterIsPrincipal) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d(1, -2, 0.7).normalized()).toRotationMatrix();
  std::vector<Sphere> spheres{
      {Vector3d(0, 0, 0), 1}, {Vector3d(1, 0, 0), .9}, {Vector3d(2, 0, 0), 1}, {Vector3d(0, 1, 0), .6}};
  for (Sphere& s : spheres)
    s.centre = turn * s.centre + Vector3d(3, 4, 5);
  const ClusterShape shape("turned", spheres, measure_union(spheres).properties);
  const MassProperties p = measure_union(shape.spheres()).properties;
  EXPECT_LT(p.centre.norm(), 1e-9);
  EXPECT_LT((p.inertia_per_mass - Eigen::Matrix3d(shape.inertia_per_mass().asDiagonal())).norm(), 1e-9);
  // Right-handed: distances and orientation of the tetrahedron of centres survive.
  auto volume6 = [](const std::vector<Sphere>& s) {
    return (s[1].centre - s[0].centre)
        .cross(s[2].centre + Vector3d::Zero() - s[0].centre)
        .dot(s[3].centre - s[0].centre);
  };
  EXPECT_NEAR(volume6(shape.spheres()), volume6(spheres), 1e-12);
  for (std::size_t i = 1; i < spheres.size(); ++i)
    EXPECT_NEAR((shape.spheres()[i].centre - shape.spheres()[0].centre).norm(),
                (spheres[i].centre - spheres[0].centre).norm(), 1e-12);
}

TEST(ShapeWords, NaturalAxesStayWhereInertiaLeavesAChoice) {
  // A cube-like cluster turned about an odd axis is isotropic: its given axes are as good as any.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3d(3, 1, 2).normalized()).toRotationMatrix();
  const ClusterShape cube = from_arguments({"cube", "8"}, 1);
  std::vector<Sphere> turned = cube.spheres();
  for (Sphere& s : turned)
    s.centre = turn * s.centre;
  const ClusterShape again("cube", turned, measure_union(turned).properties);
  for (std::size_t i = 0; i < turned.size(); ++i)
    EXPECT_LT((again.spheres()[i].centre - turned[i].centre).norm(), 1e-9);
  EXPECT_EQ(again.inertia_per_mass().x(), again.inertia_per_mass().z());
  // A disk with its axis along x keeps it there.
  std::vector<Sphere> disk = from_arguments({"disk", "7"}, 1).spheres();
  for (Sphere& s : disk)
    s.centre = Vector3d(s.centre.z(), s.centre.x(), s.centre.y());
  const ClusterShape upright("disk", disk, measure_union(disk).properties);
  EXPECT_GT(upright.inertia_per_mass().x(), 1.5 * upright.inertia_per_mass().y());
  EXPECT_EQ(upright.inertia_per_mass().y(), upright.inertia_per_mass().z());
}

TEST(ShapeWords, TurnedDiskFindsItsAxis) {
  std::vector<Sphere> disk = from_arguments({"disk", "19"}, 1).spheres();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  for (Sphere& s : disk)
    s.centre = turn * s.centre;
  const ClusterShape shape("disk", disk, measure_union(disk).properties);
  EXPECT_GT(shape.inertia_per_mass().z(), 1.5 * shape.inertia_per_mass().x());
  for (const Sphere& s : shape.spheres())
    EXPECT_NEAR(s.centre.z(), 0, 1e-9);
}

TEST(ShapeWords, WrittenFilesReadBackTheSame) {
  const ClusterShape shape = from_arguments({"disk", "48"}, 6.35e-3);
  {
    std::ofstream out("d48.clump");
    write_clump(out, shape);
  }
  const ClusterShape back = from_arguments({"file", "d48.clump"});
  ASSERT_EQ(back.spheres().size(), shape.spheres().size());
  for (std::size_t i = 0; i < back.spheres().size(); ++i) {
    EXPECT_LT((back.spheres()[i].centre - shape.spheres()[i].centre).norm(), 1e-12 * shape.bounding_radius());
    EXPECT_EQ(back.spheres()[i].radius, shape.spheres()[i].radius);
  }
  EXPECT_NEAR(back.volume(), shape.volume(), 1e-12 * shape.volume());
}

TEST(ShapeWords, BadWordsEarnASentence) {
  expect_sentence(refusal({"cone", "3"}), {"cone", "sphere", "cube", "disk", "file"});
  expect_sentence(refusal({"cube", "9"}), {"cube 9", "27"});
  expect_sentence(refusal({"cube", "1e9"}), {"1000000000", "4096"});
  expect_sentence(refusal({"cube", "1000000000000"}), {"1000000000000"});
  expect_sentence(refusal({"disk", "8"}), {"disk 8", "19"});
  expect_sentence(refusal({"sphere", "-1"}), {"-1"});
  expect_sentence(refusal({"sphere", "2"}), {"sphere 2", "6"});
  expect_sentence(refusal({"cube"}), {"number of spheres"});
  expect_sentence(refusal({}), {"name of a shape"});
  expect_sentence(refusal({"cube", "8"}, 0), {"diameter"});
  expect_sentence(refusal({"cube", "8"}, NAN), {"diameter", "finite"});
  expect_sentence(refusal({"file"}), {".clump"});
  expect_sentence(refusal({"file", "nowhere.clump"}), {"nowhere.clump"});
  const std::string good = write_file("one.clump", "0 0 0 1\n");
  expect_sentence(refusal({"file", good, "scale"}), {"scale"});
  expect_sentence(refusal({"file", good, "scale", "0"}), {"scale", "'0'"});
  expect_sentence(refusal({"stl", "part.stl", "spheres", "50"}), {"'stl' is not known"}); // a library of its own
}

TEST(ShapeWords, BadFilesEarnASentenceWithTheLine) {
  auto refused = [](const std::string& text) { return refusal({"file", write_file("bad.clump", text)}); };
  expect_sentence(refused("0 0 0 1\n0 0 1\n"), {"bad.clump", "line 2", "3 numbers"});
  expect_sentence(refused("0 0 0 1 7\n"), {"line 1", "5 numbers"});
  expect_sentence(refused("# head\n0 0 zero 1\n"), {"line 2", "zero"});
  expect_sentence(refused("0 0 nan 1\n"), {"line 1", "nan"});
  expect_sentence(refused("0 0 0 inf\n"), {"line 1", "inf"});
  expect_sentence(refused("0 0 0 0\n"), {"line 1", "radius"});
  expect_sentence(refused("0 0 0 -2\n"), {"line 1", "radius"});
  expect_sentence(refused("# nothing\n"), {"no spheres"});
  expect_sentence(refused(""), {"no spheres"});
  expect_sentence(refused("0 0 0 1\n5 0 0 1\n"), {"sphere 2", "touch"});
}

} // namespace
