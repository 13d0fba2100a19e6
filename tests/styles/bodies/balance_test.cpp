// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix balance/bodies: where planes go, that ranks become equally loaded, and that not a digit of the results changes.
#include "contact/balanced_planes.h"

#include "styles/bodies/bodies_scene.h"
#include "styles/bodies/body_rows.h"
#include "support/stl_file.h"

#include "comm.h"

#include <gtest/gtest.h>

#include <random>

using namespace eccentra;
using namespace eccentra::test;

TEST(BalancedPlanes, MoveHalfwayAtMostAndReachEqualShares) {
  // All bodies in the first tenth of the box.
  std::vector<double> counts(1000, 0.), planes = {0, 0.25, 0.5, 0.75, 1};
  std::fill(counts.begin(), counts.begin() + 100, 1.);
  for (int round = 0; round < 20; ++round) {
    const auto next = contact::balanced_planes(planes, counts, 0.01);
    for (int p = 1; p < 4; ++p) {
      EXPECT_GE(next[p], planes[p - 1]);
      EXPECT_LE(next[p], planes[p + 1]);
    }
    planes = next;
  }
  for (int p = 1; p < 4; ++p)
    EXPECT_NEAR(planes[p], 0.025 * p, 1e-9);
  // A slab stays as wide as it must, and nobody at all changes nothing.
  planes = {0, 0.25, 0.5, 0.75, 1};
  for (int round = 0; round < 20; ++round)
    planes = contact::balanced_planes(planes, counts, 0.1);
  for (int p = 1; p <= 4; ++p)
    EXPECT_GE(planes[p] - planes[p - 1], 0.1 - 1e-12);
  EXPECT_EQ(contact::balanced_planes(planes, std::vector<double>(1000, 0.), 0.1), planes);
}

TEST(BalancedPlanes, ReachAnotherPlaceInStepsOfHalfTheWay) {
  const std::vector<double> goal = {0, 0.01, 0.02, 0.9, 1};
  std::vector<double> planes = {0, 0.25, 0.5, 0.75, 1};
  int rounds = 0;
  for (; planes != goal && rounds < 20; ++rounds) {
    const auto next = contact::planes_towards(planes, goal);
    for (int p = 1; p < 4; ++p) {
      EXPECT_GE(next[p], planes[p - 1]);
      EXPECT_LE(next[p], planes[p + 1]);
    }
    planes = next;
  }
  EXPECT_EQ(planes, goal);
  EXPECT_GT(rounds, 1);
  EXPECT_TRUE(contact::as_wide_as(goal, 0.01));
  EXPECT_FALSE(contact::as_wide_as(goal, 0.02));
  EXPECT_TRUE(contact::as_wide_as({0, 0.25, 0.5, 0.75, 1}, 0.4)) << "equal parts are not narrowed";
}

namespace {

constexpr int along = 16, across = 3;

/// Bodies in one end of the box slide along a floor and a ramp of triangles towards the other.
void fill(LiggghtsSession& session) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 1);
  const shape::ClusterShape shapes[] = {shape_of("cube", "8"), shape_of("disk", "7"), shape_of("cube", "27")};
  int n = 0;
  for (int a = 0; a < along; ++a)
    for (int b = 0; b < across; ++b, ++n) {
      const int layer = a / 8;
      Start start;
      start.position = Eigen::Vector3d(-0.094 + 0.0085 * (a % 8), (b - 1) * 9e-3, -0.094 + 9e-3 * layer);
      start.velocity = Eigen::Vector3d(1, 0, 0) + 0.1 * Eigen::Vector3d(normal(random), normal(random), normal(random));
      start.orientation =
          Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
      add_body(session, shapes[n % 3], start);
    }
}

const std::string world =
    "fix gravity all gravity 9.81 vector 0.5 0 -1\n"
    "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane -0.1\n"
    "fix ramp_mesh all mesh/surface file balance_ramp.stl type 1\n"
    "fix ramp all wall/gran/cluster model hertz tangential history mesh n_meshes 1 meshes "
    "ramp_mesh\n";
const std::string balance = "fix balance all balance/bodies every 200 threshold 1.05\n";

