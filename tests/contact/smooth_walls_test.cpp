// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Manifolds of a body on planes, in holes, on pipes and on triangles, in limits in which others know the answer.
#include "contact/manifold_poses.h"
#include "contact/mesh_manifold.h"
#include "contact/wall_manifold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {
using namespace eccentra::contact;
using namespace eccentra::test;

// Without an edge in touch a hull is the cluster of spheres at its vertices: on a plane, in a hole.
TEST(SmoothWalls, OnAPlaneAHullIsItsVertices) {
  Random r(7);
  const RoundedHull hull = made("smooth cube rounding .2");
  const ContactCore core(hull),
      cluster(hull.polyhedron()->vertices, std::vector<double>(hull.polyhedron()->vertices.size(), hull.radius()));
  for (int n = 0; n < 200; ++n) {
    const Matrix3d turn = r.turn();
    PosedCore a, b;
    a.pose(core, turn);
    b.pose(cluster, turn);
    const Vector3d normal = r.direction();
    std::vector<Contact> of_hull, of_cluster;
    const double height = r.uniform(0.3, 1) * core.bound;
    plane_contacts({&a}, normal, height, of_hull);
    plane_contacts({&b}, normal, height, of_cluster);
    const CylinderWall hole{0.5 * r.direction(), normal, 1.5};
    hole_contacts({&a}, hole, of_hull);
    hole_contacts({&b}, hole, of_cluster);
    ASSERT_EQ(of_hull.size(), of_cluster.size());
    for (std::size_t k = 0; k < of_hull.size(); ++k) {
      EXPECT_EQ(of_hull[k].id, of_cluster[k].id);
      EXPECT_EQ(of_hull[k].distance, of_cluster[k].distance);
      EXPECT_EQ(of_hull[k].arm, of_cluster[k].arm);
      EXPECT_EQ(of_hull[k].normal, of_cluster[k].normal);
    }
  }
}

// Over the middle of a triangle a hull touches as it touches the triangle's plane.
TEST(SmoothWalls, OverATriangleAHullIsOnAPlane) {
  Random r(8);
  const ContactCore triangle(eccentra::shape::make_core({{9, 0, 0}, {-5, 8, 0}, {-5, -8, 0}}, {{0, 1, 2}, {0, 2, 1}}),
                             0.);
  for (const char* line : {"smooth cube rounding .2", "smooth disk aspect .31 rounding .5"}) {
    const ContactCore core(made(line));
    for (int n = 0; n < 100; ++n) {
      Pose pose;
      pose.a.pose(core, r.turn());
      pose.b.pose(triangle, Matrix3d::Identity());
      const double height = pose.a.reach_along({0, 0, -1}) + 0.9 * core.radius;
      pose.offset = {0, 0, -height};
      std::vector<Contact> on_plane;
      plane_contacts({&pose.a}, {0, 0, 1}, height, on_plane);
      const Load plane = load_of(on_plane), mesh = load_of(find(pose, 0.1).contacts);
      EXPECT_LT((plane.force - mesh.force).norm(), 1e-6 * plane.force.norm());
      EXPECT_LT((plane.torque - mesh.torque).norm(), 1e-6 * plane.force.norm());
    }
  }
}

/// Triangles of a floor at z = -height of squares of this edge, turned about z.
std::vector<MeshTriangle> floor_of_squares(double edge, double height, double turn, const Vector3d& middle) {
  std::vector<MeshTriangle> floor;
  const Matrix3d rotation = AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
  const auto at = [&](int i, int j) {
    return Vector3d(rotation * Vector3d(edge * i, edge * j, 0) + Vector3d(middle.x(), middle.y(), -height));
  };
  for (int i = -4; i < 4; ++i)
    for (int j = -4; j < 4; ++j) {
      floor.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {false, false, false}});
      floor.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}, {false, false, false}});
    }
  return floor;
}

