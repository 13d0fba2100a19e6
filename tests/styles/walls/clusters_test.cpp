// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters dropped on walls: the restitution asked for at every level of detail, and rigid-body closed forms off
// centre.
#include "base/linear_algebra.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/walls/wall_scene.h"
#include "support/stl_file.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using eccentra::styles::FixClusterBodies;
using eccentra::test::LiggghtsSession;
using eccentra::test::stl_quad;
using eccentra::test::wall_scene;
using eccentra::test::write_stl_file;

namespace {

constexpr double kDiameter = 6.35e-3;
constexpr double kDensity = 2619;
const Eigen::Vector3d kUp(0, 0, 1);

struct Drop {
  std::string family, count;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  std::string restitution = "0.9";
  std::string youngs = "5e6";
  std::string friction = "0.5";
  std::string contacts = "shared";
  std::string wall = "primitive type 1 zplane 0";
  std::string before_wall;
  double speed = 0.3;
  double timestep = 1e-6;
  double x = 0.0013, y = -0.0021; ///< where above the floor
};

struct Rebound {
  Eigen::Vector3d velocity, omega;
  double mass;
  Eigen::Matrix3d inertia; ///< world frame
  Eigen::Vector3d lowest;  ///< arm from the centre to the point that touches first
};

/// Drops a body without gravity onto the floor z = 0 and returns it as it leaves.
Rebound drop(const Drop& d) {
  LiggghtsSession session;
  session.script(wall_scene(d.timestep, d.restitution, "0.0"));
  session.script("hard_particles yes");
  session.script("fix m1 all property/global youngsModulus peratomtype " + d.youngs + " " + d.youngs);
  session.script("fix m4 all property/global coefficientFriction peratomtypepair 2 " + d.friction + " " + d.friction +
                 " " + d.friction + " " + d.friction);
  session.script("pair_style gran/cluster model hertz tangential history rolling_friction off\npair_coeff * *");
  std::size_t used = 0;
  auto shape = eccentra::shape::make_shape({d.family, d.count}, 0, used, kDiameter);
  Rebound rebound;
  double depth = 0;
  rebound.lowest.setZero();
  for (const auto& s : shape.spheres()) {
    const Eigen::Vector3d bottom = d.orientation * s.centre - s.radius * kUp;
    if (-bottom.z() > depth) {
      depth = -bottom.z();
      rebound.lowest = bottom;
    }
  }
  const double height = depth + 2 * d.speed * d.timestep;
  session.script("create_atoms 1 single " + std::to_string(d.x) + " " + std::to_string(d.y) + " 0.05 units box");
  FixClusterBodies& bodies = FixClusterBodies::require(&session.lammps());
  const int id = bodies.shapes().add(shape);
  if (session.local(1) >= 0) {
    const int i = session.local(1);
    const Eigen::Quaterniond& q = d.orientation;
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    bodies.make_body(i, id, kDensity, wxyz);
    session.atom().x[i][2] = height;
    session.atom().v[i][2] = -d.speed;
    session.atom().type[i] = 1;
  }
  session.script(d.before_wall);
  session.script("fix floor all wall/gran/cluster model hertz tangential history contacts " + d.contacts + " " +
                 d.wall + "\nfix integrate all nve/cluster\n");
  auto* floor = session.lammps().modify->fix[session.lammps().modify->find_fix("floor")];
  // Until it has touched and is clear again.
  bool touched = false;
  for (int burst = 0; burst < 2000; ++burst) {
    session.script(burst == 0 ? "run 20" : "run 20 pre no post no");
    const bool touches = floor->compute_scalar() > 0;
    if (touched && !touches)
      break;
    touched = touched || touches;
  }
  EXPECT_TRUE(touched);
  double state[6] = {};
  const int i = session.local(1);
  if (i >= 0)
    for (int k = 0; k < 3; ++k) {
      state[k] = session.atom().v[i][k];
      state[3 + k] = session.atom().omega[i][k];
    }
  MPI_Allreduce(MPI_IN_PLACE, state, 6, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  rebound.velocity = Eigen::Vector3d(state[0], state[1], state[2]);
  rebound.omega = Eigen::Vector3d(state[3], state[4], state[5]);
  rebound.mass = kDensity * shape.volume();
  const Eigen::Matrix3d r = d.orientation.toRotationMatrix();
  rebound.inertia = rebound.mass * r * shape.inertia_per_mass().asDiagonal() * r.transpose();
  return rebound;
}

Eigen::Quaterniond turn(const Eigen::Vector3d& from_body, const Eigen::Vector3d& to_world) {
  return eccentra::base::rotation_between(from_body, to_world);
}

/// Axis of a disk: the one with the largest moment of inertia.
Eigen::Vector3d disk_axis(const std::string& count) {
  std::size_t used = 0;
  const auto shape = eccentra::shape::make_shape({"disk", count}, 0, used, kDiameter);
  int axis = 0;
  shape.inertia_per_mass().maxCoeff(&axis);
  return Eigen::Vector3d::Unit(axis);
}

/// Direction from the axis to the first sub-sphere on the rim, body frame.
Eigen::Vector3d disk_rim(const std::string& count) {
  std::size_t used = 0;
  const auto shape = eccentra::shape::make_shape({"disk", count}, 0, used, kDiameter);
  Eigen::Vector3d rim = Eigen::Vector3d::Zero();
  for (const auto& s : shape.spheres())
    if (s.centre.norm() > rim.norm() * (1 + 1e-9))
      rim = s.centre;
  return rim.normalized();
}

} // namespace

TEST(WallClusters, EveryShapeReturnsWhatIsAskedForAtCentralImpacts) {
  struct Case {
    std::string family, count, how;
    Eigen::Quaterniond orientation;
  };
  std::vector<Case> cases = {{"sphere", "6", "vertex", Eigen::Quaterniond::Identity()}};
  for (const char* count : {"8", "27", "64"}) {
    cases.push_back({"cube", count, "face", Eigen::Quaterniond::Identity()});
    cases.push_back({"cube", count, "edge", turn({0, 1, 1}, kUp)});
    cases.push_back({"cube", count, "vertex", turn({1, 1, 1}, kUp)});
  }
  for (const char* count : {"7", "19", "48"}) {
    cases.push_back({"disk", count, "face", turn(disk_axis(count), kUp)});
    cases.push_back({"disk", count, "rim", turn(disk_rim(count), -kUp)});
  }
  for (const Case& c : cases)
    for (const char* e : {"0.9", "0.5"}) {
      Drop d;
      d.family = c.family;
      d.count = c.count;
      d.orientation = c.orientation;
      d.restitution = e;
      const Rebound r = drop(d);
      EXPECT_NEAR(r.velocity.z() / d.speed, std::stod(e), 0.01 * std::stod(e)) << c.family << c.count << " " << c.how;
      EXPECT_LT(r.omega.norm() * kDiameter, 1e-3 * d.speed)
          << "the impact was not central: " << c.family << c.count << " " << c.how;
    }
}

TEST(WallClusters, ParallelContactsAreStocksMaterialOfEachLevel) {
  Drop d;
  d.family = "cube";
  d.count = "64";
  d.contacts = "parallel";
  EXPECT_NEAR(drop(d).velocity.z() / d.speed, std::pow(0.9, 4), 0.007); // e^sqrt(16); stock returns 0.654
}

TEST(WallClusters, RimOfATiltedDiskFollowsTheClosedForm) {
  // v' = v + J n / m, w' = I^-1 (r x J n), J = -(1 + e) v_n / (1/m + (r x n) . I^-1 (r x n)), without friction.
  const Eigen::Quaterniond on_rim = turn(disk_rim("48"), -kUp);
  for (const char* e : {"0.9", "0.5"})
    for (const double tilt : {15., 30., 60.}) {
      Drop d;
      d.family = "disk";
      d.count = "48";
      // From the face (axis up) the rim sphere goes down by the tilt.
      const Eigen::Vector3d hinge = (on_rim * disk_axis("48")).cross(kUp).normalized();
      d.orientation = Eigen::AngleAxisd((90 - tilt) * M_PI / 180, hinge) * on_rim;
      d.restitution = e;
      d.friction = "1e-12";
      d.youngs = "5e9"; // one rim sphere touches before its neighbours
      d.speed = 1;
      d.timestep = 5e-8;
      const Rebound r = drop(d);
      const Eigen::Vector3d lever = r.lowest.cross(kUp);
      const double j = (1 + std::stod(e)) * d.speed / (1 / r.mass + lever.dot(r.inertia.inverse() * lever));
      const Eigen::Vector3d omega = r.inertia.inverse() * (lever * j);
      EXPECT_NEAR(r.velocity.z(), -d.speed + j / r.mass, 0.01 * d.speed) << "tilt " << tilt << " e " << e;
      EXPECT_LT((r.omega - omega).norm(), 0.01 * omega.norm()) << "tilt " << tilt << " e " << e;
      if (tilt == 30. && std::string(e) == "0.9") {
        // Computed once in high precision, from the shape of the paper's Table 1.
        EXPECT_NEAR(r.velocity.z(), -0.220851217, 0.01);
      }
    }
}

TEST(WallClusters, MeshFloorIsThePlane) {
  write_stl_file("floor_plane.stl", stl_quad({"-0.05 -0.05 0", "0.05 -0.05 0", "0.05 0.05 0", "-0.05 0.05 0"}));
  Drop d;
  d.family = "cube";
  d.count = "27";
  d.orientation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 0.5).normalized());
  const Rebound plane = drop(d);
  d.before_wall = "fix floor_mesh all mesh/surface file floor_plane.stl type 1";
  d.wall = "mesh n_meshes 1 meshes floor_mesh";
  const Rebound mesh = drop(d);
  EXPECT_LT((plane.velocity - mesh.velocity).norm(), 1e-9 * d.speed);
  EXPECT_LT((plane.omega - mesh.omega).norm(), 1e-9 * plane.omega.norm());
}

