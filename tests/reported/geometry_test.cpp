// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two descriptions of one geometry: the walls of the script and of the mesh, particles and the mesh.
#include "reported/short_section.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <tuple>

using namespace eccentra::test;

namespace {

/// An STL of a cylinder about an axis parallel to z.
void write_cylinder(const fs::path& file, double radius, double y, double low, double high, int around) {
  std::ofstream out(file);
  out << "solid c\n";
  const double pi = std::acos(-1.0);
  const auto triangle = [&](std::initializer_list<std::pair<int, double>> corners) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const auto& [i, z] : corners)
      out << "vertex " << radius * std::cos(2 * pi * (i % around) / around) << ' '
          << y + radius * std::sin(2 * pi * (i % around) / around) << ' ' << z << '\n';
    out << "endloop\nendfacet\n";
  };
  for (int i = 0; i < around; ++i) {
    triangle({{i, low}, {i + 1, low}, {i + 1, high}});
    triangle({{i, low}, {i + 1, high}, {i, high}});
  }
  out << "endsolid c\n";
}

} // namespace

TEST(Reported, geometry_of_one_side_alone) {
  const std::string pipe = "zcylinder 0.02413 0 -0.019685", turns = "omega 5.235988";
  const std::string stock = "wall/gran model hertz tangential history";
  const std::string hole = "wall/gran/cluster model hertz tangential history rolling_friction ${roll} &\n"
                           "                primitive type 1 zcylinder 0.0635 0 0";
  const std::vector<std::pair<Change, std::vector<std::string>>> refused = {
      {{"hole radius in the script", kScript, "zcylinder 0.0635 0 0", "zcylinder 0.0600 0 0"},
       {"0.06 m", "to 0.06389 m"}},
      {{"hole axis in the script", kScript, "zcylinder 0.0635 0 0", "zcylinder 0.0635 0.001 0"}, {"x = 0.001 m"}},
      {{"pipe radius in the script", kScript, pipe, "zcylinder 0.019 0 -0.019685"}, {"0.019 m", "to 0.02428 m"}},
      {{"pipe axis in the script", kScript, pipe, "zcylinder 0.02413 0 0.019685"},
       {"y = 0.019685 m", "y = -0.019685 m"}},
      {{"spin in the script", kScript, "rpm          index 50", "rpm          index 60"},
       {"6.28319 rad/s", "5.23599 rad/s"}},
      {{"hole radius in the mesh", kMesh, "holeRadius      0.0635", "holeRadius      0.066"},
       {"of the mesh is a cylinder"}},
      {{"pipe radius in the mesh", kMesh, "pipeRadius      0.02413", "pipeRadius      0.03"},
       {"0.02413 m", "to 0.03018 m"}},
      {{"eccentricity in the mesh", kMesh, "eccentricity    0.5", "eccentricity    0.6"}, {"y = -0.023622 m"}},
      {{"spin in U", kU, turns, "omega 5"}, {"5.23599 rad/s", "5 rad/s"}},
      {{"sense of the spin in U", kU, turns, "omega -5.235988"}, {"at -5.23599 rad/s"}},
      {{"pipe at rest in U", kU, "type rotatingWallVelocity", "type noSlip"}, {"at 0 rad/s"}},
      {{"pipe on a still mesh", kU, "type rotatingWallVelocity", "type movingWallVelocity"}, {"at 0 rad/s"}},
      {{"sliding hole in U", kU, "type noSlip", "type fixedValue; value uniform (0 0 0.1)"},
       {"slides at 0 m/s", "0.1 m/s"}},
      {{"stock's wall", kScript, hole, stock + " primitive type 1 zcylinder 0.0600 0 0"}, {"zcylinder", "0.06 m"}},
      {{"stock's wall turns", kScript, hole, stock + " primitive type 1 zcylinder 0.0635 0 0 shear x 3"},
       {"turns at 3 rad/s", "at 0 rad/s"}},
      {{"stock's wall slides", kScript, hole, stock + " primitive type 1 zcylinder 0.0635 0 0 shear z 0.2"},
       {"slides at 0.2 m/s"}},
  };
  for (const auto& [change, parts] : refused)
    expect_refused(Section("refused", {change}).run(), parts, change.what);

  // The same on both sides runs, on any mesh, without a word of it.
  for (const std::string cells : {"(6 24 4)", "(3 8 2)", "(4 12 3)"}) {
    Section same("same");
    replace_in(same.folder() / kMesh, "(6 24 4)", cells);
    const ProgramResult result = same.run();
    EXPECT_EQ(result.status, 0) << cells << "\n" << result.output;
    EXPECT_FALSE(holds(result.output, "of the DEM script")) << cells << "\n" << result.output;
  }
  // Two walls that shall be two.
  Section apart("apart", {{"", kScript, "zcylinder 0.0635 0 0", "zcylinder 0.0600 0 0"},
                          {"", "constant/couplingProperties", "report ", "wallsApart (hole);\nreport "}});
  replace_in(apart.folder() / kScript, "cylinder z 0 0 0.0634", "cylinder z 0 0 0.0599");
  const ProgramResult two = apart.run();
  EXPECT_EQ(two.status, 0) << two.output;
  Section unknown("unknown", {{"", "constant/couplingProperties", "report ", "wallsApart (holle);\nreport "}});
  expect_refused(unknown.run(), {"wallsApart", "holle", "hole, pipe"}, "a name of nothing");

  // Triangles of stock's meshes, at rest and moving.
  const std::string meshes =
      "fix cad all mesh/surface file hole.stl type 1\n"
      "fix hole all wall/gran/cluster model hertz tangential history mesh n_meshes 1 meshes cad\n";
  for (const auto& [radius, spin, sentence] : std::vector<std::tuple<double, std::string, std::string>>{
           {0.0635, "", ""}, {0.060, "", "mesh 'cad'"}, {0.0635, "2", "turns at 3.14"}}) {
    Section stl("stl");
    replace_in(stl.folder() / kScript, "fix             hole all " + hole, meshes);
    if (!spin.empty())
      replace_in(stl.folder() / kScript, "run             ${steps}",
                 "fix turn all move/mesh mesh cad rotate origin 0 0 0 axis 0 0 1 period " + spin + "\nrun ${steps}");
    write_cylinder(stl.folder() / "hole.stl", radius, 0, -0.001, 0.061, 64);
    const ProgramResult result = stl.run();
    if (sentence.empty())
      EXPECT_EQ(result.status, 0) << result.output;
    else
      expect_refused(result, {sentence}, "STL " + std::to_string(radius) + " " + spin);
  }
}

