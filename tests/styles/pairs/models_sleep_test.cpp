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

/// A cube on a cube on the floor, and a sphere beside them.
void stack(LiggghtsSession& session) {
  const auto cube = shape_of("cube", "8");
  double half = 0;
  for (const auto& s : cube.spheres())
    half = std::max(half, s.centre.z() + s.radius);
  constexpr double gap = 1e-6; // a bridge across no gap at all is not a number in LIGGGHTS
  Start start;
  start.position = Eigen::Vector3d(-3e-3, 0, kFloor + half + gap);
  add_body(session, cube, start);
  start.position.z() += 2 * half + gap;
  add_body(session, cube, start);
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
