// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Torques between spheres: their size against eq (19) and stock cdt, action = reaction, heaps at rest.
#include "styles/rolling/rolling_scene.h"

#include <gtest/gtest.h>

#include <random>

using namespace eccentra::test;

namespace {

RollingScene without_walls(const std::string& arguments) {
  RollingScene scene;
  scene.arguments = arguments;
  scene.gravity = {0, 0, 0};
  scene.walls = "";
  scene.box = "-0.05 0.05 -0.05 0.05 -0.05 0.05";
  return scene;
}

/// Torque on the first of two equal spheres that roll on each other like gears: no tangential force, all torque is
/// rolling.
double gear_torque(const RollingScene& scene, double overlap) {
  LiggghtsSession session;
  session.script(rolling_scene(scene) + sphere_at({-kRadius + overlap / 2, 0, 0}) +
                 sphere_at({kRadius - overlap / 2, 0, 0}) + spheres_done());
  set_motion(session, 1, {0, 0, 0}, {0, 0, 10});
  set_motion(session, 2, {0, 0, 0}, {0, 0, -10});
  run(session, 0);
  double torque[2] = {};
  for (int tag : {1, 2}) {
    const int i = session.local(tag);
    if (i >= 0)
      torque[tag - 1] = session.atom().torque[i][2];
  }
  MPI_Allreduce(MPI_IN_PLACE, torque, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_DOUBLE_EQ(torque[0], -torque[1]);
  return torque[0];
}

Eigen::Vector3d angular_momentum(LiggghtsSession& session, int spheres) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const double mass = sphere_mass();
  for (int tag = 1; tag <= spheres; ++tag) {
    const SphereState state = sphere(session, tag);
    sum += mass * state.x.cross(state.v) + 0.4 * mass * kRadius * kRadius * state.omega;
  }
  return sum;
}

} // namespace

class PairForms : public ::testing::TestWithParam<const char*> {
 protected:
  std::string arguments() const { return std::string("form ") + GetParam(); }
};

// Eq (19) has |r_c| = R where stock cdt has R* = R/2.
TEST(PairTorque, IsTwiceThatOfStockCdt) {
  const double overlap = 1e-5;
  RollingScene ours = without_walls("form directional");
  ours.mu_r = 0.2;
  ours.mu_shape = 0.1;
  RollingScene stock = without_walls("");
  stock.model = "cdt";
  stock.mu_r = 0.3;
  const double effective = ours.youngs / (2 * (1 - 0.25 * 0.25));
  const double force = 4.0 / 3 * effective * std::sqrt(kRadius / 2) * std::pow(overlap, 1.5);
  const double torque = gear_torque(ours, overlap);
  EXPECT_NEAR(torque, -0.3 * kRadius * force, 1e-9 * kRadius * force);
  EXPECT_NEAR(torque / gear_torque(stock, overlap), 2, 1e-9);
}

TEST(PairTorque, LimitedReachesTheSameCap) {
  const double overlap = 1e-5;
  EXPECT_NEAR(gear_torque(without_walls("form limited"), overlap) /
                  gear_torque(without_walls("form directional"), overlap),
              1, 1e-9);
}

// Spheres that touch and spin at random, alone in space: P and L stay.
TEST_P(PairForms, ConservesMomentum) {
  RollingScene scene = without_walls(arguments());
  scene.mu_shape = 0.5;
  LiggghtsSession session;
  std::string text = rolling_scene(scene);
  const double spacing = kDiameter - 2e-5;
  int spheres = 0;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 2; ++z, ++spheres)
        text += sphere_at(spacing * Eigen::Vector3d(x - 1.01, y - 0.98, z - 0.49));
  session.script(text + spheres_done());
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) -> Eigen::Vector3d {
    return size * Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  for (int tag = 1; tag <= spheres; ++tag) {
    const Eigen::Vector3d v = vector(0.02);
    const Eigen::Vector3d omega = vector(30);
    set_motion(session, tag, v, omega);
  }
  const Eigen::Vector3d before = angular_momentum(session, spheres);
  run(session, 2000);
  EXPECT_LT((angular_momentum(session, spheres) - before).norm(), 1e-11 * before.norm());
}

// Spheres dropped into a box come to rest. What is left moving is the measure that the forms differ in.
TEST_P(PairForms, HeapComesToRest) {
  RollingScene scene;
  scene.arguments = arguments();
  scene.mu_shape = 0.32;
  scene.timestep = 2e-5;
  scene.box = "-0.03 0.03 -0.03 0.03 -0.01 0.1";
  LiggghtsSession session;
  const std::string half = number(2.1 * kDiameter);
  std::string text = rolling_scene(scene);
  text += wall_line(scene, "left", "primitive type 1 xplane -" + half) +
          wall_line(scene, "right", "primitive type 1 xplane " + half) +
          wall_line(scene, "front", "primitive type 1 yplane -" + half) +
          wall_line(scene, "back", "primitive type 1 yplane " + half);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  int spheres = 0;
  for (int z = 0; z < 4; ++z)
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 3; ++y, ++spheres) {
        const Eigen::Vector3d shift(jitter(random), jitter(random), 0);
        text +=
            sphere_at(kDiameter * (Eigen::Vector3d(1.2 * (x - 1), 1.2 * (y - 1), 0.6 + 1.1 * z) + shift * (z + 1) / 4));
      }
  session.script(text + spheres_done());
  run(session, 40000); // 0.8 s
  std::vector<Eigen::Vector3d> places;
  double fastest = 0;
  for (int tag = 1; tag <= spheres; ++tag) {
    places.push_back(sphere(session, tag).x);
    fastest = std::max(fastest, sphere(session, tag).v.norm());
  }
  run(session, 10000); // 0.2 s
  double creep = 0;
  for (int tag = 1; tag <= spheres; ++tag)
    creep = std::max(creep, (sphere(session, tag).x - places[tag - 1]).norm());
  if (session.rank() == 0)
    std::printf("form %s: fastest sphere %.1e m/s, largest displacement in 0.2 s %.1e diameters\n", GetParam(), fastest,
                creep / kDiameter);
  if (std::string(GetParam()) == "directional") {
    EXPECT_LT(fastest, 1e-2); // chatter: 2.5 mu (F_n/m) dt, F_n up to 10 weights, at each of up to 12 contacts
  } else {
    EXPECT_LT(fastest, 1e-9);
    EXPECT_LT(creep, 1e-9 * kDiameter);
  }
}

INSTANTIATE_TEST_SUITE_P(Shape, PairForms, ::testing::Values("limited", "epsd", "directional"),
                         [](const auto& info) { return std::string(info.param); });