namespace {

void refuse_over_the_socket(int ranks) {
  Section section("apart" + std::to_string(ranks), {{"", kU, "omega 5.235988", "omega 5"}});
  const auto [fluid, dem] = section.run_apart(ranks, socket_path("geo" + std::to_string(ranks)));
  expect_refused(fluid, {"5.23599 rad/s", "5 rad/s"}, "fluid");
  expect_refused(dem, {"5.23599 rad/s", "5 rad/s"}, "DEM");
}

} // namespace

TEST(Reported, geometry_of_one_side_alone_over_the_socket) {
  refuse_over_the_socket(1);
}

TEST(Reported, geometry_of_one_side_alone_on_two_ranks) {
  refuse_over_the_socket(2);
  Section section("parallel", {{"", kScript, "zcylinder 0.0635 0 0", "zcylinder 0.0600 0 0"}});
  expect_refused(section.run(2), {"0.06 m", "to 0.06389 m"}, "link solver on two ranks");
}

namespace {

/// No wall in the script, a box beyond the hole, and particles poured there, too.
std::vector<Change> without_hole() {
  return {{"", kScript, "block -0.065 0.065 -0.065 0.065", "block -0.12 0.12 -0.12 0.12"},
          {"", kScript, "cylinder z 0 0 0.0634", "cylinder z 0 0 0.1"},
          {"", kScript,
           "fix             hole all wall/gran/cluster model hertz tangential history rolling_friction "
           "${roll} &\n                primitive type 1 zcylinder 0.0635 0 0\n",
           ""}};
}

void refuse_outliers(int ranks) {
  Section section("outside" + std::to_string(ranks), without_hole());
  const ProgramResult result = section.run(ranks);
  expect_refused(
      result,
      {" of 20 particles lie outside the mesh", "particle ", " at (", "behind patch 'hole'", "particlesOutside"},
      "link solver");
  EXPECT_FALSE(fs::exists(section.folder() / "postProcessing/eccentra/coupling.csv")) << "written before the check";
}

} // namespace

