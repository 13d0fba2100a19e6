// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Mass properties of unions of spheres against closed forms, invariances and an independent column integration.
#include "shape/union_geometry.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {
using namespace eccentra::shape;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double quadrature_error = 1e-9; // relative; measured errors are near 1e-11

std::vector<Sphere> random_cluster(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1), radius(0.4, 0.9);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i)
    spheres.push_back({Vector3d(coordinate(random), coordinate(random), coordinate(random)), radius(random)});
  return spheres;
}

void expect_same(const MassProperties& a, const MassProperties& b, double relative) {
  const double size = std::cbrt(a.volume);
  EXPECT_NEAR(a.volume, b.volume, relative * a.volume);
  EXPECT_NEAR(a.surface, b.surface, relative * a.surface);
  EXPECT_LT((a.centre - b.centre).norm(), relative * size);
  EXPECT_LT((a.inertia_per_mass - b.inertia_per_mass).norm(), relative * size * size);
}

TEST(UnionGeometry, SphereAwayFromTheOrigin) {
  const double r = 1.7;
  const Vector3d c(0.3, -2.1, 5.5);
  const MassProperties p = measure_union({{c, r}}).properties;
  EXPECT_NEAR(p.volume, 4 * M_PI / 3 * r * r * r, 1e-12 * p.volume);
  EXPECT_NEAR(p.surface, 4 * M_PI * r * r, 1e-12 * p.surface);
  EXPECT_LT((p.centre - c).norm(), 1e-13);
  EXPECT_LT((p.inertia_per_mass - 0.4 * r * r * Matrix3d::Identity()).norm(), 1e-12);
}

// Two spheres of radius r1, r2 whose centres are d apart share a lens made of two spherical segments.
TEST(UnionGeometry, LensOfTwoUnequalSpheresInAnyDirection) {
  const double r1 = 1.0, r2 = 0.8, d = 1.1;
  const double x0 = (d * d + r1 * r1 - r2 * r2) / (2 * d); // plane of the common circle, from centre 1
  const double h1 = r1 - x0, h2 = r2 - (d - x0);
  auto segment = [](double r, double h) { return M_PI * h * h * (3 * r - h) / 3; };
  const double volume = 4 * M_PI / 3 * (r1 * r1 * r1 + r2 * r2 * r2) - segment(r1, h1) - segment(r2, h2);
  const double surface = 4 * M_PI * (r1 * r1 + r2 * r2) - 2 * M_PI * (r1 * h1 + r2 * h2);
  // Moments along the axis, from the profile of the union: integral of pi rho^2 x^k and pi rho^4 / 4.
  auto slab = [](double r, double c, double a, double b, int power) { // integral over x of pi (r^2 - (x-c)^2) x^power
    auto primitive = [&](double x) {
      const double k = r * r - c * c;
      return M_PI * (k * std::pow(x, power + 1) / (power + 1) + 2 * c * std::pow(x, power + 2) / (power + 2) -
                     std::pow(x, power + 3) / (power + 3));
    };
    return primitive(b) - primitive(a);
  };
  auto quartic = [](double r, double c, double a,
                    double b) { // integral of pi rho^4 / 4: second moment about the axis / 2
    auto primitive = [&](double x) {
      const double t = x - c;
      return M_PI / 4 * (r * r * r * r * t - 2 * r * r * t * t * t / 3 + std::pow(t, 5) / 5);
    };
    return primitive(b) - primitive(a);
  };
  auto both = [&](auto f) { return f(r1, 0.0, -r1, x0) + f(r2, d, x0, d + r2); };
  const double first = both([&](double r, double c, double a, double b) { return slab(r, c, a, b, 1); });
  const double second = both([&](double r, double c, double a, double b) { return slab(r, c, a, b, 2); });
  const double across = both(quartic);
  const double centre = first / volume, along2 = second / volume - centre * centre, across2 = across / volume;
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 0, 1), Vector3d(0, 1e-7, 1), Vector3d(1, 2, -3)}) {
    const Vector3d n = direction.normalized();
    const MassProperties p = measure_union({{Vector3d::Zero(), r1}, {d * n, r2}}).properties;
    EXPECT_NEAR(p.volume, volume, quadrature_error * volume);
    EXPECT_NEAR(p.surface, surface, quadrature_error * surface);
    EXPECT_LT((p.centre - centre * n).norm(), quadrature_error);
    const Matrix3d expected = (along2 + across2) * Matrix3d::Identity() + (across2 - along2) * n * n.transpose();
    EXPECT_LT((p.inertia_per_mass - expected).norm(), quadrature_error) << direction.transpose();
  }
}

