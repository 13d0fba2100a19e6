// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies where clusters have been tested before: on meshes that move, asleep, in dense fills, at high speed.
#include "bodies_scene.h"
#include "posed_cores.h"

#include "contact/gjk.h"
#include "shape/rounded_hull.h"
#include "support/read_file.h"
#include "support/stl_file.h"

#include "fix.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

using namespace eccentra;
using namespace eccentra::test;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double diameter = 6.35e-3, gravity = 9.81;
const char* const weight = "fix weight all gravity 9.81 vector 0 0 -1\n";

shape::ClusterShape rounded(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  return shape_of(words, diameter);
}

/// A floor at z = 0 of 6 by 6 squares of 10 mm, two triangles each.
void write_floor(const std::string& name) {
  std::vector<std::array<std::string, 3>> triangles;
  const auto at = [](int i, int j) {
    return std::to_string(0.01 * (i - 3)) + " " + std::to_string(0.01 * (j - 3)) + " 0";
  };
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  write_stl_file(name, triangles);
}

/// Position, velocity and angular velocity of the only body, seen from what moves with `frame`.
std::vector<double> seen_from(LiggghtsSession& session, const Vector3d& frame, double time) {
  const Vector3d x = Eigen::Map<Vector3d>(session.atom().x[0]) - frame * time;
  const Vector3d v = Eigen::Map<Vector3d>(session.atom().v[0]) - frame;
  const Vector3d w = Eigen::Map<Vector3d>(session.atom().omega[0]);
  return {x[0], x[1], x[2], v[0], v[1], v[2], w[0], w[1], w[2]};
}

/// A body thrown onto a floor of triangles that moves with the velocity `frame`, or onto a plane at rest, for 0.08 s.
std::vector<double> thrown(const std::string& line, const Vector3d& frame, bool onto_mesh = true) {
  LiggghtsSession session;
  Material material;
  material.restitution = 0.5;
  open_box(session, material);
  use_clusters(session);
  write_floor("moving_floor.stl");
  std::ostringstream script;
  script.precision(17);
  script << weight << "fix mesh all mesh/surface file moving_floor.stl type 1\n"
         << "fix floor all wall/gran/cluster model hertz tangential history "
         << (onto_mesh ? "mesh n_meshes 1 meshes mesh\n" : "primitive type 1 zplane 0\n");
  if (frame.norm() > 0)
    script << "fix move all move/mesh mesh mesh linear " << frame[0] << " " << frame[1] << " " << frame[2] << "\n";
  session.script(script.str());
  Start start;
  start.position = {-0.012, -3.3e-3, 6e-3};
  start.velocity = frame + Vector3d(0.4, 0.15, -0.2);
  start.omega = {5, -3, 8};
  start.orientation = Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, 2, 0.5).normalized()));
  add_body(session, rounded(line), start);
  session.script("timestep 1e-5\nrun 8000\n");
  return seen_from(session, frame, 0.08);
}

} // namespace

// A flat floor of triangles is the plane; and Galilei: one that moves is one at rest, seen from it.
TEST(SmoothEverywhere, AMeshIsThePlaneAndOneThatMovesIsOneAtRest) {
  for (const char* line :
       {"smooth cube rounding .15", "smooth box 1 1 2 rounding .4", "smooth disk aspect .31 rounding .5"}) {
    const auto at_rest = thrown(line, Vector3d::Zero());
    EXPECT_GT(at_rest[0], -8e-3) << "it has come some way, over the edges of triangles";
    const auto on_plane = thrown(line, Vector3d::Zero(), false);
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(at_rest[k], on_plane[k],
                  k < 3   ? 1e-8
                  : k < 6 ? 1e-6
                          : 1e-3)
          << line << " on a plane, component " << k;
    for (const Vector3d& frame : {Vector3d(0.2, 0, 0), Vector3d(-0.1, 0.15, 0), Vector3d(0.05, -0.1, 0.1)}) {
      const auto moving = thrown(line, frame);
      for (int k = 0; k < 9; ++k)
        EXPECT_NEAR(moving[k], at_rest[k], k < 3 ? 1e-8 : k < 6 ? 1e-6 : 1e-3) << line << ", component " << k;
    }
  }
}

