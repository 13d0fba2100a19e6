// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One sphere on planes, against closed forms: rolling to rest, saturation by sliding, slopes, slip to roll, turning
// walls.
#include "styles/rolling/rolling_scene.h"

#include <gtest/gtest.h>

using namespace eccentra::test;

namespace {

/// A sphere that lies on the plane z = 0 with the overlap that carries it.
void place_on_floor(LiggghtsSession& session, const RollingScene& scene) {
  const double weight = -scene.gravity[2] * kGravity * sphere_mass();
  session.script(rolling_scene(scene) + sphere_at({0, 0, kRadius - resting_overlap(scene, weight)}) + spheres_done());
}

Eigen::Vector3d slope(double angle) {
  return {std::sin(angle), 0, -std::cos(angle)};
}

constexpr double kPush = 1e-2; // N, presses a sphere on a turning wall

long steps_for(const RollingScene& scene, double time) {
  return std::lround(time / scene.timestep);
}

} // namespace

// At rest to round-off, or, where the form cannot hold, seen to move.
void expect_rest(const SphereState& state, bool holds, double mu) {
  const double spin = state.omega.norm() * kRadius;
  if (holds) {
    EXPECT_LT(state.v.norm(), 1e-12) << "mu_r " << mu;
    EXPECT_LT(spin, 1e-12) << "mu_r " << mu;
  } else {
    EXPECT_GT(spin, 1e-7) << "mu_r " << mu;
  }
}

class Forms : public ::testing::TestWithParam<const char*> {
 protected:
  RollingScene scene() const {
    RollingScene scene;
    scene.arguments = std::string("form ") + GetParam();
    return scene;
  }
  /// Forms that hold a load instead of chattering about it.
  bool holds() const { return std::string(GetParam()) != "directional"; }
};

// v = v0 - 5/7 mu g t: stops after t = 7 v0 / (5 mu g) and x = v0 t / 2.
TEST_P(Forms, SphereRollsToRest) {
  RollingScene rolling = scene();
  rolling.mu_r = 0.04; // the two coefficients add up
  rolling.mu_shape = 0.06;
  const double mu = 0.1;
  const double v0 = 0.1;
  const double stop_time = 7 * v0 / (5 * mu * kGravity);
  LiggghtsSession session;
  place_on_floor(session, rolling);
  set_motion(session, 1, {v0, 0, 0}, {0, v0 / kRadius, 0});
  run(session, steps_for(rolling, stop_time / 2));
  EXPECT_NEAR(sphere(session, 1).v[0], v0 / 2, 0.01 * v0);
  run(session, steps_for(rolling, stop_time / 2 * 0.98));
  EXPECT_GT(sphere(session, 1).v[0], 0.005 * v0); // 1 % before the time it still rolls
  run(session, steps_for(rolling, stop_time * 0.03));
  const SphereState end = sphere(session, 1);
  EXPECT_NEAR(end.x[0], v0 * stop_time / 2, 0.01 * v0 * stop_time / 2);
  EXPECT_LT(std::abs(end.v[0]), 0.02 * v0); // the spring of epsd recoils
  if (holds()) {
    run(session, steps_for(rolling, 0.5));
    EXPECT_LT(sphere(session, 1).v.norm(), 1e-12);
  }
}

// Above mu_r = 1.4 mu_s the sphere slides, whatever mu_r is: x = v0^2 / (2 mu_s g).
TEST_P(Forms, RollingFrictionSaturatesAtSliding) {
  for (const double mu : {0.75, 0.95}) {
    RollingScene sliding = scene();
    sliding.mu_shape = mu;
    sliding.mu_s = 0.5;
    const double v0 = 0.2;
    LiggghtsSession session;
    place_on_floor(session, sliding);
    set_motion(session, 1, {v0, 0, 0}, {0, v0 / kRadius, 0});
    const double distance = v0 * v0 / (2 * sliding.mu_s * kGravity);
    run(session, steps_for(sliding, 1.2 * v0 / (sliding.mu_s * kGravity)));
    EXPECT_NEAR(sphere(session, 1).x[0], distance, 0.01 * distance) << "mu_r " << mu;
  }
}

// The form directional chatters by design: there the same check must see the creep.
TEST_P(Forms, RestsBelowTheCriticalSlope) {
  for (const double mu : {0.32, 0.95}) {
    RollingScene resting = scene();
    resting.mu_shape = mu;
    resting.gravity = slope(10 * kPi / 180);
    LiggghtsSession session;
    place_on_floor(session, resting);
    run(session, steps_for(resting, 0.2));
    expect_rest(sphere(session, 1), holds(), mu);
  }
}

// At the critical angle the net torque is zero: what little motion the start gave neither grows nor decays.
TEST_P(Forms, DoesNotAccelerateAtTheCriticalSlope) {
  RollingScene critical = scene();
  critical.mu_shape = 0.2;
  critical.gravity = slope(std::atan(critical.mu_shape));
  LiggghtsSession session;
  place_on_floor(session, critical);
  run(session, steps_for(critical, 0.1));
  const double before = sphere(session, 1).v[0];
  run(session, steps_for(critical, 0.1));
  EXPECT_NEAR(sphere(session, 1).v[0], before, 1e-3 * kGravity * 0.1);
  EXPECT_LT(std::abs(before), 5e-3);
}

