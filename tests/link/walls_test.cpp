// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walls of a script against patches of a mesh: what agrees whatever the cells, what is refused, what is only said.
#include "link/triangle_tree.h"
#include "link/wall_comparison.h"
#include "link/wall_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace eccentra::link;

const double kPi = std::acos(-1.0);
constexpr double kHole = 0.0635, kPipe = 0.02413, kOffset = -0.019685, kLength = 0.3, kSpin = 5.235988;

struct Round {
  double radius, y, low = 0, high = kLength;
  int around = 32, along = 4;
  double spin = 0, slide = 0;
  double corners = 1; ///< radius of the corners, in radii
};

Vector3 on(const Round& r, double angle, double z) {
  return {r.corners * r.radius * std::cos(angle), r.y + r.corners * r.radius * std::sin(angle), z};
}

MeshPatch patch(const std::string& name, const Round& r) {
  MeshPatch made{name, true, true, {}};
  for (int i = 0; i < r.around; ++i)
    for (int j = 0; j < r.along; ++j) {
      const double a = 2 * kPi * i / r.around, b = 2 * kPi * (i + 1) / r.around;
      const double z0 = r.low + (r.high - r.low) * j / r.along, z1 = r.low + (r.high - r.low) * (j + 1) / r.along;
      PatchFace face;
      face.corners = {on(r, a, z0), on(r, b, z0), on(r, b, z1), on(r, a, z1)};
      double x = 0, y = 0;
      for (const Vector3& c : face.corners) {
        x += c[0] / 4;
        y += (c[1] - r.y) / 4;
      }
      face.velocity = {-r.spin * y, r.spin * x, r.slide};
      made.faces.push_back(face);
    }
  return made;
}

TriangleWall triangles(const std::string& id, const MeshPatch& of) {
  TriangleWall made;
  made.id = id;
  made.name = "mesh '" + id + "'";
  for (const PatchFace& f : of.faces) {
    made.corners.push_back({f.corners[0], f.corners[1], f.corners[2]});
    made.corners.push_back({f.corners[0], f.corners[2], f.corners[3]});
  }
  return made;
}

void turn(TriangleWall& mesh, double y, double spin) {
  for (const auto& corners : mesh.corners) {
    auto& velocity = mesh.velocities.emplace_back();
    for (int k = 0; k < 3; ++k)
      velocity[k] = {-spin * (corners[k][1] - y), spin * corners[k][0], 0};
  }
}

PrimitiveWall cylinder(const std::string& id, double radius, double y, double spin = 0, double slide = 0) {
  return {id,
          "fix " + id + " (cylinder)",
          PrimitiveWall::Form::cylinder,
          {0, y, 0},
          {0, 0, 1},
          radius,
          {0, 0, slide},
          {0, 0, spin}};
}

PrimitiveWall plane(const std::string& id, int axis, double at, const Vector3& velocity = {}) {
  PrimitiveWall wall{id, "fix " + id + " (plane)", PrimitiveWall::Form::plane, {}, {}, 0, velocity, {}};
  wall.point[axis] = at;
  wall.direction[axis] = 1;
  return wall;
}

/// One side of a box from 0 to 1.
PatchFace side(int axis, double at, const Vector3& velocity = {}) {
  PatchFace face;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  for (const auto& [u, v] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}}) {
    Vector3 x{};
    x[axis] = at;
    x[a] = u;
    x[b] = v;
    face.corners.push_back(x);
  }
  face.velocity = velocity;
  return face;
}

MeshPatch flat(const std::string& name, std::vector<PatchFace> faces) {
  return {name, true, true, std::move(faces)};
}

std::vector<MeshPatch> annulus(int around) {
  Round hole{kHole, 0}, pipe{kPipe, kOffset};
  hole.around = pipe.around = around;
  pipe.spin = kSpin;
  return {patch("hole", hole), patch("pipe", pipe)};
}

