// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Central impacts of cluster on cluster, face, edge and vertex on: contacts shared return what was asked for at every
// level of detail; contacts parallel return about e^sqrt(N), as stock does; elastic impacts keep energy; the closed
// form off centre.
#include "styles/bodies/bodies_scene.h"

#include "force.h"
#include "pair.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eccentra;
using namespace eccentra::test;

namespace {

const Eigen::Quaterniond face = Eigen::Quaterniond::Identity();
const Eigen::Quaterniond edge(Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitX()));
const Eigen::Quaterniond vertex(Eigen::AngleAxisd(std::acos(1 / std::sqrt(3.)),
                                                  Eigen::Vector3d(1, -1, 0).normalized()));
const Eigen::Quaterniond rim(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));

struct Central {
  std::string family, count;
  const char* name;
  Eigen::Quaterniond orientation;
};

const Central centrals[] = {
    {"sphere", "1", "sphere", face}, {"sphere", "6", "axis", face},    {"cube", "8", "face", face},
    {"cube", "8", "edge", edge},     {"cube", "8", "vertex", vertex},  {"cube", "27", "face", face},
    {"cube", "27", "edge", edge},    {"cube", "27", "vertex", vertex}, {"cube", "64", "face", face},
    {"cube", "64", "edge", edge},    {"cube", "64", "vertex", vertex}, {"disk", "7", "face", face},
    {"disk", "7", "rim", rim},       {"disk", "19", "face", face},     {"disk", "48", "face", face},
    {"disk", "48", "rim", rim}};

struct Bounce {
  double restitution, duration, energy_gain;
};

/// One body runs into another of its kind, which lies as its mirror image; relative speed 0.2 m/s.
Bounce bounce(const Central& c, double restitution, const std::string& arguments, double speed = 0.2) {
  LiggghtsSession session;
  Material material;
  material.restitution = restitution;
  open_box(session, material);
  use_clusters(session, arguments);
  const shape::ClusterShape shape = shape_of(c.family, c.count);
  Start start[2];
  // The mirror image of these shapes in z = 0 is a turn by pi about z of the same turned about x.
  start[0].orientation = c.orientation;
  start[1].orientation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX())) * c.orientation;
  double reach = 0;
  for (const auto& s : shape.spheres())
    reach = std::max(reach, (c.orientation * s.centre).z() + s.radius);
  const double gap = 1e-5;
  start[0].position.z() = -reach - gap / 2;
  start[1].position.z() = reach + gap / 2;
  start[0].velocity.z() = speed / 2;
  start[1].velocity.z() = -speed / 2;
  add_body(session, shape, start[0]);
  add_body(session, shape, start[1]);
  session.script("timestep 5e-7\nrun 0\n");
  const double before = kinetic_energy(session);
  int steps = 0;
  const double touch = gap / speed;
  const auto velocity = [&session](int tag) { return session.atom().v[session.local(tag)][2]; };
  double last = 0;
  do {
    last = velocity(2) - velocity(1);
    session.command("run 100 pre no post no");
    steps += 100;
  } while ((velocity(2) - velocity(1) != last || last < 0) && steps < 60000);
  return {(velocity(2) - velocity(1)) / speed, steps * 5e-7 - touch, kinetic_energy(session) / before - 1};
}

} // namespace

TEST(Restitution, SharedContactsReturnWhatWasAskedFor) {
  for (const double e : {0.9, 0.5})
    for (const Central& c : centrals) {
      const Bounce b = bounce(c, e, "contacts shared");
      std::printf("%-6s %-3s %-7s e %.2f: %.4f, contact %.3g ms\n", c.family.c_str(), c.count.c_str(), c.name, e,
                  b.restitution, 1e3 * b.duration);
      EXPECT_NEAR(b.restitution, e, 0.01) << c.family << ' ' << c.count << ' ' << c.name;
    }
}

TEST(Restitution, ParallelContactsMultiplyDampingAsStockDoes) {
  const std::pair<Central, int> cases[] = {{centrals[2], 4}, {centrals[5], 9}, {centrals[8], 16}, {centrals[14], 48}};
  for (const auto& [c, contacts] : cases) {
    // Damping sqrt(N) times too strong: beta of e, and e of beta.
    const double log_e = std::log(0.9), beta = -log_e / std::hypot(M_PI, log_e) * std::sqrt(contacts);
    const double expected = std::exp(-M_PI * beta / std::sqrt(1 - beta * beta));
    EXPECT_NEAR(bounce(c, 0.9, "contacts parallel").restitution, expected, 0.002) << c.family << c.count;
  }
}

TEST(Restitution, PaperDampingReturnsItsOwnValue) {
  // 2 beta instead of sqrt(5) beta: nominal 0.9 returns 0.9101, 0.5 returns 0.5396 (physics.md, eq 14).
  for (const Central& c : {centrals[0], centrals[8]}) {
    EXPECT_NEAR(bounce(c, 0.9, "damping paper").restitution, 0.910076, 1e-3);
    EXPECT_NEAR(bounce(c, 0.5, "damping paper").restitution, 0.539575, 1e-3);
  }
}

TEST(Restitution, ElasticImpactsKeepEnergy) {
  for (const Central& c : centrals)
    EXPECT_NEAR(bounce(c, 1, "").energy_gain, 0, 1e-5) << c.family << ' ' << c.count << ' ' << c.name;
}

TEST(Restitution, FineFacesTouchAtHundredsOfSubSpheres) {
  // Two cubes of 13^3, face on face, shifted by half a lattice spacing: 25 contacts in line along each side.
  constexpr double e = 0.9, speed = 0.2, timestep = 2e-7;
  LiggghtsSession session;
  Material material;
  material.restitution = e;
  open_box(session, material);
  use_clusters(session);
  const shape::ClusterShape cube = shape_of("cube", "2197");
  double top = 0, spacing = 1;
  for (const auto& s : cube.spheres())
    top = std::max(top, s.centre.z());
  spacing = 2 * top / 12;
  const double radius = cube.smallest_radius();
  const double height = 2 * top + std::sqrt(4 * radius * radius - spacing * spacing / 2);
  Start lower, upper;
  lower.velocity.z() = speed / 2;
  upper.position = Eigen::Vector3d(spacing / 2, spacing / 2, height + speed * timestep);
  upper.velocity.z() = -speed / 2;
  add_body(session, cube, lower);
  add_body(session, cube, upper);
  session.script("timestep 2e-7\nrun 0\n");
  int dim = 0, most = 0, now = 0;
  do {
    session.command("run 20 pre no post no");
    now = *static_cast<int*>(session.lammps().force->pair->extract("contacts", dim));
    most = std::max(most, now);
  } while (now > 0);
  EXPECT_EQ(most, 25 * 25);
  // Each normal leans towards the gap that it fills, so that tangential dampers take a little as well; a damper per
  // contact would leave next to nothing.
  const double returned = (session.atom().v[session.local(2)][2] - session.atom().v[session.local(1)][2]) / speed;
  EXPECT_NEAR(returned, e, 0.03);
}
