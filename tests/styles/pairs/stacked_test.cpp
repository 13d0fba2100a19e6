// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres stacked on one another: the overlaps of a column at rest, and the motion of two spheres squeezed between
// walls.
#include "styles/bodies/bodies_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr double radius = 3e-3, gravity = 9.81;

double mass(double density) {
  return density * 4 * M_PI / 3 * std::pow(radius, 3);
}

/// Hertz stiffness kn of F = kn d^1.5 for two like spheres, or a sphere and a flat wall of its material.
double hertz(const Material& m, double effective_radius) {
  constexpr double poisson = 0.3;
  return 4. / 3 * m.youngs / (2 * (1 - poisson * poisson)) * std::sqrt(effective_radius);
}

void add_ball(LiggghtsSession& session, double height, double density) {
  Start start;
  start.position.z() = height;
  add_body(session, shape_of("sphere", "1", 2 * radius), start, density);
}

double height_of(LiggghtsSession& session, int tag) {
  return session.atom().x[session.local(tag)][2];
}

} // namespace

TEST(Stacked, ColumnComesToRestAtTheOverlapsOfItsWeight) {
  constexpr int spheres = 5;
  constexpr double density = 2619;
  Material m;
  m.restitution = 0.3;
  LiggghtsSession session;
  open_box(session, m);
  use_clusters(session);
  for (int k = 0; k < spheres; ++k)
    add_ball(session, (2 * k + 1) * radius, density);
  session.script("fix weight all gravity 9.81 vector 0 0 -1\n"
                 "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0\n"
                 "timestep 2e-5\nrun 60000\n");
  double below = 0;
  for (int k = 0; k < spheres; ++k) {
    const double load = (spheres - k) * mass(density) * gravity;
    const double kn = hertz(m, k == 0 ? radius : radius / 2);
    const double overlap = (k == 0 ? radius : 2 * radius) - (height_of(session, k + 1) - below);
    EXPECT_NEAR(overlap, std::pow(load / kn, 2. / 3), 1e-6 * overlap) << "contact below sphere " << k + 1;
    EXPECT_LT(std::abs(session.atom().v[session.local(k + 1)][2]), 1e-9);
    below = height_of(session, k + 1);
  }
}

TEST(Stacked, TwoSpheresSqueezedBetweenWallsMoveAsTheirEquationsSay) {
  // Without damping, of different weight, under gravity between walls closer than both diameters: d2x/dt2 of both
  // solved independently (Runge-Kutta of 4th order at a tenth of the step).
  const double densities[2] = {2000, 500}, gap = 3.6 * radius;
  Material m;
  m.restitution = 1;
  m.friction = 0;
  LiggghtsSession session;
  open_box(session, m);
  use_clusters(session);
  std::array<double, 4> state = {0.25 * gap, 0.75 * gap, 0, 0}; // heights, velocities
  for (int k = 0; k < 2; ++k)
    add_ball(session, state[k], densities[k]);
  session.script("fix weight all gravity 9.81 vector 0 0 -1\n"
                 "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0\n"
                 "fix lid all wall/gran/cluster model hertz tangential history primitive type 1 zplane " +
                 std::to_string(gap) + "\ntimestep 1e-6\nrun 0\n");
  const auto force = [](double kn, double overlap) { return overlap > 0 ? kn * std::pow(overlap, 1.5) : 0; };
  const auto rate = [&](const std::array<double, 4>& s) {
    const double floor = force(hertz(m, radius), radius - s[0]), lid = force(hertz(m, radius), radius - (gap - s[1]));
    const double between = force(hertz(m, radius / 2), 2 * radius - (s[1] - s[0]));
    return std::array<double, 4>{s[2], s[3], (floor - between) / mass(densities[0]) - gravity,
                                 (between - lid) / mass(densities[1]) - gravity};
  };
  const auto along = [](const std::array<double, 4>& s, const std::array<double, 4>& d, double h) {
    std::array<double, 4> moved;
    for (int k = 0; k < 4; ++k)
      moved[k] = s[k] + h * d[k];
    return moved;
  };
  constexpr double h = 1e-7;
  double swing = 0;
  for (int burst = 0; burst < 40; ++burst) { // 4 ms, several swings
    for (int step = 0; step < 1000; ++step) {
      const auto a = rate(state), b = rate(along(state, a, h / 2)), c = rate(along(state, b, h / 2)),
                 d = rate(along(state, c, h));
      for (int k = 0; k < 4; ++k)
        state[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
    }
    session.command("run 100 pre no post no");
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(height_of(session, k + 1), state[k], 1e-4 * radius) << "sphere " << k + 1 << " burst " << burst;
      swing = std::max(swing, std::abs(state[k] - (k == 0 ? 0.25 : 0.75) * gap));
    }
  }
  EXPECT_GT(swing, 0.02 * radius) << "they must move";
}
