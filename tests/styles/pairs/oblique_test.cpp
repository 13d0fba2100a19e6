// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Oblique and off-centre impacts on a body so heavy that it does not move, against closed forms (physics.md, D1 T4,
// D3).
#include "styles/bodies/bodies_scene.h"

#include "force.h"
#include "pair.h"

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

namespace {

/// The sub-sphere that is lowest (up = -1) or highest (up = 1) in this orientation: its centre, and its extreme height.
struct Extreme {
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  double height = -1;
};
Extreme extreme(const shape::ClusterShape& shape, const Eigen::Quaterniond& q, double up) {
  Extreme e;
  for (const auto& s : shape.spheres()) {
    const Eigen::Vector3d centre = q * s.centre;
    if (up * centre.z() + s.radius > e.height) {
      e.height = up * centre.z() + s.radius;
      e.arm = centre;
    }
  }
  return e;
}

Eigen::Matrix3d inverse_inertia(const shape::ClusterShape& shape, const Eigen::Quaterniond& q, double mass) {
  const Eigen::Matrix3d r = q.toRotationMatrix();
  return r * (mass * shape.inertia_per_mass()).cwiseInverse().asDiagonal() * r.transpose();
}

} // namespace

TEST(Oblique, TwoBodiesThatMeetOffCentreReturnTheRestitutionAskedFor) {
  // Frictionless, rim against rim, both free: J = (1 + e) v / (1/m_A + 1/m_B + levers of both); v' and omega' follow.
  struct Case {
    const char *family_a, *count_a, *family_b, *count_b;
    double tilt_a, tilt_b; // [rad] about y
  };
  for (const Case& c : {Case{"disk", "48", "disk", "48", 0.5, 0.3}, Case{"disk", "7", "cube", "8", 0.4, 0.35},
                        Case{"cube", "64", "disk", "19", 0.6, 0.7}})
    for (const double e : {1.0, 0.9, 0.5}) {
      LiggghtsSession session;
      Material stiff;
      stiff.youngs = 1e9;
      stiff.restitution = e;
      stiff.friction = 0;
      open_box(session, stiff);
      use_clusters(session);
      const shape::ClusterShape shapes[2] = {shape_of(c.family_a, c.count_a), shape_of(c.family_b, c.count_b)};
      // The second angle lets one corner or rim sphere stand out.
      const auto tilted = [](double angle) {
        return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(0.4 * angle, Eigen::Vector3d::UnitX()));
      };
      Start start[2];
      start[0].orientation = tilted(c.tilt_a);
      start[1].orientation = tilted(c.tilt_b);
      const Extreme bottom = extreme(shapes[0], start[0].orientation, -1),
                    top = extreme(shapes[1], start[1].orientation, 1);
      const double gap = 1e-6, speed = 1;
      // B's highest point at the origin, A's lowest above it.
      start[0].position = Eigen::Vector3d(-bottom.arm.x(), -bottom.arm.y(), bottom.height + gap);
      start[1].position = Eigen::Vector3d(-top.arm.x(), -top.arm.y(), -top.height);
      start[0].velocity.z() = -speed / 2;
      start[1].velocity.z() = speed / 2;
      double inverse = 0;
      Eigen::Vector3d turn[2];
      for (int k = 0; k < 2; ++k) {
        add_body(session, shapes[k], start[k]);
        const double mass = 2619 * shapes[k].volume();
        const Eigen::Vector3d lever = (k == 0 ? bottom.arm : top.arm).cross(Eigen::Vector3d::UnitZ());
        turn[k] = inverse_inertia(shapes[k], start[k].orientation, mass) * lever;
        inverse += 1 / mass + lever.dot(turn[k]);
      }
      session.command("timestep 2e-8");
      session.command("run 100");
      // Until their rims part.
      auto* pair = session.lammps().force->pair;
      int dim = 0;
      const auto contacts = [&] { return *static_cast<int*>(pair->extract("contacts", dim)); };
      int touched = 0;
      for (int burst = 0; burst < 4000; ++burst) {
        session.command("run 5 pre no post no");
        touched += contacts() > 0;
        if (touched > 0 && contacts() == 0)
          break;
      }
      ASSERT_GT(touched, 0);
      const double impulse = (1 + e) * speed / inverse;
      const std::string what =
          std::string(c.family_a) + c.count_a + " " + c.family_b + c.count_b + " e " + std::to_string(e);
      double returned = 0; // relative velocity of the contact points
      for (int k = 0; k < 2; ++k) {
        const int i = session.local(k + 1);
        const double sign = k == 0 ? 1 : -1, mass = 2619 * shapes[k].volume();
        const Eigen::Map<Eigen::Vector3d> omega(session.atom().omega[i]), v(session.atom().v[i]);
        EXPECT_NEAR(v.z(), start[k].velocity.z() + sign * impulse / mass, 0.01 * speed) << what << " body " << k;
        EXPECT_LT((omega - sign * impulse * turn[k]).norm(), 0.015 * impulse * turn[k].norm()) << what << " body " << k;
        const Eigen::Vector3d arm = k == 0 ? bottom.arm : top.arm;
        returned += sign * (v.z() + omega.cross(arm).z());
      }
      std::printf("%s: returns %.4f; %.2f of the mass at the contact\n", what.c_str(), returned / speed,
                  (1 / (2619 * shapes[0].volume()) + 1 / (2619 * shapes[1].volume())) / inverse);
    }
}