std::vector<double> planes_of(LiggghtsSession& session) {
  const LAMMPS_NS::Comm& comm = *session.lammps().comm;
  return {comm.xsplit, comm.xsplit + comm.procgrid[0] + 1};
}

struct Outcome {
  std::vector<BodyRow> bodies;
  double imbalance, first_imbalance;
  std::vector<double> planes_before; ///< after 3000 steps, when the restart file is written
};

Outcome run(MPI_Comm ranks, bool balanced) {
  LiggghtsSession session(ranks);
  session.command("processors * 1 1");
  open_box(session, {});
  use_clusters(session);
  fill(session);
  session.script(world);
  if (balanced)
    session.script(balance);
  session.script("timestep 1e-5\nrun 0\n");
  LAMMPS_NS::Fix* fix = balanced ? session.lammps().modify->find_fix_id("balance") : nullptr;
  Outcome outcome;
  outcome.first_imbalance = fix ? fix->compute_scalar() : 1;
  session.script("run 3000\n");
  if (balanced)
    session.script("write_restart balance.restart\n");
  outcome.planes_before = planes_of(session);
  session.script("run 3000\n");
  outcome.imbalance = fix ? fix->compute_scalar() : 1;
  EXPECT_EQ(session.atom().natoms, along * across);
  outcome.bodies = body_rows(session, along * across, ranks);
  return outcome;
}

/// A restarted session, before its first run.
void restart(LiggghtsSession& session, const std::string& file) {
  session.script("processors * 1 1\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\n"
                 "communicate single vel yes\nunits si\nread_restart " +
                 file + "\n" + granular_material());
  use_clusters(session);
}

} // namespace

TEST(Balance, RanksShareTheBodiesAndNoDigitChanges) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  write_stl_file("balance_ramp.stl",
                 stl_quad({"-0.02 -0.03 -0.1", "0.09 -0.03 -0.08", "0.09 0.03 -0.08", "-0.02 0.03 -0.1"}));
  const Outcome alone = run(MPI_COMM_SELF, false), together = run(MPI_COMM_WORLD, true);
  EXPECT_EQ(together.bodies, alone.bodies);
  if (ranks > 1) {
    EXPECT_GT(together.first_imbalance, 1.3) << "the scene starts unbalanced";
    EXPECT_LT(together.imbalance, 1.3);
  }
  // A restarted run begins with the planes of the file, wherever a body was read.
  LiggghtsSession session;
  restart(session, "balance.restart");
  session.script(world + balance + "timestep 1e-5\nrun 0\n");
  EXPECT_EQ(planes_of(session), together.planes_before);
  if (ranks > 1) {
    EXPECT_NE(together.planes_before[1], 1. / ranks);
  }
  session.script("run 3000\n");
  EXPECT_EQ(body_rows(session, along * across, MPI_COMM_WORLD), alone.bodies);
}

// LIGGGHTS has room for the places of as many atoms as its last map has had and a thousand: more than those pass a
// plane in one step, before the next one.
TEST(Balance, ManyBodiesOfARestartFileGoOverInSteps) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<double> planes;
  const std::string often = "fix balance all balance/bodies every 10 threshold 1.05\ntimestep 1e-5\n";
  {
    LiggghtsSession session;
    session.command("processors * 1 1");
    open_box(session, {});
    use_clusters(session);
    session.script("lattice sc 0.002\nregion corner block -0.1 -0.07 -0.1 -0.07 -0.1 -0.07 units box\n"
                   "create_atoms 1 region corner\nset group all diameter 0.0019 density 2619\n" +
                   often + "run 100\nwrite_restart balance_many.restart\n");
    ASSERT_GT(session.atom().natoms, 3000);
    planes = planes_of(session);
  }
  if (ranks > 1) {
    EXPECT_LT(planes[1], 0.15) << "no way of several steps";
  }
  LiggghtsSession session;
  restart(session, "balance_many.restart");
  session.script(often + "run 5\n");
  EXPECT_EQ(planes_of(session), planes);
  EXPECT_GT(session.atom().natoms, 3000);
  for (int i = 0; i < session.atom().nlocal; ++i)
    ASSERT_EQ(session.atom().map(session.atom().tag[i]), i);
}
