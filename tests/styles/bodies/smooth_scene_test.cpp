// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies in LIGGGHTS: impacts, balls, walls, mixed scenes, insertion, restart.
#include "bodies_scene.h"
#include "posed_cores.h"

#include "contact/gjk.h"
#include "shape/drawn_surface.h"
#include "shape/rounded_hull.h"
#include "support/stl_file.h"

#include "compute.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

using namespace eccentra;
using namespace eccentra::test;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double diameter = 6.35e-3;

shape::ClusterShape shape_from(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  std::size_t used = 0;
  return shape::make_shape(words, 0, used, diameter);
}

/// Relative velocity after over before of a body that runs into its mirror image.
double bounce(const Quaterniond& orientation, double restitution) {
  LiggghtsSession session;
  Material material;
  material.restitution = restitution;
  open_box(session, material);
  use_clusters(session);
  const shape::ClusterShape cube = shape_from("smooth cube rounding .15");
  double reach = 0;
  for (const auto& s : cube.spheres())
    reach = std::max(reach, (orientation * s.centre).z() + s.radius);
  Start start[2];
  for (int k = 0; k < 2; ++k) {
    start[k].orientation = k ? Quaterniond(Eigen::AngleAxisd(M_PI, Vector3d::UnitX())) * orientation : orientation;
    start[k].position.z() = (k ? 1 : -1) * (reach + 5e-6);
    start[k].velocity.z() = k ? -0.1 : 0.1;
    add_body(session, cube, start[k]);
  }
  session.script("timestep 2e-6\nrun 0\n");
  const auto closing = [&] { return session.atom().v[session.local(2)][2] - session.atom().v[session.local(1)][2]; };
  double last = 0;
  int steps = 0;
  do {
    last = closing();
    session.command("run 100 pre no post no");
    steps += 100;
  } while ((closing() != last || last < 0) && steps < 30000);
  return closing() / 0.2;
}

} // namespace

TEST(SmoothScene, RestitutionIsWhatWasAskedFor) {
  const Quaterniond edge(Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitX()));
  for (const double e : {0.9, 0.5}) {
    EXPECT_NEAR(bounce(Quaterniond::Identity(), e), e, 1e-3) << "face";
    EXPECT_NEAR(bounce(edge, e), e, 1e-3) << "edge";
  }
}

// Elastic, without friction, anyhow.
TEST(SmoothScene, ElasticImpactsKeepEnergy) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0, 1);
  const auto direction = [&] { return Vector3d(normal(random), normal(random), normal(random)).normalized(); };
  for (const char* line : {"smooth cube rounding .15", "smooth disk aspect .31 rounding .5"})
    for (int n = 0; n < 6; ++n) {
      LiggghtsSession session;
      Material material;
      material.restitution = 1;
      material.friction = 0;
      open_box(session, material);
      use_clusters(session);
      const shape::ClusterShape body = shape_from(line);
      Start a, b;
      b.position.z() = 2.02 * body.bounding_radius();
      b.velocity.z() = -0.2;
      a.omega = 20 * direction();
      b.omega = 20 * direction();
      for (Start* s : {&a, &b})
        s->orientation = Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
      add_body(session, body, a);
      add_body(session, body, b);
      session.script("timestep 2e-6\nrun 0\n");
      const double before = kinetic_energy(session);
      session.command("run 15000 post no");
      const double apart =
          (Eigen::Map<Vector3d>(session.atom().x[0]) - Eigen::Map<Vector3d>(session.atom().x[1])).norm();
      if (apart > 2 * body.bounding_radius()) {
        EXPECT_NEAR(kinetic_energy(session) / before, 1, 2e-6) << line;
      }
      EXPECT_FALSE(std::isnan(apart));
    }
}