TEST(UnionGeometry, SpheresThatOnlyTouchAddUp) {
  const double r = 0.5;
  const MassProperties p =
      measure_union({{Vector3d(0, 0, 0), r}, {Vector3d(1, 0, 0), r}, {Vector3d(0, 1, 0), r}}).properties;
  EXPECT_NEAR(p.volume, 3 * 4 * M_PI / 3 * r * r * r, 1e-11);
  EXPECT_NEAR(p.surface, 3 * 4 * M_PI * r * r, 1e-10);
  EXPECT_LT((p.centre - Vector3d(1, 1, 0) / 3).norm(), 1e-11);
}

TEST(UnionGeometry, HiddenAndRepeatedSpheresChangeNothing) {
  std::vector<Sphere> spheres{{Vector3d(0, 0, 0), 1}, {Vector3d(0.7, 0.2, 0.1), 0.9}};
  const MassProperties before = measure_union(spheres).properties;
  spheres.push_back({Vector3d(0.1, 0, 0), 0.5});   // inside the first
  spheres.push_back({Vector3d(0, 0, 0), 1});       // the first once more
  spheres.push_back({Vector3d(0, 0, 0.25), 0.75}); // inside, touching from within
  const UnionGeometry after = measure_union(spheres);
  expect_same(after.properties, before, 1e-10);
  EXPECT_EQ(after.exposed_area[2], 0);
  EXPECT_EQ(after.exposed_area[3], 0);
  EXPECT_NEAR(after.exposed_area[4], 0, 1e-9);
}

TEST(UnionGeometry, TranslationRotationScaleAndOrder) {
  for (unsigned seed : {1u, 2u, 3u}) {
    const std::vector<Sphere> spheres = random_cluster(12, seed);
    const MassProperties p = measure_union(spheres).properties;
    const Matrix3d turn = (Eigen::AngleAxisd(0.7 + seed, Vector3d(1, 2, -0.5).normalized())).toRotationMatrix();
    const Vector3d shift(10, -20, 5);
    const double scale = 1e-3;
    std::vector<Sphere> moved;
    for (const Sphere& s : spheres)
      moved.push_back({scale * (turn * s.centre + shift), scale * s.radius});
    std::reverse(moved.begin(), moved.end());
    MassProperties back = measure_union(moved).properties;
    back.volume /= scale * scale * scale;
    back.surface /= scale * scale;
    back.centre = turn.transpose() * (back.centre / scale - shift);
    back.inertia_per_mass = turn.transpose() * back.inertia_per_mass * turn / (scale * scale);
    expect_same(back, p, quadrature_error);
  }
}

