// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The same digits on any number of ranks and through a restart; periodic boundaries; bodies that leave.
#include "styles/bodies/bodies_scene.h"
#include "styles/bodies/body_rows.h"
#include "support/stl_file.h"

#include "force.h"
#include "pair.h"

#include <gtest/gtest.h>

#include <random>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr int rows = 4, layers = 4;

/// Mixed bodies and spheres fall on a floor and run into each other; two are on their way out of the box.
void fill(LiggghtsSession& session) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  const std::vector<shape::ClusterShape> shapes = {shape_of("cube", "8"), shape_of("disk", "7"), shape_of("cube", "64"),
                                                   shape_of({"smooth", "cube", "rounding", "0.15"}),
                                                   shape_of({"smooth", "disk", "aspect", "0.31", "rounding", "0.5"})};
  int n = 0;
  for (int c = 0; c < layers; ++c)
    for (int a = 0; a < rows; ++a)
      for (int b = 0; b < rows; ++b, ++n) {
        Start start;
        start.position = Eigen::Vector3d((a - 1.5) * 9.5e-3, (b - 1.5) * 9.5e-3, -0.085 + c * 9.5e-3);
        start.velocity = 0.2 * Eigen::Vector3d(normal(random), normal(random), normal(random));
        start.omega = 20 * Eigen::Vector3d(normal(random), normal(random), normal(random));
        start.orientation =
            Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
        if (n % 6 == 5)
          add_sphere(session, start, 3.2e-3);
        else
          add_body(session, shapes[n % 6], start);
      }
  Start leaving;
  leaving.position = Eigen::Vector3d(0.095, 0, 0);
  leaving.velocity = Eigen::Vector3d(1, 0, 0);
  add_body(session, shapes[0], leaving);
  leaving.position = Eigen::Vector3d(0.095, 0.02, 0.0071);
  leaving.velocity = Eigen::Vector3d(0.8, 0, 0);
  add_body(session, shapes[2], leaving);
}

/// A floor, a turning cylinder around the bodies and a ramp of triangles among them.
constexpr const char* forces = R"(
  fix gravity all gravity 9.81 vector 0 0 -1
  fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane -0.1
  fix hole all wall/gran/cluster model hertz tangential history primitive type 1 zcylinder 0.026 0 0 rotate 20
  fix ramp_mesh all mesh/surface file ramp.stl type 1
  fix ramp all wall/gran/cluster model hertz tangential history mesh n_meshes 1 meshes ramp_mesh
  thermo_modify lost ignore
)";

void write_ramp() {
  write_stl_file("ramp.stl",
                 stl_quad({"-0.02 -0.02 -0.1", "0.02 -0.02 -0.095", "0.02 0.02 -0.09", "-0.02 0.02 -0.095"}));
}

constexpr int bodies_at_start = rows * rows * layers + 2;

void expect_identical(const std::vector<BodyRow>& ours, const std::vector<BodyRow>& reference) {
  int different = 0;
  for (std::size_t n = 0; n < reference.size(); ++n)
    different += ours[n] != reference[n];
  EXPECT_EQ(different, 0) << "bodies whose state differs in any bit";
}

std::vector<BodyRow> straight_run(MPI_Comm ranks, int steps) {
  LiggghtsSession session(ranks);
  open_box(session, {});
  use_clusters(session);
  fill(session);
  session.script(forces);
  session.script("timestep 1e-5\nrun " + std::to_string(steps) + "\n");
  EXPECT_EQ(session.atom().natoms, bodies_at_start - 2) << "two bodies have left through the boundary";
  return body_rows(session, bodies_at_start, ranks);
}

} // namespace

TEST(Parallel, AnyNumberOfRanksGivesTheSameDigits) {
  write_ramp();
  constexpr int steps = 6000;
  expect_identical(straight_run(MPI_COMM_WORLD, steps), straight_run(MPI_COMM_SELF, steps));
}