std::vector<Contact> on_mesh(const PosedCore& body, const std::vector<MeshTriangle>& mesh) {
  MeshManifold manifold;
  std::vector<Contact> found;
  for (const auto& touch : manifold.touches({&body}, mesh))
    found.push_back(touch.contact);
  return found;
}

void expect_same_load(const Load& a, const Load& b, const std::string& what) {
  EXPECT_LT((a.force - b.force).norm(), 1e-9 * (1 + a.force.norm())) << what;
  EXPECT_LT((a.torque - b.torque).norm(), 1e-9 * (1 + a.torque.norm())) << what;
}

// A floor of triangles is the plane, whatever their size and wherever the body stands on them.
TEST(SmoothWalls, AFloorOfTrianglesIsThePlane) {
  Random r(21);
  for (const char* line : {"smooth cube rounding .2", "smooth disk aspect .31 rounding .5",
                           "smooth disk aspect 1 rounding .2", "smooth disk aspect .31 rounding 1"}) {
    const ContactCore core(made(line));
    for (int n = 0; n < 100; ++n) {
      PosedCore body;
      // Anyhow, and with the axis of a disk in the plane or across it.
      body.pose(core, n % 4 == 0   ? AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix()
                      : n % 4 == 1 ? Matrix3d(Matrix3d::Identity())
                                   : r.turn());
      const double height = body.reach_along({0, 0, -1}) + r.uniform(0.5, 0.99) * core.radius;
      std::vector<Contact> on_plane;
      plane_contacts({&body}, Vector3d::UnitZ(), height, on_plane);
      const std::vector<Contact> found =
          on_mesh(body, floor_of_squares(r.uniform(0.4, 1.5), height, r.uniform(0, 7), 0.3 * r.direction()));
      expect_same_load(load_of(on_plane), load_of(found), std::string(line) + " " + std::to_string(n));
    }
  }
}

// In the corner between a floor and a wall a body has the contacts of both planes.
TEST(SmoothWalls, InACornerOfTrianglesADiskTouchesBothPlanes) {
  Random r(22);
  const ContactCore core(made("smooth disk aspect .31 rounding .5"));
  for (int n = 0; n < 100; ++n) {
    PosedCore body;
    body.pose(core, r.turn());
    const double height = body.reach_along({0, 0, -1}) + 0.8 * core.radius,
                 beside = body.reach_along({-1, 0, 0}) + 0.7 * core.radius;
    std::vector<Contact> on_planes;
    plane_contacts({&body}, Vector3d::UnitZ(), height, on_planes);
    plane_contacts({&body}, Vector3d::UnitX(), beside, on_planes);
    std::vector<MeshTriangle> corner;
    const double far = 9;
    const Vector3d ends[2] = {{-beside, -far, -height}, {-beside, far, -height}}, out(far, 0, 0), up(0, 0, far);
    for (const Vector3d& way : {out, up}) {
      corner.push_back({{ends[0], ends[1], ends[1] + way}, {&way == &out, false, false}});
      corner.push_back({{ends[0], ends[1] + way, ends[0] + way}, {false, false, false}});
    }
    expect_same_load(load_of(on_planes), load_of(on_mesh(body, corner)), std::to_string(n));
  }
}