TEST(WallClusters, WideCylinderIsThePlaneFromInsideAndOutside) {
  Drop d;
  d.family = "cube";
  d.count = "27";
  d.orientation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 0.5).normalized());
  d.x = d.y = 0;
  const Rebound plane = drop(d);
  ASSERT_GT(plane.omega.norm(), 1);
  // Radius 100 m: over the body's width the floor bends by 1e-7 m, against an overlap of 1e-4 m. x cylinders take (y
  // z).
  for (const char* wall : {"primitive type 1 xcylinder 100 0 100", "primitive type 1 xcylinder 100 0 -100"}) {
    d.wall = wall;
    const Rebound round = drop(d);
    EXPECT_LT((plane.velocity - round.velocity).norm(), 0.01 * d.speed) << wall;
    EXPECT_LT((plane.omega - round.omega).norm(), 0.01 * plane.omega.norm()) << wall;
  }
}

namespace {

/// Cubes tumble down into a corner of two turning walls; state of all bodies, in the order of their tags.
std::vector<double> tumble(LiggghtsSession& session, const std::string& commands) {
  session.script(commands);
  std::vector<double> all(4 * 13, 0.0);
  FixClusterBodies& bodies = FixClusterBodies::require(&session.lammps());
  for (int tag = 1; tag <= 4; ++tag) {
    const int i = session.local(tag);
    if (i < 0)
      continue;
    double* out = &all[13 * (tag - 1)];
    for (int k = 0; k < 3; ++k) {
      out[k] = session.atom().x[i][k];
      out[3 + k] = session.atom().v[i][k];
      out[6 + k] = session.atom().omega[i][k];
    }
    std::copy(bodies.quaternion(i), bodies.quaternion(i) + 4, out + 9);
  }
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

const char* kTumbleWalls = R"(
  fix gravity all gravity 9.81 vector 0 0.2 -1
  fix hole all wall/gran/cluster model hertz tangential history primitive type 1 xcylinder 0.05 0 0 rotate 5
  fix belt all wall/gran/cluster model hertz tangential history primitive type 2 zplane -0.046 velocity 0.2 0 0
  fix integrate all nve/cluster
)";

void place_cubes(LiggghtsSession& session) {
  session.script(wall_scene(1e-5));
  session.script("pair_style gran/cluster model hertz tangential history rolling_friction off\npair_coeff * *");
  FixClusterBodies& bodies = FixClusterBodies::require(&session.lammps());
  std::size_t used = 0;
  const int id = bodies.shapes().add(eccentra::shape::make_shape({"cube", "27"}, 0, used, kDiameter));
  for (int tag = 1; tag <= 4; ++tag)
    session.script("create_atoms 1 single " + std::to_string(-0.012 + 0.009 * (tag - 1)) + " " +
                   std::to_string(0.002 * tag) + " -0.0405 units box");
  for (int tag = 1; tag <= 4; ++tag) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.4 * tag, Eigen::Vector3d(1, tag, -1).normalized()));
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    if (session.local(tag) >= 0)
      bodies.make_body(session.local(tag), id, kDensity, wxyz);
  }
}

} // namespace