// A body of rounding 1 is a ball: the same digits as those of the cluster of one sphere.
TEST(SmoothScene, RoundingOneIsASphere) {
  std::vector<double> end[2];
  for (int way = 0; way < 2; ++way) {
    LiggghtsSession session;
    open_box(session, Material());
    use_clusters(session);
    const shape::ClusterShape ball = way ? shape_from("smooth cube rounding 1") : shape_of("sphere", "1");
    Start a, b;
    b.position = {1e-3, 0, 6.4e-3};
    b.velocity = {0, 0.05, -0.3};
    a.omega = {10, 20, 30};
    add_body(session, ball, a);
    add_body(session, ball, b);
    session.script("timestep 1e-5\nrun 1000\n");
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 3; ++k)
        end[way].push_back(session.atom().x[i][k] + session.atom().omega[i][k]);
  }
  for (std::size_t k = 0; k < end[0].size(); ++k)
    EXPECT_NEAR(end[0][k], end[1][k], 1e-9 * std::abs(end[0][k]) + 1e-12);
}

// On a floor, in a hole, on a pipe.
TEST(SmoothScene, Walls) {
  Material material;
  material.restitution = 0.5;
  for (const char* line : {"smooth cube rounding .15", "smooth disk aspect .31 rounding .5"}) {
    LiggghtsSession session;
    open_box(session, material);
    use_clusters(session);
    session.script("fix gravity all gravity 9.81 vector 0 0 -1\n"
                   "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0\n");
    const shape::ClusterShape body = shape_from(line);
    Start start;
    start.position.z() = body.bounding_radius();
    start.orientation = Quaterniond(Eigen::AngleAxisd(0.3, Vector3d(1, 0.7, 0).normalized()));
    add_body(session, body, start);
    session.script("timestep 2e-5\nrun 40000\n");
    // Springs of Hertz's law in parallel.
    const int springs = body.hull()->disk() ? 12 : 4;
    const double thick = body.hull()->support({0, 0, 1}).z() + body.hull()->radius(),
                 weight = 2619 * body.volume() * 9.81, youngs = material.youngs / (2 * (1 - 0.3 * 0.3)),
                 sag = std::pow(weight / springs / (4. / 3 * youngs * std::sqrt(body.hull()->radius())), 2. / 3);
    EXPECT_NEAR(session.atom().x[0][2], thick - sag, 1e-3 * sag) << line;
    EXPECT_LT(Eigen::Map<Vector3d>(session.atom().v[0]).norm(), 1e-7);
    EXPECT_EQ(session.lammps().modify->find_fix_id("floor")->compute_scalar(), springs);
  }
  LiggghtsSession session;
  open_box(session, Material());
  use_clusters(session);
  session.script(
      "fix gravity all gravity 9.81 vector 0 0 -1\n"
      "fix pipe all wall/gran/cluster model hertz tangential history primitive type 1 ycylinder 0.003 0 0\n");
  const shape::ClusterShape cube = shape_from("smooth cube rounding .15");
  Start start;
  const double half = cube.hull()->support({0, 0, 1}).z() + cube.hull()->radius();
  start.position.z() = 0.003 + half - 1e-6;
  add_body(session, cube, start);
  session.script("timestep 2e-5\nrun 500\n");
  EXPECT_EQ(session.lammps().modify->find_fix_id("pipe")->compute_scalar(), 2); // two edges across the pipe
  EXPECT_NEAR(session.atom().x[0][2], 0.003 + half, 1e-2 * half);
}

/// Cubes, disks, a cluster and spheres fall on a floor.
void fill(LiggghtsSession& session) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  const std::vector<shape::ClusterShape> shapes = {shape_from("smooth cube rounding .15"),
                                                   shape_from("smooth disk aspect .31 rounding .5"),
                                                   shape_of("cube", "8"), shape_from("smooth box 1 2 3 rounding .3")};
  for (int n = 0; n < 30; ++n) {
    Start start;
    start.position = {(n % 3 - 1) * 9.6e-3, (n / 3 % 3 - 1) * 9.6e-3, 6e-3 + n / 9 * 9.6e-3};
    start.velocity = 0.2 * Vector3d(normal(random), normal(random), normal(random));
    start.omega = 20 * Vector3d(normal(random), normal(random), normal(random));
    start.orientation = Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    if (n % 5 == 4)
      add_sphere(session, start, 3.2e-3);
    else
      add_body(session, shapes[n % 5], start);
  }
}
constexpr const char* forces =
    "fix gravity all gravity 9.81 vector 0 0 -1\n"
    "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0\n"
    "fix hole all wall/gran/cluster model hertz tangential history primitive type 1 zcylinder 0.02 0 0\n"
    "timestep 2e-5\n";