WallDescription script(double hole = kHole, double pipe = kPipe, double y = kOffset, double spin = kSpin) {
  WallDescription walls;
  walls.primitives = {cylinder("bore", hole, 0), cylinder("string", pipe, y, spin)};
  return walls;
}

WallVerdict compare(const WallDescription& dem, const std::vector<MeshPatch>& mesh, const std::string& apart = "") {
  return compare_walls(dem, mesh, [&apart](const std::string& name) { return name == apart; });
}

void expect_same(const WallDescription& dem, const std::vector<MeshPatch>& mesh) {
  const WallVerdict verdict = compare(dem, mesh);
  EXPECT_EQ(verdict.refusal, "");
  EXPECT_EQ(verdict.news, "");
}

void expect_refused(const WallDescription& dem, const std::vector<MeshPatch>& mesh,
                    const std::vector<std::string>& parts) {
  const std::string text = compare(dem, mesh).refusal;
  EXPECT_FALSE(text.empty()) << "accepted; expected " << parts.front();
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
  EXPECT_LT(text.size(), 512u);
}

} // namespace

TEST(Walls, MeshesOfAnyFinenessAgree) {
  for (const int around : {8, 12, 16, 24, 48, 96})
    expect_same(script(), annulus(around));
  // Corners moved outwards so that the area is that of the circle, and faces that touch it from outside.
  for (const int around : {8, 16, 48}) {
    const double half = kPi / around;
    for (const double corners : {std::sqrt(half / (std::sin(half) * std::cos(half))), 1 / std::cos(half)}) {
      Round hole{kHole, 0};
      hole.around = around;
      hole.corners = corners;
      WallDescription walls;
      walls.primitives = {cylinder("bore", kHole, 0)};
      expect_same(walls, {patch("hole", hole)});
    }
  }
}

TEST(Walls, OtherRadiusAxisSpinOrSlideIsRefusedWithBothValues) {
  const std::vector<MeshPatch> mesh = annulus(32);
  for (const double radius : {0.0675, 0.055, 0.0645, 0.0625})
    expect_refused(script(radius), mesh, {"fix bore (cylinder)", "patch 'hole'", "0.0635 m", "wallsApart"});
  for (const double radius : {0.019, 0.023, 0.0245, 0.03})
    expect_refused(script(kHole, radius), mesh, {"fix string (cylinder)", "patch 'pipe'", "0.02413 m"});
  for (const double y : {0.019685, 0.0, -0.0187, -0.0215})
    expect_refused(script(kHole, kPipe, y), mesh, {"fix string", "patch 'pipe'", "y = -0.019685 m"});
  for (const double spin : {0.0, -kSpin, 5.5, 0.5236})
    expect_refused(script(kHole, kPipe, kOffset, spin), mesh, {"turns at", "fix string", "at 5.23599 rad/s"});
  WallDescription sliding = script();
  sliding.primitives[1].velocity[2] = 0.2;
  expect_refused(sliding, mesh, {"slides at 0.2 m/s", "at 0 m/s"});
  // Both at once, and the two exchanged.
  expect_refused(script(0.0675, 0.03), mesh, {"of the mesh is a cylinder"});
}

TEST(Walls, WhatIsTypedWithFourDigitsAgrees) {
  expect_same(script(0.06351, 0.0241, -0.01970, 5.24), annulus(48));
}

