// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Plain spheres on triangle meshes: stock's own trajectory at rest, the right spin in a turning drum.
#include "styles/walls/wall_scene.h"

#include "fix.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using eccentra::test::LiggghtsSession;
using eccentra::test::state_of;
using eccentra::test::wall_scene;

namespace {

constexpr double kDiameter = 6.35e-3;
constexpr double kRadius = kDiameter / 2;

class Stl {
 public:
  explicit Stl(const std::string& path) : file_(path) { file_ << "solid wall\n"; }
  ~Stl() { file_ << "endsolid wall\n"; }
  void quad(const double* a, const double* b, const double* c, const double* d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

 private:
  void triangle(const double* a, const double* b, const double* c) {
    file_ << "facet normal 0 0 0\nouter loop\n";
    for (const double* p : {a, b, c})
      file_ << "vertex " << p[0] << " " << p[1] << " " << p[2] << "\n";
    file_ << "endloop\nendfacet\n";
  }
  std::ofstream file_;
};

/// A floor at z = -0.095 of 8 by 8 squares, two triangles each.
void write_floor(const std::string& path) {
  Stl stl(path);
  constexpr int kCells = 8;
  constexpr double kSide = 0.18;
  const auto at = [](int i) { return -kSide / 2 + kSide * i / kCells; };
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const double a[] = {at(i), at(j), -0.095}, b[] = {at(i + 1), at(j), -0.095};
      const double c[] = {at(i + 1), at(j + 1), -0.095}, d[] = {at(i), at(j + 1), -0.095};
      stl.quad(a, b, c, d);
    }
}

/// A tube of radius r about z whose facets touch that radius from outside.
void write_tube(const std::string& path, double r) {
  Stl stl(path);
  constexpr int kFacets = 96;
  const double corner = r / std::cos(M_PI / kFacets);
  for (int i = 0; i < kFacets; ++i) {
    const double p = 2 * M_PI * i / kFacets, q = 2 * M_PI * (i + 1) / kFacets;
    const double a[] = {corner * std::cos(p), corner * std::sin(p), -0.05};
    const double b[] = {corner * std::cos(q), corner * std::sin(q), -0.05};
    const double c[] = {b[0], b[1], 0.05}, d[] = {a[0], a[1], 0.05};
    stl.quad(a, b, c, d);
  }
}

void on_one_rank(LiggghtsSession& session, void (*write)(const std::string&), const std::string& path) {
  if (session.rank() == 0)
    write(path);
  MPI_Barrier(MPI_COMM_WORLD);
}

} // namespace

TEST(WallMeshes, TrajectoryOverTriangleEdgesIsStocks) {
  const auto thrown = [](const std::string& style) {
    LiggghtsSession session;
    on_one_rank(session, write_floor, "floor.stl");
    session.script(wall_scene(1e-5));
    session.script(R"(
      create_atoms 1 single -0.06 0.013 -0.0915 units box
      set group all diameter 6.35e-3 density 2619
      velocity all set 0.5 0.11 -0.1
      fix gravity all gravity 9.81 vector 0 0 -1
      fix floor all mesh/surface file floor.stl type 2
      fix wall all )" +
                   style + R"( mesh n_meshes 1 meshes floor
      fix integrate all nve/sphere
      run 20000
    )");
    return state_of(session, 1);
  };
  const auto ours = thrown("wall/gran/cluster model hertz tangential history contacts parallel");
  const auto stock = thrown("wall/gran model hertz tangential history");
  for (int k = 0; k < 9; ++k)
    EXPECT_NEAR(ours[k], stock[k], 1e-9 * (k < 3 ? 1e-3 : k < 6 ? 0.1 : 10.0)) << "component " << k;
  EXPECT_GT(ours[0], 0.0); // it has come far
  EXPECT_NE(ours[7], 0.0);
}

TEST(WallMeshes, TurningDrumSpinsAHeldSphereAndFeelsTheReaction) {
  constexpr double kDrum = 0.06;
  LiggghtsSession session;
  on_one_rank(
      session, [](const std::string& path) { write_tube(path, kDrum); }, "tube.stl");
  session.script(wall_scene(1e-5));
  session.script("create_atoms 1 single " + std::to_string(kDrum - kRadius + 4e-6) + R"( 0.0005 0.001 units box
    set group all diameter 6.35e-3 density 2619
    fix tube all mesh/surface file tube.stl type 2
    fix move all move/mesh mesh tube rotate origin 0 0 0 axis 0 0 1 period 1.2
    fix wall all wall/gran/cluster model hertz tangential history rolling_friction cdt mesh n_meshes 1 meshes tube
    fix integrate all nve/sphere
    fix hold all setforce 0 0 0
    run 20000
  )");
  // Facets come and go within 0.03 mm; rolling friction cannot hold the sphere back for good.
  const double expected = 2 * M_PI / 1.2 * kDrum / kRadius;
  EXPECT_NEAR(state_of(session, 1)[8], expected, 0.01 * expected);
}

TEST(WallMeshes, ForceOnTheMeshIsTheWeightAtRest) {
  LiggghtsSession session;
  on_one_rank(session, write_floor, "floor.stl");
  session.script(wall_scene(1e-5, "0.3"));
  session.script(R"(
    create_atoms 1 single 0.011 0.013 -0.0919 units box
    set group all diameter 6.35e-3 density 2619
    fix gravity all gravity 9.81 vector 0 0 -1
    fix floor all mesh/surface/stress file floor.stl type 2
    fix wall all wall/gran/cluster model hertz tangential history mesh n_meshes 1 meshes floor
    fix integrate all nve/sphere
    run 20000
  )");
  auto fix = [&](const char* id) { return session.lammps().modify->fix[session.lammps().modify->find_fix(id)]; };
  const double weight = 2619 * M_PI / 6 * kDiameter * kDiameter * kDiameter * 9.81;
  EXPECT_NEAR(fix("wall")->compute_vector(2), -weight, 1e-3 * weight);
  EXPECT_NEAR(fix("floor")->compute_vector(2), -weight, 1e-3 * weight); // stock's own stress output hears of us
  EXPECT_EQ(fix("wall")->compute_scalar(), 1.0);
}
