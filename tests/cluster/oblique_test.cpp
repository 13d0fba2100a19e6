// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Oblique and off-centre impacts on a body so heavy that it does not move, against closed forms (physics.md, D1 T4,
// D3).
#include "bodies_scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr double heavy_radius = 0.08; // nearly a plane
constexpr double heavy_density = 1e9;

void add_heavy_sphere(LiggghtsSession& session) {
  Start start;
  start.position.z() = -heavy_radius;
  add_sphere(session, start, heavy_radius, heavy_density);
}

} // namespace

TEST(Oblique, GrossSlidingOfASphere) {
  // Chung & Ooi, test 4 at 45 degrees: v_t' = v_t - mu (1 + e) v_n, omega' = 5/2 mu (1 + e) v_n / R.
  LiggghtsSession session;
  Material alumina;
  alumina.youngs = 5e10;
  alumina.restitution = 0.98;
  alumina.friction = 0.092;
  session.command("hard_particles yes");
  open_box(session, alumina);
  use_clusters(session);
  add_heavy_sphere(session);
  constexpr double radius = 2.5e-3, speed = 3.9;
  const double vn = speed / std::sqrt(2.);
  Start start;
  start.position.z() = radius + 1e-6;
  start.velocity = Eigen::Vector3d(vn, 0, -vn);
  add_body(session, shape_of("sphere", "1", 2 * radius), start);
  session.script("timestep 1e-8\nrun 4000\n");
  const int i = session.local(2);
  EXPECT_NEAR(session.atom().v[i][2], 0.98 * vn, 0.01 * vn);
  EXPECT_NEAR(session.atom().v[i][0], 2.255370819, 0.005 * 2.255);
  EXPECT_NEAR(session.atom().omega[i][1], 502.345628, 0.01 * 502);
}

TEST(Oblique, RimOfATiltedDiskStrikesOffCentre) {
  // Frictionless, e = 1: J = 2 v / (1/m + (r x n) . I^-1 (r x n)) at the lowest sub-sphere; energy is kept.
  LiggghtsSession session;
  Material stiff;
  stiff.youngs = 1e9;
  stiff.restitution = 1;
  stiff.friction = 0;
  open_box(session, stiff);
  use_clusters(session);
  add_heavy_sphere(session);
  const shape::ClusterShape disk = shape_of("disk", "48");
  const double tilt = M_PI / 6;
  Start start;
  start.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()));
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  double lowest = 1;
  for (const auto& s : disk.spheres()) {
    const Eigen::Vector3d centre = start.orientation * s.centre;
    if (centre.z() - s.radius < lowest) {
      lowest = centre.z() - s.radius;
      arm = centre;
    }
  }
  // The contact is above the middle of the heavy sphere.
  start.position = Eigen::Vector3d(-arm.x(), -arm.y(), 1e-6 - lowest);
  start.velocity.z() = -1;
  add_body(session, disk, start);
  const double energy = [&session] {
    session.script("timestep 2e-8\nrun 0\n");
    return kinetic_energy(session);
  }();
  session.command("run 6000");
  const double mass = 2619 * disk.volume();
  const Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d r = start.orientation.toRotationMatrix();
  const Eigen::Matrix3d inverse = r * (mass * disk.inertia_per_mass()).cwiseInverse().asDiagonal() * r.transpose();
  const Eigen::Vector3d lever = arm.cross(n);
  const double impulse = 2 / (1 / mass + lever.dot(inverse * lever));
  const int i = session.local(2);
  EXPECT_NEAR(session.atom().v[i][2], -1 + impulse / mass, 0.01);
  const Eigen::Map<Eigen::Vector3d> omega(session.atom().omega[i]);
  EXPECT_NEAR(omega.norm(), (inverse * lever * impulse).norm(), 0.01 * 454);
  EXPECT_NEAR(kinetic_energy(session) / energy, 1, 1e-3);
  // physics.md: -0.179843386 m/s, 453.901033 rad/s.
  EXPECT_NEAR(session.atom().v[i][2], -0.179843386, 0.01);
  EXPECT_NEAR(omega.norm(), 453.901033, 0.01 * 454);
}