TEST(Walls, PlanesOfABox) {
  const Vector3 lid{0, 0.3, 0};
  std::vector<PatchFace> six;
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {0.0, 1.0})
      six.push_back(side(axis, at));
  const std::vector<MeshPatch> one_patch = {flat("walls", six)};
  WallDescription walls;
  for (int axis = 0; axis < 3; ++axis)
    for (const int at : {0, 1})
      walls.primitives.push_back(plane(std::string(1, "xyz"[axis]) + std::to_string(at), axis, at));
  expect_same(walls, one_patch);
  for (std::size_t k = 0; k < 6; ++k) {
    WallDescription moved = walls;
    moved.primitives[k].point[k / 2] += 0.05;
    expect_refused(moved, one_patch, {"fix " + moved.primitives[k].id, "patch 'walls'", "the plane "});
  }
  WallDescription tilted = walls;
  tilted.primitives[5].direction = {0.1, 0, 0.995};
  expect_refused(tilted, one_patch, {"the plane through (", "z = 1 m"});
  // A lid that moves on one side only, another way, or the same way.
  std::vector<MeshPatch> driven = one_patch;
  driven[0].faces[5].velocity = lid;
  expect_refused(walls, driven, {"fix z1", "(0 0 0) m/s", "(0 0.3 0) m/s"});
  WallDescription same = walls;
  same.primitives[5].velocity = lid;
  expect_same(same, driven);
  same.primitives[5].velocity = {0.3, 0, 0};
  expect_refused(same, driven, {"(0.3 0 0) m/s", "(0 0.3 0) m/s"});
}

TEST(Walls, SlipWallsAndOpeningsHaveAPlaceButNoVelocity) {
  std::vector<MeshPatch> mesh = {flat("floor", {side(2, 0, {1, 0, 0})}), flat("outlet", {side(2, 1)})};
  mesh[0].velocity_known = mesh[1].velocity_known = mesh[1].wall = false;
  WallDescription walls;
  walls.primitives = {plane("floor", 2, 0), plane("stop", 2, 1)};
  expect_same(walls, mesh);
  walls.primitives[1].point[2] = 0.7; // a stop in front of an opening
  EXPECT_EQ(compare(walls, mesh).refusal, "");
  EXPECT_NE(compare(walls, mesh).news.find("fix stop"), std::string::npos);
}

TEST(Walls, WallsOfOneSideAreNamedOnce) {
  WallDescription walls = script();
  walls.primitives.pop_back();
  walls.primitives.push_back(plane("lid", 2, 0.2));
  const WallVerdict verdict = compare(walls, annulus(32));
  EXPECT_EQ(verdict.refusal, "");
  EXPECT_NE(verdict.news.find("patch 'pipe' of the mesh: particles may leave"), std::string::npos) << verdict.news;
  EXPECT_NE(verdict.news.find("fix lid (plane) of the DEM script"), std::string::npos) << verdict.news;
  EXPECT_EQ(verdict.news.find("hole"), std::string::npos) << verdict.news;
  EXPECT_EQ(compare(WallDescription(), annulus(32)).refusal, "");
}

TEST(Walls, NamesThatAreApartAreLeftOut) {
  EXPECT_NE(compare(script(0.0675), annulus(32)).refusal, "");
  EXPECT_EQ(compare(script(0.0675), annulus(32), "hole").refusal, "");
  EXPECT_EQ(compare(script(0.0675), annulus(32), "bore").refusal, "");
  EXPECT_NE(compare(script(0.0675), annulus(32), "pipe").refusal, "");
}

TEST(Walls, TriangleMeshesArePlanesCylindersAndWhatTheyAre) {
  for (const int facets : {12, 32, 64}) {
    Round hole{kHole, 0}, pipe{kPipe, kOffset};
    hole.around = pipe.around = facets;
    WallDescription walls;
    walls.meshes = {triangles("cad", patch("", hole)), triangles("string", patch("", pipe))};
    turn(walls.meshes[1], kOffset, kSpin);
    expect_same(walls, annulus(48));
    WallDescription still = walls;
    still.meshes[1].velocities.clear();
    expect_refused(still, annulus(48), {"mesh 'string'", "turns at 0 rad/s"});
    still.meshes[1].velocity_known = false;
    expect_same(still, annulus(48));
    hole.radius = 0.0675;
    walls.meshes[0] = triangles("cad", patch("", hole));
    expect_refused(walls, annulus(48), {"mesh 'cad'", "0.0675 m", "0.0635 m"});
    // Half as long as the patch.
    hole = {kHole, 0, 0, kLength / 2, facets};
    walls.meshes[0] = triangles("cad", patch("", hole));
    const WallVerdict half = compare(walls, annulus(48));
    EXPECT_EQ(half.refusal, "");
    EXPECT_NE(half.news.find("50 % of patch 'hole'"), std::string::npos) << half.news;
  }
}