TEST(Reported, particles_outside_the_mesh_on_two_ranks) {
  refuse_outliers(2);
}

TEST(Reported, particles_outside_the_mesh) {
  refuse_outliers(1);
  const std::vector<Change> without = without_hole();
  Section socket("socket", without);
  const auto [fluid, dem] = socket.run_apart(1, socket_path("out"));
  expect_refused(fluid, {"lie outside the mesh", "behind patch 'hole'"}, "fluid");
  expect_refused(dem, {"lie outside the mesh", "behind patch 'hole'"}, "DEM");

  // A stated number is allowed, said, and counted in the table.
  Section allowed("allowed", without);
  replace_in(allowed.folder() / "constant/couplingProperties", "report          20",
             "particlesOutside 20;\nreport          1");
  const ProgramResult result = allowed.run();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_TRUE(holds(result.output, "particles lie outside the mesh")) << result.output;
  EXPECT_TRUE(holds(result.output, "no wall of the DEM script is near patch 'hole'")) << result.output;
  std::istringstream table(contents(allowed.folder() / "postProcessing/eccentra/coupling.csv"));
  std::string names, row;
  std::getline(table, names);
  std::getline(table, row);
  EXPECT_TRUE(holds(names, ",outside"));
  const auto column = std::count(names.begin(), names.begin() + names.find(",outside"), ',') + 1;
  std::istringstream values(row);
  std::string value;
  for (long k = 0; k <= column; ++k)
    std::getline(values, value, ',');
  EXPECT_GT(std::atoi(value.c_str()), 5) << row;
}

TEST(Reported, which_particle_has_left) {
  // Thrown through a gap: the wall of the hole goes when the coupled run begins.
  const std::string thrown = "unfix hole\nset atom 7 x 0 y 0.055 vx 0 vy 6\n" + std::string(kRun);
  const std::vector<std::string> named = {
      "1 particle has left the simulation box since the last coupling step: particle 7, last at (",
      "fluid fraction of a closed or periodic section"};
  for (const int ranks : {1, 2}) {
    Section section("thrown", {{"", kScript, kRun, thrown}});
    expect_refused(section.run(ranks), named, "periodic");
  }
  Section apart("apart", {{"", kScript, kRun, thrown}});
  const auto [fluid, dem] = apart.run_apart(1, socket_path("left"));
  expect_refused(dem, named, "DEM");
  expect_refused(fluid, {named[1]}, "fluid");
  // A script that adds some.
  Section more("more", {{"", kScript, kRun,
                         "run 64\ncreate_atoms 1 single 0 0.05 0.03 units box\nset group all diameter 6.35e-3 density "
                         "2619\nrun 64"}});
  expect_refused(more.run(), {"1 particle has come into the simulation box", "particle 21 at (0 0.0499", named[1]},
                 "one more");
  // In a wider box it stays there, outside the mesh: named once.
  Section wide("wide", {{"", kScript, kRun, thrown},
                        {"", kScript, "block -0.065 0.065 -0.065 0.065", "block -0.065 0.065 -0.065 0.125"}});
  const ProgramResult result = wide.run();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(occurrences(result.output, "particle 7 at ("), 1u) << result.output;
  EXPECT_TRUE(holds(result.output, "behind patch 'hole'")) << result.output;
  EXPECT_TRUE(holds(result.output, "left the simulation box: 0; that lie outside the mesh: 1")) << result.output;
}