namespace {

/// Goes on from a restart file on these ranks.
void resume(LiggghtsSession& session, const std::string& file) {
  session.script("atom_style granular\natom_modify map array\nboundary f f f\nnewton off\n"
                 "communicate single vel yes\nunits si\nread_restart " +
                 file +
                 "\nneighbor 0.001 bin\nneigh_modify delay 0\n"
                 "fix m1 all property/global youngsModulus peratomtype 5e6\n"
                 "fix m2 all property/global poissonsRatio peratomtype 0.3\n"
                 "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9\n"
                 "fix m4 all property/global coefficientFriction peratomtypepair 1 0.5\n");
  use_clusters(session);
  session.script(forces);
  session.script("timestep 1e-5\n");
}

} // namespace

TEST(Parallel, RestartGivesTheSameDigitsAsAStraightRun) {
  constexpr int half = 3000;
  write_ramp();
  const std::vector<BodyRow> reference = straight_run(MPI_COMM_SELF, 2 * half);
  {
    LiggghtsSession session;
    open_box(session, {});
    use_clusters(session);
    fill(session);
    session.script(forces);
    session.script("timestep 1e-5\nrestart " + std::to_string(half) + " half.restart\nrun " +
                   std::to_string(half + 100) + "\n");
  }
  LiggghtsSession session(MPI_COMM_SELF); // written by all ranks, read by one
  resume(session, "half.restart." + std::to_string(half));
  session.script("run " + std::to_string(half) + "\n");
  expect_identical(body_rows(session, bodies_at_start, MPI_COMM_SELF), reference);
}

TEST(Parallel, RestartGoesOnOnMoreAndMoreRanks) {
  constexpr int part = 1500;
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  write_ramp();
  const std::vector<BodyRow> reference = straight_run(MPI_COMM_SELF, 3 * part);
  const int sizes[] = {1, std::min(2, ranks), ranks};
  for (int n = 0; n < 3; ++n) {
    MPI_Comm some;
    MPI_Comm_split(MPI_COMM_WORLD, rank < sizes[n] ? 0 : MPI_UNDEFINED, rank, &some);
    if (some != MPI_COMM_NULL) {
      LiggghtsSession session(some);
      if (n == 0) {
        open_box(session, {});
        use_clusters(session);
        fill(session);
        session.script(forces);
        session.script("timestep 1e-5\n");
      } else {
        resume(session, "chain.restart." + std::to_string(n * part));
      }
      session.script("restart " + std::to_string((n + 1) * part) + " chain.restart\nrun " +
                     std::to_string(part + (n < 2 ? 10 : 0)) + "\n");
      if (n == 2)
        expect_identical(body_rows(session, bodies_at_start, some), reference);
    }
    if (some != MPI_COMM_NULL)
      MPI_Comm_free(&some);
    MPI_Barrier(MPI_COMM_WORLD);
  }
}

TEST(Parallel, PairsMeetThroughPeriodicBoundariesAsInTheMiddle) {
  const auto run = [](const Eigen::Vector3d& shift) {
    LiggghtsSession session;
    open_box(session, {}, "p p p");
    use_clusters(session);
    Start start;
    start.position = shift + Eigen::Vector3d(-4.5e-3, 0, 0);
    start.velocity.x() = 0.3;
    start.orientation = Eigen::Quaterniond(0.9, 0.1, 0.3, 0.2).normalized();
    add_body(session, shape_of("cube", "27"), start);
    start.position = shift + Eigen::Vector3d(4.5e-3, 1e-3, 5e-4);
    for (int k = 0; k < 3; ++k)
      if (start.position[k] >= 0.1)
        start.position[k] -= 0.2;
    start.velocity.x() = -0.3;
    start.orientation = Eigen::Quaterniond(0.3, 0.8, 0.1, -0.2).normalized();
    add_body(session, shape_of("disk", "19"), start);
    session.script("timestep 2e-6\nrun 8000\n");
    return body_rows(session, 2, MPI_COMM_WORLD);
  };
  const std::vector<BodyRow> middle = run(Eigen::Vector3d::Zero());
  const std::vector<BodyRow> across = run(Eigen::Vector3d(0.0999, 0, 0));
  for (int body = 0; body < 2; ++body)
    for (int k = 3; k < 13; ++k)
      EXPECT_NEAR(across[body][k], middle[body][k], 1e-7 * (k < 10 ? 1 : 100)) << "body " << body << " value " << k;
}