TEST(WallClusters, RestartGoesOnToTheLastDigit) {
  std::vector<double> straight;
  {
    LiggghtsSession session;
    place_cubes(session);
    straight = tumble(session, std::string(kTumbleWalls) + "restart 3000 clusters.*.restart\nrun 6000");
  }
  EXPECT_GT(straight[0], -0.0115); // the belt has taken them along
  LiggghtsSession session;
  session.script(R"(
    atom_style granular
    atom_modify map array
    newton off
    communicate single vel yes
    processors * 1 1
    units si
    read_restart clusters.3000.restart
    neighbor 0.002 bin
    neigh_modify delay 0
    fix m1 all property/global youngsModulus peratomtype 5e6 5e6
    fix m2 all property/global poissonsRatio peratomtype 0.3 0.3
    fix m3 all property/global coefficientRestitution peratomtypepair 2 0.9 0.9 0.9 0.9
    fix m4 all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5
    pair_style gran/cluster model hertz tangential history rolling_friction off
    pair_coeff * *
    timestep 1e-5
  )");
  FixClusterBodies::require(&session.lammps());
  const auto restarted = tumble(session, std::string(kTumbleWalls) + "run 3000");
  for (std::size_t k = 0; k < straight.size(); ++k)
    EXPECT_EQ(restarted[k], straight[k]) << "value " << k;
}