TEST(Walls, BentSurfacesAreComparedPointByPoint) {
  // A quarter of a torus, by both sides with other cells.
  const auto bend = [](int along, int around, double radius) {
    MeshPatch made{"bend", true, true, {}};
    const auto at = [&](int i, int j) {
      const double a = kPi / 2 * i / along, b = 2 * kPi * j / around, far = 0.2 + radius * std::cos(b);
      return Vector3{far * std::cos(a), far * std::sin(a), radius * std::sin(b)};
    };
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < around; ++j)
        made.faces.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, {}});
    return made;
  };
  WallDescription walls;
  walls.meshes = {triangles("tube", bend(24, 36, 0.05))};
  expect_same(walls, {bend(16, 20, 0.05)});
  expect_refused(walls, {bend(16, 20, 0.06)}, {"mesh 'tube'", "lies up to", "patch 'bend'"});
  walls.meshes[0].moves = false;
  const Vector3 along{0.1, 0, 0};
  walls.meshes[0].velocities.assign(walls.meshes[0].corners.size(), {along, along, along});
  expect_refused(walls, {bend(16, 20, 0.05)}, {"mesh 'tube'", "moves at", "(0 0 0) m/s"});
}

TEST(Walls, ChordHeightsAreThoseOfTheFaces) {
  const WallVerdict verdict = compare(script(), annulus(24));
  ASSERT_EQ(verdict.chord_heights.size(), 2u);
  EXPECT_NEAR(verdict.chord_heights[0], kHole * (1 - std::cos(kPi / 24)), 1e-9);
  EXPECT_NEAR(verdict.chord_heights[1], kPipe * (1 - std::cos(kPi / 24)), 1e-9);
  EXPECT_EQ(compare(WallDescription(), {flat("floor", {side(2, 0)})}).chord_heights[0], 0);
}

TEST(Walls, DegenerateFacesDoNoHarm) {
  TriangleWall needle;
  needle.id = "needle";
  needle.name = "mesh 'needle'";
  needle.corners = {{Vector3{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {Vector3{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  WallDescription walls;
  walls.meshes = {needle};
  EXPECT_EQ(compare(walls, annulus(16)).refusal, "");
  EXPECT_EQ(compare(WallDescription(), {MeshPatch{"empty", true, true, {}}}).refusal, "");
}

TEST(Walls, NearestTriangleIsThatOfAllTriangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto point = [&] { return Eigen::Vector3d(number(random), number(random), number(random)); };
  std::vector<TriangleTree::Triangle> all;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d centre = point();
    all.push_back({centre + 0.1 * point(), centre + 0.1 * point(), centre + 0.1 * point()});
  }
  const TriangleTree tree(all);
  for (int n = 0; n < 200; ++n) {
    const Eigen::Vector3d x = 1.5 * point();
    double least = 1e9; // by trying points of all triangles
    for (const auto& t : all)
      for (int i = 0; i <= 40; ++i)
        for (int j = 0; i + j <= 40; ++j)
          least = std::min(least, (t[0] + (t[1] - t[0]) * i / 40. + (t[2] - t[0]) * j / 40. - x).norm());
    const TriangleTree::Nearest found = tree.nearest(x);
    ASSERT_GE(found.triangle, 0);
    EXPECT_LE(found.distance, least + 1e-12);
    EXPECT_GT(found.distance, least - 0.01);
    EXPECT_NEAR(found.weights.sum(), 1, 1e-12);
    EXPECT_GE(found.weights.minCoeff(), -1e-12);
  }
}
