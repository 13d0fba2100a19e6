// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every model of contacts under fix sleep/cluster: what sleeps is as it is awake, and wakes.
#include "styles/pairs/each_model.h"

#include <gtest/gtest.h>

using namespace eccentra;
using namespace eccentra::test;

namespace {

double output(LiggghtsSession& session, const char* fix, int n) {
  return session.lammps().modify->find_fix_id(fix)->compute_vector(n);
}

double weight_of(LiggghtsSession& session) {
  double mass = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    mass += session.atom().rmass[i];
  return mass * 9.81;
}

constexpr double gap = 1e-6; // a bridge across no gap at all is not a number in LIGGGHTS

/// A cube on a cube on the floor.
void two_cubes(LiggghtsSession& session) {
  const auto cube = shape_of("cube", "8");
  double half = 0;
  for (const auto& s : cube.spheres())
    half = std::max(half, s.centre.z() + s.radius);
  Start start;
  start.position = Eigen::Vector3d(-3e-3, 0, kFloor + half + gap);
  add_body(session, cube, start);
  start.position.z() += 2 * half + gap;
  add_body(session, cube, start);
}

/// The cubes, and a sphere beside them.
void stack(LiggghtsSession& session) {
  two_cubes(session);
  Start start;
  start.position = Eigen::Vector3d(6e-3, 0, kFloor + 3.1e-3 + gap);
  add_sphere(session, start, 3.1e-3);
}

/// What is seen of a stack that comes to rest, and of a ball that then falls on it.
struct Rest {
  double height, load, slept = 0, rebound = 0, wake_ups = 0;
};

Rest stack_and_ball(const Models& models, bool sleeping) {
  LiggghtsSession session;
  open_empty(session, models, 2e-5);
  stack(session);
  if (sleeping)
    session.command("fix sleep all sleep/cluster");
  session.command("run 8000");
  Rest rest;
  const auto height = [&session](int tag) { return session.atom().x[session.local(tag)][2]; };
  rest.height = height(2);
  rest.load = -output(session, "floor", 2) / weight_of(session);
  rest.slept = sleeping ? output(session, "sleep", 0) : 0;
  Start start;
  start.position = Eigen::Vector3d(-3e-3, 0, rest.height + 10e-3);
  start.velocity.z() = -0.3;
  add_sphere(session, start, 3.1e-3);
  for (int n = 0; n < 60; ++n) {
    session.command("run 20");
    rest.rebound = std::max(rest.rebound, session.atom().v[session.local(4)][2]);
    rest.wake_ups += sleeping ? output(session, "sleep", 2) : 0;
  }
  return rest;
}

/// Weight in the plane of the floor, as on a slope: the springs of friction carry it.
void tilt(LiggghtsSession& session, double degrees) {
  const double angle = degrees * M_PI / 180;
  session.script("unfix gravity\nfix gravity all gravity 9.81 vector " + std::to_string(std::sin(angle)) + " 0 " +
                 std::to_string(-std::cos(angle)) + "\n");
}

/// Cubes that have slept on a slope: how far the upper one moves when they are awake again, and when the slope is
/// level again, which is what the springs gave way by.
struct Slope {
  double slept, slid, sprung_back, risen;
};

Slope cubes_on_a_slope(const Models& models) {
  LiggghtsSession session;
  open_empty(session, models, 2e-5);
  two_cubes(session);
  tilt(session, 5);
  session.command("fix sleep all sleep/cluster");
  session.command("run 30000");
  const auto place = [&session] { return session.atom().x[session.local(2)][0]; };
  const auto height = [&session] { return session.atom().x[session.local(2)][2]; };
  Slope slope{output(session, "sleep", 0), 0, 0, 0};
  const double asleep = place(), high = height();
  session.command("unfix sleep");
  session.command("run 4000");
  slope.slid = place() - asleep;
  slope.risen = height() - high;
  const double awake = place();
  tilt(session, 0);
  session.command("run 4000");
  slope.sprung_back = awake - place();
  return slope;
}

} // namespace

TEST(EachModel, SleepsAsItIsAwake) {
  constexpr double tolerance = 0.01; // of fix sleep/cluster
  for (const Models& models : all_models()) {
    if (models.names.find("thornton_ning") != std::string::npos)
      continue; // has no damper: without adhesion it bounces for ever
    const Rest awake = stack_and_ball(models, false), asleep = stack_and_ball(models, true);
    std::printf("%s: asleep %.0f of 3, load %.5f, rebound %.4f and %.4f\n", name_of(models).c_str(), asleep.slept,
                asleep.load, awake.rebound, asleep.rebound);
    EXPECT_EQ(asleep.slept, 3) << name_of(models);
    EXPECT_NEAR(asleep.load, 1, tolerance) << name_of(models);
    EXPECT_NEAR(asleep.load, awake.load, tolerance) << name_of(models);
    EXPECT_NEAR(asleep.height, awake.height, 1e-4 * 6.35e-3) << name_of(models);
    EXPECT_GT(asleep.wake_ups, 0) << name_of(models) << ": the ball wakes the stack";
    EXPECT_NEAR(asleep.rebound, awake.rebound, 0.03 * 0.3) << name_of(models);
  }
}

// A contact that came back from sleep without its springs would give way by as much again; one that had forgotten how
// far it was once pressed in (edinburgh, hooke/hysteresis, luding) would lift the body by 1e-4 of that and more.
TEST(EachModel, FrictionOfASleeperStays) {
  int slept = 0;
  for (const Models& models : all_models()) {
    const auto uses = [&models](const char* name) { return models.names.find(name) != std::string::npos; };
    if (uses("tangential off") || uses("tangential no_history") || uses("thornton_ning"))
      continue; // slide on any slope; bounces for ever
    const Slope slope = cubes_on_a_slope(models);
    std::printf("%s: asleep %.0f of 2, slid %.3g, sprung back %.3g, risen %.3g\n", name_of(models).c_str(), slope.slept,
                slope.slid, slope.sprung_back, slope.risen);
    if (slope.slept < 2)
      continue; // still rocks from edge to edge
    ++slept;
    EXPECT_GT(slope.sprung_back, 1e-7) << name_of(models);
    EXPECT_LT(std::abs(slope.slid), 0.1 * slope.sprung_back) << name_of(models);
    EXPECT_LT(slope.risen, 1e-4 * slope.sprung_back) << name_of(models);
  }
  EXPECT_GE(slept, 14);
}