// A bed of rounded bodies, clusters and spheres falls asleep, the floor carries its weight, and a tilt wakes all.
TEST(SmoothEverywhere, ABedSleepsAndWakes) {
  LiggghtsSession session;
  session.script(granular_box("0 0.024 0 0.024 -0.01 0.06", "p p f") + granular_material(Material{5e6, 0.5, 0.5, 0.3}));
  use_clusters(session);
  session.script(std::string(weight) +
                 "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0\n"
                 "fix sleep all sleep/cluster tolerance 0.01\ntimestep 2e-5\n");
  const std::vector<shape::ClusterShape> shapes = {rounded("smooth cube rounding .15"), shape_of("cube", "8"),
                                                   rounded("smooth box 1 1 2 rounding .4")};
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, 1);
  constexpr int bodies = 36;
  for (int n = 0; n < bodies; ++n) {
    Start start;
    const int row = n / 3 % 3, layer = n / 9;
    start.position = 8e-3 * Vector3d(n % 3 + 0.5, row + 0.5, layer + 0.7);
    start.orientation = Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    if (n % 4 == 3)
      add_sphere(session, start, diameter / 2);
    else
      add_body(session, shapes[n % 4], start);
  }
  const auto output = [&](const char* fix, int n) {
    return session.lammps().modify->find_fix_id(fix)->compute_vector(n);
  };
  session.command("run 0");
  for (int k = 0; k < 20 && output("sleep", 0) < bodies; ++k)
    session.command("run 2500");
  EXPECT_EQ(output("sleep", 0), bodies);
  double mass = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    mass += session.atom().rmass[i];
  EXPECT_NEAR(-output("floor", 2), mass * gravity, 0.01 * mass * gravity);
  session.script("unfix weight\nfix weight all gravity 9.81 vector 0.5 0 -0.866025403784\nrun 50\n");
  EXPECT_EQ(output("sleep", 0), 0);
}

// A fill as dense as one of spheres, which then falls: no body runs away, none is left in another.
TEST(SmoothEverywhere, ADenseFillFallsAndSettles) {
  LiggghtsSession session;
  open_box(session, Material{5e6, 0.5, 0.5, 0.3});
  use_clusters(session);
  session.script(std::string(weight) +
                 "fix pts all particletemplate/cluster 15485863 atom_type 1 density constant 2619 "
                 "shape smooth cube rounding .15 diameter 6.35e-3\n"
                 "fix pdd all particledistribution/discrete 32452843 1 pts 1.0\n"
                 "region pack cylinder z 0 0 0.02 0.0001 0.05 units box\n"
                 "fix ins all insert/pack seed 86028121 distributiontemplate pdd maxattempt 2000 insert_every once "
                 "overlapcheck yes all_in yes verbose no volumefraction_region 0.45 region pack\n"
                 "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0\n"
                 "fix hole all wall/gran/cluster model hertz tangential history primitive type 1 zcylinder 0.02 0 0\n"
                 "timestep 1e-5\nrun 1\n");
  const int count = static_cast<int>(session.atom().natoms);
  const double share = count * M_PI / 6 * std::pow(diameter, 3) / (M_PI * 0.02 * 0.02 * 0.05);
  std::printf("%d cubes of rounding 0.15 inserted, %.2f of the room\n", count, share);
  EXPECT_GT(share, 0.25);
  double fastest = 0;
  for (int k = 0; k < 40; ++k) {
    session.command("run 500");
    for (int i = 0; i < count; ++i)
      fastest = std::max(fastest, Eigen::Map<Vector3d>(session.atom().v[i]).norm());
  }
  EXPECT_LT(fastest, std::sqrt(2 * gravity * 0.05)) << "none is faster than a free fall from the top";
  const std::vector<contact::PosedCore> posed = posed_cores(session);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      const Vector3d offset = Eigen::Map<Vector3d>(session.atom().x[j]) - Eigen::Map<Vector3d>(session.atom().x[i]);
      if (offset.norm() < 2 * posed[0].core->bound) {
        EXPECT_GT(contact::gjk_distance(posed[i], posed[j], offset), 0) << "cores of " << i << " and " << j;
      }
    }
}

// An impact that is too hard for the radius of the edges is computed, and said.
TEST(SmoothEverywhere, CoresThatMeetAreSaid) {
  for (const double speed : {1., 20.}) {
    LiggghtsSession session;
    session.command("log sunk.log");
    open_box(session, Material{5e6, 0.5, 0.5, 0.3});
    use_clusters(session);
    const shape::ClusterShape cube = rounded("smooth cube rounding .15");
    for (int k = 0; k < 2; ++k) {
      Start start;
      start.position.z() = (k ? 1.05 : -1.05) * cube.bounding_radius();
      start.velocity.z() = k ? -speed / 2 : speed / 2;
      start.orientation = Quaterniond(Eigen::AngleAxisd(0.3 + k, Vector3d(1, k, 0.2).normalized()));
      add_body(session, cube, start);
    }
    session.script("timestep 2e-6\nrun " + std::to_string(static_cast<int>(0.01 / speed / 2e-6)) + "\n");
    session.command("log none");
    const std::string log = contents("sunk.log");
    EXPECT_EQ(log.find("overlap by more than the radii of their edges") != std::string::npos, speed > 10) << log;
    EXPECT_LT(session.atom().v[0][2], session.atom().v[1][2]) << "they have bounced";
  }
}
