// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a log of LIGGGHTS says of the run, line by line.
#include "report/dem_log.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace eccentra::report;

const char* const kLog = "region box block -${half} 0.1 -0.1 0.1 -0.01 0.25 units box\n"
                         "Created orthogonal box = (-0.12 -0.11 -0.01) to (0.12 0.11 0.25)\n"
                         "timestep ${step}\ntimestep 4e-5\n"
                         "fix weight all gravity 9.81 vector 0 -3 -4   # leans\n"
                         "fix floor all wall/gran/cluster model hertz primitive type 1 zplane ${low}\n"
                         "fix floor all wall/gran/cluster model hertz tangential history primitive type 2 zplane 0.01\n"
                         "fix slope all wall/gran model hertz primitive type 1 plane 1 2 3 0 0 -2\n"
                         "fix drum all wall/gran/cluster model hertz primitive type 2 ycylinder 0.05 1 2 rotate 3\n"
                         "fix gone all wall/gran/cluster model hertz primitive type 2 xplane 7\n"
                         "unfix gone\n"
                         "fix b all mesh/surface file b.stl type 1 scale 0.001 move 1 2 3\n"
                         "fix a all mesh/surface/stress file a.stl type 1 rotate axis 0 0 1 angle 90\n"
                         "fix unused all mesh/surface file c.stl type 1\n"
                         "fix walls all wall/gran/cluster model hertz mesh n_meshes 2 meshes a b\n"
                         "run 1000\n";

TEST(DemLog, HasWallsGravityBoxAndStep) {
  const DemRun run = read_dem_log(kLog);
  EXPECT_DOUBLE_EQ(run.time_step, 4e-5);
  EXPECT_NEAR(run.gravity[1], -9.81 * 0.6, 1e-12);
  EXPECT_NEAR(run.gravity[2], -9.81 * 0.8, 1e-12);
  ASSERT_TRUE(run.has_box);
  EXPECT_EQ(run.box, (std::array<double, 6>{-0.12, 0.12, -0.11, 0.11, -0.01, 0.25}));
  ASSERT_EQ(run.walls.size(), 3U);
  const Wall& floor = run.walls.at("floor");
  EXPECT_EQ(floor.kind, Wall::Kind::plane);
  EXPECT_EQ(floor.point, (Vector{0, 0, 0.01}));
  EXPECT_EQ(floor.axis, (Vector{0, 0, 1}));
  EXPECT_EQ(run.walls.at("slope").point, (Vector{1, 2, 3}));
  EXPECT_EQ(run.walls.at("slope").axis, (Vector{0, 0, -1}));
  const Wall& drum = run.walls.at("drum");
  EXPECT_EQ(drum.kind, Wall::Kind::cylinder);
  EXPECT_EQ(drum.axis, (Vector{0, 1, 0}));
  EXPECT_EQ(drum.point, (Vector{2, 0, 1})) << "the coordinates follow y in cyclic order: z, x";
  EXPECT_DOUBLE_EQ(drum.radius, 0.05);
}

TEST(DemLog, HasTheMeshesThatWallsUse) {
  const DemRun run = read_dem_log(kLog);
  ASSERT_EQ(run.meshes.size(), 1U);
  EXPECT_EQ(run.meshes[0].file, "b.stl");
  EXPECT_DOUBLE_EQ(run.meshes[0].scale, 0.001);
  EXPECT_EQ(run.meshes[0].move, (Vector{1, 2, 3}));
  EXPECT_EQ(run.left_out, std::vector<std::string>{"a"}) << "turned by the script";
}

TEST(DemLog, DoesNotGuessATimeThatHasTwoSteps) {
  EXPECT_DOUBLE_EQ(read_dem_log("timestep 1e-5\ntimestep 2e-5\nrun 10\n").time_step, 2e-5);
  EXPECT_DOUBLE_EQ(read_dem_log("timestep 1e-5\nrun 10\ntimestep 2e-5\nrun 10\n").time_step, 0);
  EXPECT_DOUBLE_EQ(read_dem_log("timestep 1e-5\nrun 10\ntimestep 1e-5\nrun 10\n").time_step, 1e-5);
}

TEST(DemLog, PassesOverWhatIsNotAWall) {
  const DemRun run =
      read_dem_log("fix\nfix a\nfix a all wall/gran/cluster primitive type\nfix b all wall/gran primitive "
                   "type 1 zcylinder 0.1 0\nfix c all gravity 9.81 vector 0 0 0\ntimestep\n\n#\n");
  EXPECT_TRUE(run.walls.empty());
  EXPECT_EQ(run.gravity, (Vector{0, 0, 0}));
}

} // namespace