// The triangles of a box are the box, whose corners have no radius.
TEST(SmoothWalls, AMeshOfABoxIsTheBox) {
  Random r(12);
  const eccentra::shape::ConvexCore box = eccentra::shape::box_core({0.7, 0.9, 0.8});
  const ContactCore solid(box, 0.);
  int with_edges = 0, with_sides = 0;
  for (const RoundedHull& hull :
       {made("smooth cube rounding .2"), made("smooth box 1 2 3 rounding .3"),
        made("smooth disk aspect .31 rounding .5"), made("smooth disk aspect 1 rounding .2")}) {
    const ContactCore core(hull);
    for (int n = 0; n < 300; ++n) {
      Pose pose = random_pose(core, solid, r, 0.9 * core.radius);
      const std::vector<Contact> expected = find(pose, 0.1 * core.radius).contacts;
      // Each face as two triangles; an edge is active in the triangle that comes last.
      std::vector<eccentra::contact::MeshTriangle> mesh;
      std::vector<std::array<int, 3>> corners;
      for (const auto& face : box.faces)
        for (int half = 0; half < 2; ++half)
          corners.push_back({face.corners[0], face.corners[1 + half], face.corners[2 + half]});
      for (std::size_t t = 0; t < corners.size(); ++t) {
        eccentra::contact::MeshTriangle triangle;
        for (int k = 0; k < 3; ++k) {
          triangle.corner[k] = pose.offset + pose.b.point(corners[t][k]);
          const int from = corners[t][k], to = corners[t][(k + 1) % 3];
          const auto is_edge = [&](const eccentra::shape::CoreEdge& e) {
            return (e.from == from && e.to == to) || (e.from == to && e.to == from);
          };
          triangle.edge_active[k] = std::any_of(box.edges.begin(), box.edges.end(), is_edge);
          for (std::size_t later = t + 1; later < corners.size(); ++later)
            for (int j = 0; j < 3; ++j)
              if (corners[later][j] == to && corners[later][(j + 1) % 3] == from)
                triangle.edge_active[k] = false;
        }
        mesh.push_back(triangle);
      }
      // A face or side of a disk that lies parallel on a face bears it anywhere (docs/rounded-bodies.md).
      const Vector3d axis = (pose.b.rotation.transpose() * pose.a.rotation.col(2)).cwiseAbs();
      if (core.is_disk() && (axis.maxCoeff() > 0.999999 || axis.minCoeff() < 1e-6))
        continue;
      expect_same_load(load_of(expected), load_of(on_mesh(pose.a, mesh)), hull.name() + " " + std::to_string(n));
      with_sides += core.is_disk() && std::any_of(expected.begin(), expected.end(), [&](const Contact& c) {
                      return eccentra::contact::feature_a(c.id) == core.axis_feature();
                    });
      with_edges += !core.is_disk() && std::any_of(expected.begin(), expected.end(), [&](const Contact& c) {
        return !c.elastic && eccentra::contact::feature_a(c.id) >= core.points &&
               eccentra::contact::feature_b(c.id) >= solid.points;
      });
    }
  }
  EXPECT_GT(with_edges, 100);
  EXPECT_GT(with_sides, 10);
}

// On a pipe of very large radius a body stands as on a plane; on a thin one an edge touches with its middle.
TEST(SmoothWalls, OnAPipe) {
  const ContactCore core(made("smooth cube rounding .2"));
  PosedCore cube;
  cube.pose(core, Matrix3d::Identity());
  const double half = core.half.z() + core.radius;
  std::vector<Contact> found;
  pipe_contacts({&cube}, {{0, 0, -half - 0.29}, Vector3d::UnitX(), 0.3}, found);
  ASSERT_EQ(found.size(), 2u); // the two lower edges across the pipe
  for (const Contact& c : found) {
    EXPECT_GE(c.id, core.points);
    EXPECT_NEAR(c.overlap(), 0.01, 1e-12);
    EXPECT_EQ(c.weight, 1);
  }
  found.clear();
  const double large = 1e7;
  pipe_contacts({&cube}, {{0, 0, -half - large + 0.01}, Vector3d::UnitX(), large}, found);
  Load load = load_of(found);
  EXPECT_NEAR(load.force.z(), 4 * std::pow(0.01, 1.5), 1e-4 * load.force.z());
  // A disk's side across a pipe.
  const ContactCore thick(made("smooth disk aspect 1 rounding .2"));
  PosedCore disk;
  disk.pose(thick, Matrix3d::Identity());
  found.clear();
  const double outer = thick.half.x() + thick.radius;
  pipe_contacts({&disk}, {{-outer - 0.29, 0, 0}, Vector3d::UnitY(), 0.3}, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, thick.axis_feature());
  EXPECT_NEAR(found[0].overlap(), 0.01, 1e-12);
}

} // namespace