TEST(SmoothScene, MixedBedSettlesAndRestartsToTheDigit) {
  std::vector<double> end[2];
  for (int way = 0; way < 2; ++way) {
    LiggghtsSession session;
    if (way == 0) {
      open_box(session, Material());
      use_clusters(session);
      fill(session);
      session.script(forces);
      session.script("run 3000\nwrite_restart smooth.restart\nrun 3000\n");
    } else {
      session.script("atom_style granular\natom_modify map array\nboundary f f f\nnewton off\n"
                     "communicate single vel yes\nunits si\nread_restart smooth.restart\n"
                     "neighbor 0.001 bin\nneigh_modify delay 0\n"
                     "fix m1 all property/global youngsModulus peratomtype 5e6\n"
                     "fix m2 all property/global poissonsRatio peratomtype 0.3\n"
                     "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9\n"
                     "fix m4 all property/global coefficientFriction peratomtypepair 1 0.5\n");
      use_clusters(session);
      session.script(forces);
      session.script("run 3000\n");
    }
    for (int tag = 1; tag <= 30; ++tag) {
      const int i = session.local(tag);
      ASSERT_GE(i, 0);
      for (int k = 0; k < 3; ++k) {
        end[way].push_back(session.atom().x[i][k]);
        EXPECT_TRUE(std::isfinite(session.atom().x[i][k]));
      }
      EXPECT_GT(session.atom().x[i][2], 0);
      EXPECT_LT(std::hypot(session.atom().x[i][0], session.atom().x[i][1]), 0.02);
    }
  }
  EXPECT_EQ(end[0], end[1]);
}

// Rows of compute contact/cluster/local add up to the forces on the bodies, with those that hand a spring over.
TEST(SmoothScene, RowsOfContactsAddUp) {
  LiggghtsSession session;
  open_box(session, Material());
  use_clusters(session);
  fill(session);
  session.script(forces);
  session.script("compute c all contact/cluster/local of all id force torque delta contactArea\n"
                 "compute rows all reduce sum c_c[1]\nthermo_style custom step c_rows\nthermo 100\nrun 15000\n");
  const LAMMPS_NS::Compute& contacts = *session.lammps().modify->compute[session.lammps().modify->find_compute("c")];
  const int bodies = session.atom().nlocal;
  std::vector<Vector3d> sum(bodies, Vector3d::Zero());
  int rows = 0;
  // Columns: id 0-2, force 3-5, torque 6-8, area 9, overlap 10.
  for (int n = 0; n < contacts.size_local_rows; ++n) {
    const double* row = contacts.array_local[n];
    const Vector3d force(row[3], row[4], row[5]);
    sum[session.local(static_cast<int>(row[0]))] += force;
    if (row[1] > 0) {
      sum[session.local(static_cast<int>(row[1]))] -= force;
      // Of two spheres that overlap a little: 2 pi R* delta; radii from a cube's corners to the spheres'.
      EXPECT_GT(row[9], 2 * M_PI * 1e-4 * row[10]);
      EXPECT_LT(row[9], 2 * M_PI * 2e-3 * row[10]);
    }
    ++rows;
  }
  EXPECT_GT(rows, 40);
  for (int i = 0; i < bodies; ++i) {
    if (session.atom().tag[i] % 5 == 2) // disks: walls do not list their elastic forces
      continue;
    Vector3d acting = Eigen::Map<Vector3d>(session.atom().f[i]);
    acting.z() += 9.81 * session.atom().rmass[i];
    EXPECT_LT((sum[i] - acting).norm(), 1e-10) << session.atom().tag[i];
  }
}