// a = 5/7 g (sin - mu cos) above it.
TEST_P(Forms, RollsAboveTheCriticalSlope) {
  RollingScene rolling = scene();
  rolling.mu_shape = 0.2;
  const double angle = 20 * kPi / 180;
  rolling.gravity = slope(angle);
  LiggghtsSession session;
  place_on_floor(session, rolling);
  run(session, steps_for(rolling, 0.1));
  const double before = sphere(session, 1).v[0];
  run(session, steps_for(rolling, 0.2));
  const double expected = 5.0 / 7 * kGravity * (std::sin(angle) - rolling.mu_shape * std::cos(angle));
  EXPECT_NEAR((sphere(session, 1).v[0] - before) / 0.2, expected, 0.01 * expected);
}

// A sphere in the corner of two planes, gravity along and into the corner: two contacts, whose normals differ.
TEST_P(Forms, RestsOnTwoContacts) {
  for (const double mu : {0.32, 0.95}) {
    RollingScene corner = scene();
    corner.mu_shape = mu;
    corner.gravity = {std::sin(5 * kPi / 180), -std::cos(5 * kPi / 180) * 0.6, -std::cos(5 * kPi / 180) * 0.8};
    LiggghtsSession session;
    session.script(rolling_scene(corner) + wall_line(corner, "side", "primitive type 1 yplane 0.0") +
                   sphere_at({0, kRadius - 1e-6, kRadius - 1e-6}) + spheres_done());
    run(session, steps_for(corner, 0.3));
    expect_rest(sphere(session, 1), holds(), mu);
  }
}

// Slip to roll without rolling friction: v = 5/7 v0, reached at t = 2 v0 / (7 mu_s g).
TEST_P(Forms, SlipsThenRolls) {
  RollingScene free = scene();
  free.mu_shape = 0;
  free.mu_s = 0.3;
  const double v0 = 0.3;
  LiggghtsSession session;
  place_on_floor(session, free);
  set_motion(session, 1, {v0, 0, 0}, {0, 0, 0});
  const double roll_time = 2 * v0 / (7 * free.mu_s * kGravity);
  run(session, steps_for(free, roll_time / 2));
  EXPECT_NEAR(sphere(session, 1).v[0], v0 * 6.0 / 7, 0.01 * v0);
  run(session, steps_for(free, roll_time));
  const SphereState end = sphere(session, 1);
  EXPECT_NEAR(end.v[0], v0 * 5.0 / 7, 0.01 * v0);
  EXPECT_NEAR(end.omega[1] * kRadius, end.v[0], 0.01 * v0);
}

// Torsion is part of eq (19): d omega/dt = 5/2 mu g / R; and it can be left alone.
TEST_P(Forms, TorsionIsResistedUnlessSwitchedOff) {
  for (const bool resisted : {false, true}) {
    RollingScene spinning = scene();
    spinning.mu_shape = 0.1;
    spinning.arguments += resisted ? "" : " torsionTorque off";
    const double spin = 20;
    const double time = 0.01;
    LiggghtsSession session;
    place_on_floor(session, spinning);
    set_motion(session, 1, {0, 0, 0}, {0, 0, spin});
    run(session, steps_for(spinning, time));
    const double lost = resisted ? 2.5 * spinning.mu_shape * kGravity / kRadius * time : 0;
    EXPECT_NEAR(sphere(session, 1).omega[2], spin - lost, 0.01 * lost + 1e-9) << resisted;
  }
}

// A sphere held in place at the side of a turning cylinder: its spin goes to that of the wall, not to zero.
TEST_P(Forms, SpinIsRelativeToATurningWall) {
  RollingScene turning = scene();
  turning.mu_shape = 0.5;
  turning.gravity = {0, 0, 0};
  turning.mu_s = 0; // only rolling friction acts
  const double wall_spin = 3;
  // `shear` on a dimension other than the axis turns the cylinder about its axis.
  turning.walls = "primitive type 1 zcylinder 0.03 0 0 shear x " + number(wall_spin);
  LiggghtsSession session;
  session.script(rolling_scene(turning) + sphere_at({0.03 - kRadius + 2e-5, 0, 0.02}) + spheres_done());
  session.script("fix hold all addforce " + number(kPush) + " 0 0\n");
  session.script("fix still all planeforce 1 0 0\nfix still2 all setforce 0 0 0\n");
  // Torsion is about x; the spin of the wall is about z: rolling.
  run(session, steps_for(turning, 0.1));
  const double chatter = holds() ? 0 : 2.5 * turning.mu_shape * kPush / sphere_mass() * turning.timestep / kRadius;
  EXPECT_NEAR(sphere(session, 1).omega[2], wall_spin, 0.02 * wall_spin + chatter);
}

INSTANTIATE_TEST_SUITE_P(Shape, Forms, ::testing::Values("limited", "epsd", "directional"),
                         [](const auto& info) { return std::string(info.param); });
