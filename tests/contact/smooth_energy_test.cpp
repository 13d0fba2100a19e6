// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic impacts without friction of rounded bodies of all kinds: energy stays, up to the square of the time step.
#include "contact/small_dem.h"
#include "contact/test_bodies.h"
#include "support/sanitized.h"

#include <gtest/gtest.h>

namespace {
using namespace small_dem;

struct Energy {
  double worst = 0, mean = 0;
  int hits = 0;
};

/// Elastic impacts without friction, anyhow: the change of energy over the energy before.
Energy elastic_impacts(const Species& a, const Species& b, double dt, int count) {
  Random r(7);
  Energy result;
  Material m;
  m.restitution = 1;
  m.friction = 0;
  for (int n = 0; n < count; ++n) {
    SmallDem dem(m);
    dem.dt = dt;
    const double size = a.core.bound + b.core.bound, speed = 0.2;
    const Vector3d aim = 0.3 * size * Vector3d(r.uniform(-1, 1), r.uniform(-1, 1), 0);
    const Quaterniond qa = r.orientation(), qb = r.orientation();
    const Vector3d wa = 20 * r.direction(), wb = 20 * r.direction();
    dem.add(a, Vector3d::Zero(), Vector3d::Zero(), qa, wa);
    dem.add(b, aim + Vector3d(0, 0, 1.02 * size), {0, 0, -speed}, qb, wb);
    const double before = dem.kinetic_energy();
    double after = before;
    bool touched = false;
    for (int k = 0; k < 0.06 / dt; ++k) {
      dem.step();
      touched |= dem.contacts > 0;
      if (touched && dem.contacts == 0) {
        after = dem.kinetic_energy();
        if ((dem.bodies[1].x - dem.bodies[0].x).norm() > size)
          break;
      }
    }
    if (!touched)
      continue;
    ++result.hits;
    const double change = std::abs(after - before) / before;
    EXPECT_FALSE(std::isnan(change));
    result.worst = std::max(result.worst, change);
    result.mean += change;
  }
  result.mean /= std::max(1, result.hits);
  return result;
}

void expect_elastic(const Species& a, const Species& b, int impacts, double bound, const char* name) {
  const int count = eccentra::test::repetitions(impacts, 10);
  const int few = std::min(count, 40); // for the comparison of steps
  const Energy fine = elastic_impacts(a, b, 2e-6, count), coarse = elastic_impacts(a, b, 4e-6, few);
  const Energy same = few < count ? elastic_impacts(a, b, 2e-6, few) : fine;
  EXPECT_GT(fine.hits, count / 4) << name;
  EXPECT_LT(fine.worst, bound) << name;
  EXPECT_LT(same.mean, coarse.mean / 2.5) << name; // with dt^2 a quarter
  std::printf("%s: %d impacts, |dE/E| at 2 us mean %.1e worst %.1e; at 4 us %.1e %.1e\n", name, fine.hits, fine.mean,
              fine.worst, coarse.mean, coarse.worst);
}

TEST(SmoothEnergy, OfImpactsOfCubes) {
  const Species cube(made("smooth cube rounding .15", diameter));
  expect_elastic(cube, cube, 500, 1e-6, "cube");
}
TEST(SmoothEnergy, OfImpactsOfPolyhedra) {
  const Species w(wedge()), o(octahedron()), box(made("smooth box 1 2 3 rounding .3", diameter));
  expect_elastic(w, w, 40, 1e-6, "wedge");
  expect_elastic(o, box, 40, 1e-6, "octahedron and box");
}
TEST(SmoothEnergy, OfImpactsOfRodsAndPlates) {
  const Species rod(made("smooth box 1 1 3 rounding 1", diameter)),
      plate(made("smooth box 1 3 3 rounding 1", diameter)), cube(made("smooth cube rounding .15", diameter)),
      ball(made("smooth cube rounding 1", diameter));
  expect_elastic(rod, rod, 40, 5e-6, "rods"); // nearly parallel, their closest points run fast
  expect_elastic(plate, rod, 40, 1e-6, "plate and rod");
  expect_elastic(plate, cube, 40, 1e-6, "plate and cube");
  expect_elastic(cube, ball, 40, 1e-6, "cube and ball");
}
TEST(SmoothEnergy, OfImpactsOfDisks) {
  const Species round(made("smooth disk aspect .31 rounding 1", diameter)),
      flat(made("smooth disk aspect .31 rounding .5", diameter)), cube(made("smooth cube rounding .15", diameter));
  expect_elastic(round, round, 40, 1e-5, "disks with round rims");
  expect_elastic(flat, flat, 40, 1e-5, "disks with two rims");
  expect_elastic(flat, cube, 40, 1e-5, "disk and cube");
}

} // namespace