// Independent method: vertical lines through the union, whose lengths and moments are exact, summed over a fine grid.
MassProperties by_columns(const std::vector<Sphere>& spheres, int steps) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const Sphere& s : spheres) {
    low = low.cwiseMin((s.centre.array() - s.radius).matrix());
    high = high.cwiseMax((s.centre.array() + s.radius).matrix());
  }
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  const double hx = (high.x() - low.x()) / steps, hy = (high.y() - low.y()) / steps;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double x = low.x() + (i + 0.5) * hx, y = low.y() + (j + 0.5) * hy;
      std::vector<std::pair<double, double>> pieces;
      for (const Sphere& s : spheres) {
        const double rest = s.radius * s.radius - std::pow(x - s.centre.x(), 2) - std::pow(y - s.centre.y(), 2);
        if (rest > 0)
          pieces.emplace_back(s.centre.z() - std::sqrt(rest), s.centre.z() + std::sqrt(rest));
      }
      std::sort(pieces.begin(), pieces.end());
      double reached = -1e300;
      for (auto [a, b] : pieces) {
        a = std::max(a, reached);
        if (b <= a)
          continue;
        reached = b;
        const double l = b - a, z1 = (b * b - a * a) / 2, z2 = (b * b * b - a * a * a) / 3;
        volume += l;
        first += Vector3d(x * l, y * l, z1);
        Matrix3d m;
        m << x * x * l, x * y * l, x * z1, x * y * l, y * y * l, y * z1, x * z1, y * z1, z2;
        second += m;
      }
    }
  MassProperties p;
  p.volume = volume * hx * hy;
  p.centre = first / volume;
  second = (second / volume - p.centre * p.centre.transpose()).eval();
  p.inertia_per_mass = second.trace() * Matrix3d::Identity() - second;
  return p;
}

TEST(UnionGeometry, AgreesWithColumnsThroughRandomClusters) {
  for (unsigned seed : {4u, 5u, 6u}) {
    const std::vector<Sphere> spheres = random_cluster(20, seed);
    MassProperties p = measure_union(spheres).properties;
    MassProperties reference = by_columns(spheres, 700);
    reference.surface = p.surface;
    expect_same(p, reference, 1e-4); // the columns' own error, order 1/steps^1.5 at the silhouette
  }
}

// Lattices and rings: many rims cross in the same point or coincide, the hardest case for what is cut along latitudes.
TEST(UnionGeometry, AgreesWithColumnsThroughBuiltinShapes) {
  for (const auto& [family, count] :
       {std::pair<const char*, int>{"cube", 8}, {"cube", 27}, {"disk", 7}, {"disk", 19}}) {
    std::size_t used = 0;
    const std::vector<Sphere> spheres = make_shape({family, std::to_string(count)}, 0, used, 2.0).spheres();
    const MassProperties p = measure_union(spheres).properties;
    MassProperties reference = by_columns(spheres, 700);
    reference.surface = p.surface;
    expect_same(p, reference, 1e-4);
  }
}

// The surface is the derivative of the volume when every radius grows alike: independent of how areas are integrated.
TEST(UnionGeometry, SurfaceIsTheGrowthOfTheVolume) {
  const std::vector<Sphere> spheres = random_cluster(15, 7);
  const double step = 1e-4;
  auto grown = [&](double by) {
    std::vector<Sphere> s = spheres;
    for (Sphere& sphere : s)
      sphere.radius += by;
    return measure_union(s).properties.volume;
  };
  const double surface = measure_union(spheres).properties.surface;
  EXPECT_NEAR((grown(step) - grown(-step)) / (2 * step), surface, 1e-6 * surface);
}

TEST(UnionGeometry, RefusesWhatIsNoShape) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(measure_union({}), std::invalid_argument);
  EXPECT_THROW(measure_union({{Vector3d(0, 0, 0), 0}}), std::invalid_argument);
  EXPECT_THROW(measure_union({{Vector3d(0, 0, 0), -1}}), std::invalid_argument);
  EXPECT_THROW(measure_union({{Vector3d(0, nan, 0), 1}}), std::invalid_argument);
  EXPECT_THROW(measure_union({{Vector3d(0, 0, 0), nan}}), std::invalid_argument);
}

TEST(UnionGeometry, NamesTheSphereThatFallsOff) {
  try {
    require_connected({{Vector3d(0, 0, 0), 1}, {Vector3d(1.9, 0, 0), 1}, {Vector3d(5, 0, 0), 1}});
    FAIL() << "a sphere apart was accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("sphere 3 of 3"), std::string::npos) << e.what();
  }
  EXPECT_NO_THROW(require_connected({{Vector3d(0, 0, 0), 1}, {Vector3d(2, 0, 0), 1}, {Vector3d(4, 0, 0), 1}}));
}

} // namespace
