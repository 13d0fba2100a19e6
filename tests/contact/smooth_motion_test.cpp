// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies in motion: restitution, rest, friction, towers, rolling, falls.
#include "contact/gjk.h"
#include "contact/small_dem.h"
#include "contact/test_bodies.h"
#include "support/sanitized.h"

#include <gtest/gtest.h>

#include <array>

namespace {
using namespace small_dem;

// A body falls on a plane on a face, an edge, a vertex; two bodies meet face on face.
TEST(SmoothMotion, RestitutionIsWhatWasAskedFor) {
  const Species cube(made("smooth cube rounding .15", diameter));
  for (const double asked : {0.9, 0.5}) {
    Material m;
    m.restitution = asked;
    m.friction = 0;
    for (int way = 0; way < 3; ++way) {
      SmallDem dem(m);
      dem.dt = 2e-6;
      dem.planes.push_back({Vector3d::UnitZ(), 0});
      Quaterniond q = Quaterniond::Identity();
      if (way > 0)
        q = turned(q, {M_PI / 4, 0, 0});
      if (way > 1)
        q = turned(q, {0, std::atan(1 / std::sqrt(2.)), 0});
      dem.add(cube, {0, 0, cube.core.bound + 1e-5}, {0, 0, -0.3}, q);
      bool touched = false;
      for (int k = 0; k < 200000; ++k) {
        dem.step();
        touched |= dem.wall_contacts > 0;
        if (touched && dem.wall_contacts == 0)
          break;
      }
      EXPECT_NEAR(dem.bodies[0].v.z() / 0.3, asked, 1e-3) << "way " << way;
    }
    SmallDem dem(m);
    dem.dt = 2e-6;
    const double half = cube.core.half.z() + cube.core.radius;
    dem.add(cube, Vector3d::Zero(), {0, 0, 0.15});
    dem.add(cube, {0, 0, 2 * half + 1e-5}, {0, 0, -0.15});
    bool touched = false;
    for (int k = 0; k < 200000; ++k) {
      dem.step();
      touched |= dem.contacts > 0;
      if (touched && dem.contacts == 0)
        break;
    }
    EXPECT_NEAR((dem.bodies[1].v.z() - dem.bodies[0].v.z()) / 0.3, asked, 1e-3) << "face on face";
  }
}

TEST(SmoothMotion, RestsOnAPlane) {
  const Species cube(made("smooth cube rounding .15", diameter)),
      disk(made("smooth disk aspect .31 rounding .5", diameter)),
      round(made("smooth disk aspect .31 rounding 1", diameter));
  constexpr int tilts = eccentra::test::repetitions(3, 1);
  for (const Species* s : {&cube, &disk, &round})
    for (int n = 0; n < tilts; ++n) {
      const double tilt = std::array{0.4, 0.05, s->core.is_disk() ? 0.9 : 1.3}[n];
      SmallDem dem(Material{});
      dem.gravity = 9.81;
      dem.planes.push_back({Vector3d::UnitZ(), 0});
      dem.add(*s, {0, 0, s->core.bound}, Vector3d::Zero(), turned(Quaterniond::Identity(), {tilt, 0.7 * tilt, 0}));
      for (int k = 0; k < 50000; ++k)
        dem.step();
      const Body& b = dem.bodies[0];
      const Matrix3d r = b.q.toRotationMatrix();
      EXPECT_LT(b.v.norm(), 1e-9);
      EXPECT_LT(b.omega.norm(), 1e-6);
      if (s->core.is_disk()) {
        EXPECT_GT(std::abs(r(2, 2)), 1 - 1e-9);
        EXPECT_EQ(dem.wall_contacts, 12);
      } else {
        EXPECT_GT(r.row(2).cwiseAbs().maxCoeff(), 1 - 1e-9);
        EXPECT_EQ(dem.wall_contacts, 4);
      }
    }
}

/// Drift from 1 to 2 s of a tower of ten (with sanitizers four), in parts of the height of one; top over the height
/// when built.
std::pair<double, double> tower(const Species& s, double half, double offset, double twist, bool crossed, double dt) {
  SmallDem dem(Material{});
  dem.dt = dt;
  dem.gravity = 9.81;
  dem.planes.push_back({Vector3d::UnitZ(), 0});
  Random r(2);
  constexpr int high = eccentra::test::repetitions(10, 4);
  for (int k = 0; k < high; ++k) {
    const double turn = crossed ? k % 2 * M_PI / 4 : twist * r.uniform(-1, 1);
    dem.add(s, {offset * half * r.uniform(-1, 1), offset * half * r.uniform(-1, 1), (2 * k + 1) * half * 1.002},
            Vector3d::Zero(), turned(Quaterniond::Identity(), {0, 0, turn}));
  }
  std::vector<Vector3d> start;
  for (int k = 0; k < static_cast<int>(2 / dt); ++k) {
    dem.step();
    if (k == static_cast<int>(1 / dt))
      for (const Body& b : dem.bodies)
        start.push_back(b.x);
  }
  double drift = 0, top = 0;
  for (int k = 0; k < high; ++k) {
    drift = std::max(drift, (dem.bodies[k].x - start[k]).norm());
    top = std::max(top, dem.bodies[k].x.z());
  }
  return {drift / (2 * half), top / ((2 * high - 1) * half)};
}

TEST(SmoothMotion, TowersStand) {
  const Species cube(made("smooth cube rounding .15", diameter)),
      disk(made("smooth disk aspect .31 rounding .5", diameter));
  const double half = cube.core.half.z() + cube.core.radius, thick = disk.core.half.z() + disk.core.radius;
  const auto disks = tower(disk, thick, 0.1, 0.2, false, 4e-5);
  EXPECT_LT(disks.first, 0.05);
  EXPECT_GT(disks.second, 0.97);
  if (eccentra::test::repetitions(4, 1) == 1)
    return;
  const auto square = tower(cube, half, 0, 0, false, 5e-5);
  EXPECT_LT(square.first, 1e-5);
  EXPECT_GT(square.second, 0.97);
  const auto crossed = tower(cube, half, 0, 0, true, 5e-5);
  EXPECT_LT(crossed.first, 0.02); // soft towers sway
  EXPECT_GT(crossed.second, 0.97);
  const auto offset = tower(cube, half, 0.1, 0.2, false, 5e-5);
  EXPECT_LT(offset.first, 0.05);
  EXPECT_GT(offset.second, 0.97);
  std::printf("towers, drift in 1 s over the edge: square %.1e, crossed %.1e, offset %.1e, disks %.1e\n", square.first,
              crossed.first, offset.first, disks.first);
}

TEST(SmoothMotion, SlidesWhereFrictionEnds) {
  const Species cube(made("smooth cube rounding .15", diameter));
  for (const double degrees : {26.5, 26.7}) { // friction 0.5: 26.57
    SmallDem dem(Material{});
    const double slope = degrees * M_PI / 180, half = cube.core.half.z() + cube.core.radius;
    dem.gravity = 9.81;
    dem.planes.push_back({{std::sin(slope), 0, std::cos(slope)}, 0});
    dem.add(cube, half * dem.planes[0].normal, Vector3d::Zero(), turned(Quaterniond::Identity(), {0, slope, 0}));
    for (int k = 0; k < 50000; ++k)
      dem.step();
    const Vector3d x = dem.bodies[0].x, v = dem.bodies[0].v;
    for (int k = 0; k < 25000; ++k)
      dem.step();
    const double slid = (dem.bodies[0].x - x).norm(), pull = 9.81 * (std::sin(slope) - 0.5 * std::cos(slope));
    if (pull < 0)
      EXPECT_LT(slid, 1e-9);
    else
      EXPECT_NEAR(slid / (v.norm() * 0.5 + pull * 0.125), 1, 0.02);
  }
}

TEST(SmoothMotion, DisksRoll) {
  for (const char* line : {"smooth disk aspect .31 rounding 1", "smooth disk aspect .31 rounding .5"}) {
    const Species disk(made(line, diameter));
    SmallDem dem(Material{});
    dem.gravity = 9.81;
    dem.planes.push_back({Vector3d::UnitZ(), 0});
    const double radius = disk.core.half.x() + disk.core.radius, speed = 0.1;
    dem.add(disk, {0, 0, radius - 2e-6}, {speed, 0, 0}, turned(Quaterniond::Identity(), {M_PI / 2, 0, 0}),
            {0, 0.8 * speed / radius, 0}); // slips at first
    for (int k = 0; k < 5000; ++k)
      dem.step();
    const double start = dem.bodies[0].v.x();
    double low = 1, high = 0;
    for (int k = 0; k < 50000; ++k) {
      dem.step();
      low = std::min(low, dem.bodies[0].x.z());
      high = std::max(high, dem.bodies[0].x.z());
    }
    const double lost = 1 - dem.bodies[0].v.x() / start;
    std::printf("%s: rolls, loses %.2e in 1 s, height varies by %.1e of the radius\n", line, lost,
                (high - low) / radius);
    EXPECT_GT(dem.bodies[0].x.x(), 0.09);
    EXPECT_LT(lost, 2e-3);
    EXPECT_GT(lost, -1e-4);
    EXPECT_LT((high - low) / radius, 1e-3);
  }
}

// A body that falls with 2.4 m/s on others, in a hole: nothing sticks in another.
TEST(SmoothMotion, FallsLeaveNothingStuck) {
  const Species cube(made("smooth cube rounding .15", diameter)), w(wedge());
  for (const Species* s : {&cube, &w}) {
    Random r(3);
    int stuck = 0, deep = 0;
    double fastest = 0;
    constexpr int falls = eccentra::test::repetitions(20, 4);
    for (int n = 0; n < falls; ++n) {
      SmallDem dem(Material{});
      dem.dt = 2e-5;
      dem.planes.push_back({Vector3d::UnitZ(), 0});
      dem.gravity = 9.81;
      dem.add(*s, {0, 0, s->core.bound}, Vector3d::Zero(), r.orientation());
      dem.add(*s, {0.3 * s->core.bound * r.uniform(-1, 1), 0.3 * s->core.bound * r.uniform(-1, 1), 3.1 * s->core.bound},
              {0, 0, -2.4}, r.orientation());
      dem.most_sunk = 0;
      for (int k = 0; k < 5000; ++k) {
        dem.step();
        fastest = std::max(fastest, std::max(dem.bodies[0].v.norm(), dem.bodies[1].v.norm()));
      }
      deep += dem.most_sunk > 0;
      const double apart =
          eccentra::contact::gjk_distance(dem.bodies[0].posed, dem.bodies[1].posed, dem.bodies[1].x - dem.bodies[0].x);
      stuck += apart == 0;
    }
    std::printf("falls at 2.4 m/s: cores met in %d of %d, stuck %d, fastest %.2f m/s\n", deep, falls, stuck, fastest);
    EXPECT_EQ(stuck, 0);
    EXPECT_LT(fastest, 2 * 2.5);
  }
}

// Impacts at 20 m/s, from a modulus at which bodies run through each other to one that holds them apart. Where the
// cores do not meet, energy is kept; where they meet, nothing sticks and no body flies off (the pair style warns of
// it).
TEST(SmoothMotion, HardImpactsEndApart) {
  const Species cube(made("smooth cube rounding .15", diameter)), w(wedge()),
      disk(made("smooth disk aspect .31 rounding .5", diameter));
  for (const Species* s : {&cube, &w, &disk})
    for (const double youngs : {5e6, 5e7, 5e8})
      for (const double restitution : {1., 0.5}) {
        Random r(8);
        int stuck = 0, deep = 0;
        double apart = 0, met = 0; // energy made [of that before] where the cores stay apart, and where they meet
        constexpr int impacts = eccentra::test::repetitions(20, 4);
        for (int n = 0; n < impacts; ++n) {
          Material material;
          material.youngs = youngs;
          material.restitution = restitution;
          material.friction = 0;
          SmallDem dem(material);
          dem.dt = 2e-6 * std::sqrt(5e6 / youngs);
          dem.add(*s, Vector3d::Zero(), {0, 0, 10}, r.orientation());
          dem.add(*s, Vector3d(0.5 * s->core.bound * r.uniform(-1, 1), 0, 2.1 * s->core.bound), {0, 0, -10},
                  r.orientation());
          const double before = dem.kinetic_energy();
          for (double time = 0; time < 1.5e-3; time += dem.dt)
            dem.step();
          deep += dem.most_sunk > 0;
          double& made = dem.most_sunk > 0 ? met : apart;
          made = std::max(made, dem.kinetic_energy() / before - 1);
          stuck += eccentra::contact::gjk_distance(dem.bodies[0].posed, dem.bodies[1].posed,
                                                   dem.bodies[1].x - dem.bodies[0].x) == 0;
        }
        std::printf(
            "impacts at 20 m/s, E %.0e, e %.1f: cores met in %d of %d, stuck %d, energy %+.1e, where they met %+.1e\n",
            youngs, restitution, deep, impacts, stuck, apart, met);
        EXPECT_EQ(stuck, 0);
        EXPECT_LT(apart, 1e-5);
        EXPECT_LT(met, restitution < 1 ? 1e-5 : 2);
        EXPECT_TRUE(youngs < 1e8 || deep == 0);
      }
}

// Bodies put into each other come apart, without flying off.
TEST(SmoothMotion, BodiesPutIntoEachOtherComeApart) {
  const Species cube(made("smooth cube rounding .15", diameter)), w(wedge()),
      disk(made("smooth disk aspect .31 rounding .5", diameter));
  for (const Species* s : {&cube, &w, &disk}) {
    Random r(21);
    int stuck = 0;
    double fastest = 0;
    constexpr int count = eccentra::test::repetitions(40, 8);
    for (int n = 0; n < count; ++n) {
      SmallDem dem(Material{});
      dem.dt = 1e-5;
      dem.add(*s, Vector3d::Zero(), Vector3d::Zero(), r.orientation());
      dem.add(*s, s->core.bound * r.uniform(0.3, 1.2) * r.direction(), Vector3d::Zero(), r.orientation());
      for (int k = 0; k < 3000; ++k) {
        dem.step();
        fastest = std::max(fastest, dem.bodies[1].v.norm());
      }
      stuck += eccentra::contact::gjk_distance(dem.bodies[0].posed, dem.bodies[1].posed,
                                               dem.bodies[1].x - dem.bodies[0].x) == 0;
    }
    std::printf("put into each other: %d of %d stuck, fastest %.1f m/s\n", stuck, count, fastest);
    EXPECT_EQ(stuck, 0);
  }
}

} // namespace