// The ridge of a mesh under the middle of a face: the edges of the face bounce off it as off a body.
TEST(SmoothScene, RidgeOfAMesh) {
  const std::string points[6] = {"-0.02 -0.02 -0.02", "-0.02 0.02 -0.02", "0 -0.02 0",
                                 "0 0.02 0",          "0.02 -0.02 -0.02", "0.02 0.02 -0.02"};
  write_stl_file("ridge.stl", {{points[0], points[2], points[1]},
                               {points[1], points[2], points[3]},
                               {points[2], points[4], points[3]},
                               {points[3], points[4], points[5]}});
  LiggghtsSession session;
  Material material;
  material.restitution = 1;
  material.friction = 0;
  open_box(session, material);
  use_clusters(session);
  session.script("fix mesh all mesh/surface file ridge.stl type 1\n"
                 "fix ridge all wall/gran/cluster model hertz tangential history mesh n_meshes 1 meshes mesh\n");
  const shape::ClusterShape cube = shape_from("smooth cube rounding .15");
  const double half = cube.hull()->support({0, 0, 1}).z() + cube.hull()->radius();
  Start start;
  start.position = {0, 0, half + 1e-5};
  start.velocity.z() = -0.2;
  add_body(session, cube, start);
  session.script("timestep 2e-6\nrun 0\n");
  int most = 0;
  for (int k = 0; k < 40 && session.atom().v[0][2] < 0.1999; ++k) {
    session.command("run 50 pre no post no");
    most = std::max(most, static_cast<int>(session.lammps().modify->find_fix_id("ridge")->compute_scalar()));
  }
  EXPECT_EQ(most, 2);
  EXPECT_NEAR(session.atom().v[0][2], 0.2, 1e-5);
  EXPECT_LT(Eigen::Map<Vector3d>(session.atom().omega[0]).norm(), 1e-6);
}

// A file of dump cluster/vtk has the surface of a rounded body beside the sub-spheres of a cluster.
TEST(SmoothScene, DumpOfSurfaces) {
  LiggghtsSession session;
  open_box(session, Material());
  use_clusters(session);
  const shape::ClusterShape cube = shape_from("smooth cube rounding .15");
  Start start;
  add_body(session, cube, start);
  start.position.x() = 0.02;
  add_body(session, shape_of("cube", "8"), start);
  session.script("dump d all cluster/vtk 1 smooth_*.vtp\nrun 0\n");
  std::ifstream file("smooth_0.vtp", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  const shape::TriangleSurface surface = shape::drawn_surface(*cube.hull(), 3);
  EXPECT_NE(text.str().find("NumberOfPoints=\"" + std::to_string(surface.points.size() + 8) + "\""), std::string::npos);
  EXPECT_NE(text.str().find("NumberOfPolys=\"" + std::to_string(surface.triangles.size()) + "\""), std::string::npos);
  EXPECT_NE(text.str().find("NumberOfVerts=\"8\""), std::string::npos);
}

// insert/pack places them by their true surfaces: closer than bounding spheres, none in another.
TEST(SmoothScene, InsertionByTrueSurfaces) {
  LiggghtsSession session;
  open_box(session, Material());
  use_clusters(session);
  session.script("fix pts all particletemplate/cluster 15485863 atom_type 1 density constant 2619 "
                 "shape smooth cube rounding .15 diameter 6.35e-3\n"
                 "fix pdd all particledistribution/discrete 15485867 1 pts 1.0\n"
                 "region pack block -0.02 0.02 -0.02 0.02 -0.02 0.02 units box\n"
                 "fix ins all insert/pack seed 32452843 distributiontemplate pdd maxattempt 2000 insert_every once "
                 "overlapcheck yes all_in yes volumefraction_region 0.3 region pack\nrun 1\n");
  const int count = static_cast<int>(session.atom().natoms);
  EXPECT_GT(count, 100);
  const std::vector<contact::PosedCore> posed = posed_cores(session);
  int inside = 0; // bounding spheres that overlap
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      const Vector3d offset = Eigen::Map<Vector3d>(session.atom().x[j]) - Eigen::Map<Vector3d>(session.atom().x[i]);
      if (offset.norm() > 2 * posed[0].core->bound)
        continue;
      ++inside;
      EXPECT_GT(contact::gjk_distance(posed[i], posed[j], offset), 2 * posed[0].core->radius - 1e-9);
    }
  EXPECT_GT(inside, 0);
}
