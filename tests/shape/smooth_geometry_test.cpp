// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies: mass properties in two ways, shadows, support and distance, the table of rounded cubes.
#include "shape/convex_hull.h"
#include "shape/directions.h"
#include "shape/drawn_surface.h"
#include "shape/principal_frame.h"
#include "shape/rounded_eccentricity.h"
#include "shape/rounded_moments.h"
#include "shape/shape_keywords.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace {
using namespace eccentra::shape;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Nodes and weights of Gauss-Legendre quadrature on [0, 1].
struct Gauss {
  std::vector<double> x, w;
  explicit Gauss(int n) {
    for (int i = 0; i < n; ++i) {
      double z = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 1;
      for (int k = 0; k < 100; ++k) {
        double p = 1, before = 0;
        for (int j = 1; j <= n; ++j) {
          const double last = before;
          before = p;
          p = ((2 * j - 1) * z * before - (j - 1) * last) / j;
        }
        slope = n * (z * p - before) / (z * z - 1);
        const double step = p / slope;
        z -= step;
        if (std::abs(step) < 1e-16)
          break;
      }
      x.push_back((1 - z) / 2);
      w.push_back(1 / ((1 - z * z) * slope * slope));
    }
  }
};

/// Volume, surface and moments as integrals over the surface: div x = 3, div(x x_i) = 4 x_i, div(x x_i x_j) = 5 x_i
/// x_j.
struct SurfaceSums {
  double surface = 0, volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  void add(const Vector3d& x, const Vector3d& n, double area) {
    const double flux = x.dot(n) * area;
    surface += area;
    volume += flux / 3;
    first += flux / 4 * x;
    second += flux / 5 * x * x.transpose();
  }
  MassProperties properties() const {
    const Vector3d c = first / volume;
    const Matrix3d m = second / volume - c * c.transpose();
    return {volume, surface, c, m.trace() * Matrix3d::Identity() - m};
  }
};

MassProperties by_surface(const ConvexCore& core, double r) {
  static const Gauss g(16);
  SurfaceSums sum;
  for (const CoreFace& face : core.faces)
    for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
      const Vector3d &a = core.vertices[face.corners[0]], &b = core.vertices[face.corners[k]],
                     &c = core.vertices[face.corners[k + 1]];
      const double twice = (b - a).cross(c - a).norm();
      for (std::size_t i = 0; i < g.x.size(); ++i)
        for (std::size_t j = 0; j < g.x.size(); ++j)
          sum.add(a + g.x[i] * ((1 - g.x[j]) * (b - a) + g.x[j] * (c - a)) + r * face.normal, face.normal,
                  twice * g.x[i] * g.w[i] * g.w[j]);
    }
  std::vector<std::vector<std::pair<Vector3d, Vector3d>>> arcs(core.vertices.size()); // short arcs around each cone
  std::vector<Vector3d> inward(core.vertices.size(), Vector3d::Zero());
  for (const CoreEdge& edge : core.edges) {
    const Vector3d &a = core.vertices[edge.from], &b = core.vertices[edge.to], e = (b - a).normalized();
    const Vector3d n = edge.left < 0 ? e.unitOrthogonal() : core.faces[edge.left].normal, m = e.cross(n);
    const double turn = core.turn(edge);
    const int pieces = 1 + static_cast<int>(turn / 0.4);
    const auto at = [&](double part) { return Vector3d(std::cos(part * turn) * n + std::sin(part * turn) * m); };
    for (int p = 0; p < pieces; ++p) {
      arcs[edge.to].push_back({at(double(p) / pieces), at((p + 1.) / pieces)});
      arcs[edge.from].push_back({at((p + 1.) / pieces), at(double(p) / pieces)});
      for (std::size_t i = 0; i < g.x.size(); ++i)
        for (std::size_t j = 0; j < g.x.size(); ++j) {
          const Vector3d u = at((p + g.x[i]) / pieces);
          sum.add(a + g.x[j] * (b - a) + r * u, u, (b - a).norm() * r * turn / pieces * g.w[i] * g.w[j]);
        }
    }
    inward[edge.from] -= e;
    inward[edge.to] += e;
  }
  for (std::size_t v = 0; v < core.vertices.size(); ++v)
    for (const auto& [from, to] : arcs[v]) {
      const Vector3d c = inward[v].normalized();
      const double det = std::abs(c.dot(from.cross(to)));
      const double sign = c.dot(from.cross(to)) < 0 ? -1 : 1;
      // In thin slices, so that the map from the flat triangle stays tame.
      constexpr int slices = 8;
      for (int s = 0; s < slices; ++s)
        for (std::size_t i = 0; i < g.x.size(); ++i)
          for (std::size_t j = 0; j < g.x.size(); ++j) {
            const double t = (s + g.x[i]) / slices;
            const Vector3d p = (1 - t) * c + t * ((1 - g.x[j]) * from + g.x[j] * to);
            const double length = p.norm();
            sum.add(core.vertices[v] + r * p / length, p / length,
                    sign * r * r * det * t * g.w[i] / slices * g.w[j] / (length * length * length));
          }
    }
  return sum.properties();
}

/// By slices across z, of half extent `outer`, where area(z) and second(z) = (of x, of y) are given; smooth in between.
struct Slice {
  double area, of_x, of_y;
};
MassProperties by_slices(double flat, double r, const std::function<Slice(double inset, double height)>& slice) {
  static const Gauss g(40);
  double volume = 0, xx = 0, yy = 0, zz = 0;
  const auto add = [&](const Slice& s, double z, double dz) {
    volume += s.area * dz;
    xx += s.of_x * dz;
    yy += s.of_y * dz;
    zz += s.area * z * z * dz;
  };
  for (std::size_t i = 0; i < g.x.size(); ++i) {
    add(slice(r, 0), flat * g.x[i], 2 * flat * g.w[i]);
    const double p = M_PI / 2 * g.x[i], z = flat + r * std::sin(p); // the slice is `r cos p` wider than the core
    add(slice(r * std::cos(p), r * std::sin(p)), z, 2 * r * std::cos(p) * M_PI / 2 * g.w[i]);
  }
  MassProperties m{volume, 0, Vector3d::Zero(), Matrix3d::Zero()};
  m.inertia_per_mass.diagonal() = Vector3d(yy + zz, xx + zz, xx + yy) / volume;
  return m;
}

/// A rectangle of half edges a, b swept by a disc of radius q: area and second moments.
Slice rounded_rectangle(double a, double b, double q) {
  const auto second = [q](double x, double y) {       // of x, half edges x and y
    const double quarter = q * q * q * q * M_PI / 16; // of a quarter disc about its centre
    return 4 * (y * (x + q) * (x + q) * (x + q) / 3 + x * x * x / 3 * q +
                (x * x * M_PI * q * q / 4 + 2 * x * q * q * q / 3 + quarter));
  };
  return {4 * a * b + 4 * (a + b) * q + M_PI * q * q, second(a, b), second(b, a)};
}

void expect_same(const MassProperties& a, const MassProperties& b, double tolerance, const std::string& what) {
  const double size = std::cbrt(a.volume), inertia = a.inertia_per_mass.cwiseAbs().maxCoeff();
  EXPECT_NEAR(b.volume / a.volume, 1, tolerance) << what;
  EXPECT_LT((a.centre - b.centre).norm() / size, tolerance) << what;
  EXPECT_LT((a.inertia_per_mass - b.inertia_per_mass).cwiseAbs().maxCoeff() / inertia, tolerance) << what;
}

std::vector<Vector3d> scattered(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  for (int k = 0; k < count; ++k)
    points.push_back(Vector3d(normal(random), 1.4 * normal(random), 0.8 * normal(random)) + Vector3d(3, -2, 1));
  return points;
}

/// One of every kind of core: solids, polygons, segments, a point.
std::vector<std::pair<std::string, ConvexCore>> cores() {
  const double c = 1;
  std::vector<std::pair<std::string, ConvexCore>> all{
      {"cube", box_core({c, c, c})},
      {"box", box_core({0.3, 1, 0.7})},
      {"rectangle", box_core({0.3, 0, 0.7})},
      {"segment", box_core({0, 0.4, 0})},
      {"point", box_core({0, 0, 0})},
      {"octahedron", convex_hull({{c, 0, 0}, {-c, 0, 0}, {0, c, 0}, {0, -c, 0}, {0, 0, c}, {0, 0, -c}})},
      {"wedge", convex_hull({{-c, -c, -c},
                             {c, -c, -c},
                             {0.3 * c, 1.2 * c, -c},
                             {-c, -c, c},
                             {c, -c, 0.7 * c},
                             {0.3 * c, 1.2 * c, 0.35 * 0.7 * c + 0.2285 * c}})}};
  for (const unsigned seed : {1u, 2u, 3u})
    all.emplace_back("hull of 30 points", convex_hull(scattered(30, seed)));
  return all;
}

TEST(SmoothGeometry, MassIsThatOfTheSurfaceIntegrals) {
  for (const auto& [name, core] : cores())
    for (const double r : {0.05, 0.5, 2.})
      if (core.dimension() > 0) {
        const MassProperties exact = rounded_mass(core, r), other = by_surface(core, r);
        expect_same(exact, other, 1e-12, name + " " + std::to_string(r));
        EXPECT_NEAR(other.surface / exact.surface, 1, 1e-12) << name;
      }
}

TEST(SmoothGeometry, MassIsThatOfSlices) {
  for (const double r : {0.02, 0.3, 1.}) {
    for (const Vector3d& half : {Vector3d(1, 1, 1), Vector3d(0.3, 1, 0.7), Vector3d(0, 0.6, 0.4), Vector3d(0, 0, 0.5)})
      expect_same(
          rounded_mass(box_core(half), r),
          by_slices(half.z(), r, [&](double inset, double) { return rounded_rectangle(half.x(), half.y(), inset); }),
          1e-12, "box");
    for (const DiskCore& disk : {DiskCore{1, 0.2}, DiskCore{1, 0}, DiskCore{0.3, 2}, DiskCore{0, 1}, DiskCore{0, 0}})
      expect_same(rounded_mass(disk, r),
                  by_slices(disk.half_height, r,
                            [&](double inset, double) {
                              const double q = disk.radius + inset, area = M_PI * q * q;
                              return Slice{area, area * q * q / 4, area * q * q / 4};
                            }),
                  1e-12, "disk");
  }
}

TEST(SmoothGeometry, PointAndSegmentAreBallAndRod) {
  const MassProperties ball = rounded_mass(box_core({0, 0, 0}), 2);
  EXPECT_NEAR(ball.volume, 32 * M_PI / 3, 1e-13 * 32);
  EXPECT_NEAR(ball.inertia_per_mass(0, 0), 0.4 * 4, 1e-14);
  const MassProperties rod = rounded_mass(box_core({0, 0, 1.5}), 1), disk = rounded_mass(DiskCore{0, 1.5}, 1);
  expect_same(rod, disk, 1e-14, "rod");
  EXPECT_NEAR(rod.volume, M_PI * 3 + 4 * M_PI / 3, 1e-13);
  EXPECT_NEAR(rod.surface, 2 * M_PI * 3 + 4 * M_PI, 1e-13);
  EXPECT_NEAR(disk.surface, rod.surface, 1e-13);
}

RoundedHull made(const std::string& line, double diameter) {
  std::vector<std::string> arguments;
  std::size_t used = 0;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    arguments.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  const ClusterShape shape = make_shape(arguments, 0, used, diameter);
  EXPECT_EQ(used, arguments.size());
  return *shape.hull();
}

TEST(SmoothGeometry, TableOfRoundedCubes) {
  struct Row {
    double rounding, half_edge, radius, sphericity, bound, inertia;
  };
  for (const Row& row : {Row{.05, 2.560, .128, .823, 1.367, 1.082},
                         {.1, 2.564, .256, .839, 1.340, 1.079},
                         {.15, 2.571, .386, .854, 1.314, 1.075},
                         {.2, 2.580, .516, .869, 1.289, 1.070},
                         {.3, 2.606, .782, .896, 1.242, 1.058},
                         {.4, 2.643, 1.057, .921, 1.198, 1.045},
                         {.5, 2.691, 1.346, .942, 1.158, 1.033}}) {
    const RoundedHull cube = made("smooth cube rounding " + std::to_string(row.rounding), 6.35e-3);
    const double r_eq = cube.equivalent_radius();
    EXPECT_NEAR(r_eq, 3.175e-3, 1e-15);
    EXPECT_NEAR(cube.radius() * 1e3, row.radius, 6e-4);
    EXPECT_NEAR(cube.radius() / row.rounding * 1e3, row.half_edge, 6e-4);
    EXPECT_NEAR(cube.sphericity(), row.sphericity, 6e-4);
    EXPECT_NEAR(cube.bounding_radius() / r_eq, row.bound, 6e-4);
    EXPECT_NEAR(cube.inertia_per_mass()[0] / (0.4 * r_eq * r_eq), row.inertia, 6e-4);
    // The same body by its sphericity.
    const RoundedHull again = made("smooth cube sphericity " + std::to_string(cube.sphericity()), 6.35e-3);
    EXPECT_NEAR(again.radius() / cube.radius(), 1, 1e-3);
  }
}

TEST(SmoothGeometry, RoundingOneIsASphere) {
  for (const char* line :
       {"smooth cube rounding 1", "smooth box 2 2 2 rounding 1", "smooth disk aspect 1 rounding 1"}) {
    const RoundedHull ball = made(line, 2);
    EXPECT_NEAR(ball.radius(), 1, 1e-15) << line;
    EXPECT_NEAR(ball.bounding_radius(), 1, 1e-15);
    EXPECT_NEAR(ball.sphericity(), 1, 1e-14);
    EXPECT_NEAR(ball.inertia_per_mass()[0], 0.4, 1e-14);
    EXPECT_LT(eccentricity_plane(ball).max(), 1e-14);
  }
}

TEST(SmoothGeometry, DisksHaveTheirOuterExtents) {
  for (const double aspect : {0.2, 0.31, 1., 2.5})
    for (const double rounding : {0.1, 0.5, 1.}) {
      const RoundedHull disk =
          made("smooth disk aspect " + std::to_string(aspect) + " rounding " + std::to_string(rounding), 0.01);
      const double thick = 2 * (disk.support({0, 0, 1}).z() + disk.radius()),
                   wide = 2 * (disk.support({1, 0, 0}).x() + disk.radius());
      EXPECT_NEAR(thick / wide, aspect, 1e-6);
      EXPECT_NEAR(2 * disk.radius() / std::min(thick, wide), rounding, 1e-6);
    }
}

// The shadow's area by its support function: A = 1/2 integral of (h^2 - h'^2) over the angle.
double shadow_by_support(const RoundedHull& hull, const Vector3d& u) {
  const Vector3d a = u.unitOrthogonal(), b = u.cross(a);
  const int count = 200000;
  double area = 0;
  for (int k = 0; k < count; ++k) { // polygon of support points
    const auto at = [&](int n) {
      const double p = 2 * M_PI * (n % count + 0.5) / count;
      const Vector3d d = std::cos(p) * a + std::sin(p) * b;
      return Vector3d(hull.support(d) + hull.radius() * d);
    };
    const Vector3d p = at(k), q = at(k + 1);
    area += (p.dot(a) * q.dot(b) - p.dot(b) * q.dot(a)) / 2;
  }
  return area;
}

TEST(SmoothGeometry, ShadowsAndTheirMean) {
  std::vector<RoundedHull> hulls;
  for (const auto& [name, core] : cores())
    hulls.emplace_back(name, core, 0.3);
  hulls.emplace_back("disk", DiskCore{1, 0.3}, 0.1);
  hulls.emplace_back("flat disk", DiskCore{1, 0}, 0.2);
  for (const RoundedHull& hull : hulls) {
    for (const Vector3d& u : {Vector3d(1, 0.2, 0.3), Vector3d(-0.1, 1, 0.4), Vector3d(0.3, -0.2, 1)})
      EXPECT_NEAR(hull.projected_area(u) / shadow_by_support(hull, u.normalized()), 1, 2e-6) << hull.name();
    double mean = 0;
    const int count = 4000;
    for (int k = 0; k < count; ++k)
      mean += hull.projected_area(fibonacci_direction(k, count)) / count;
    EXPECT_NEAR(mean / hull.mean_projected_area(), 1, 2e-5) << hull.name(); // Cauchy: a quarter of the surface
  }
  const RoundedHull cube("cube", box_core({1, 1, 1}), 0.5);
  EXPECT_NEAR(cube.projected_area({0, 0, 1}), 4 + 8 * 0.5 + M_PI * 0.25, 1e-14);
}

// The closest point of a convex core is where the support plane across the normal passes.
TEST(SmoothGeometry, DistanceOfAPoint) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<RoundedHull> hulls;
  for (const auto& [name, core] : cores())
    hulls.emplace_back(name, core, 0.3);
  hulls.emplace_back("disk", DiskCore{1, 0.3}, 0.1);
  hulls.emplace_back("flat disk", DiskCore{1, 0}, 0.2);
  for (const RoundedHull& hull : hulls)
    for (int k = 0; k < 3000; ++k) {
      const Vector3d p = 1.5 * Vector3d(normal(random), normal(random), normal(random));
      const CoreDistance d = hull.distance_to_core(p);
      EXPECT_NEAR(d.normal.norm(), 1, 1e-12);
      EXPECT_NEAR(d.normal.dot(p - hull.support(d.normal)), d.distance, 1e-9) << hull.name();
    }
}

TEST(SmoothGeometry, EccentricityOnAPlane) {
  // A plane touches a rounded cube at a corner of the core, however it is rounded: c |d x n|, greatest on the edge
  // between two faces, where it is c |(1,1,1) x (1,0,0)|.
  for (const double rounding : {0.1, 0.5}) {
    const RoundedHull cube = made("smooth cube rounding " + std::to_string(rounding), 2);
    const double c = cube.radius() / rounding - cube.radius();
    const EccentricityDistribution d = eccentricity_plane(cube);
    EXPECT_NEAR(d.max(), c * std::sqrt(2), 1e-6);
    EXPECT_NEAR(d.min(), 0, 1e-6);
    // A large sphere is a plane.
    EXPECT_NEAR(eccentricity_sphere(cube, 1e5).max(), d.max(), 1e-3);
    EXPECT_NEAR(eccentricity_surface(cube).max(), d.max(), 1e-2 * d.max());
  }
  // On a flat disk's rim |c x n| = c |cos| of the angle to the plane of the disk's axis: mean over directions 1/2 c.
  const RoundedHull disk("disk", DiskCore{1, 0}, 0.3);
  EXPECT_NEAR(eccentricity_plane(disk).mean() * disk.equivalent_radius(), 0.5, 1e-3);
  EXPECT_NEAR(eccentricity_plane(disk).max() * disk.equivalent_radius(), 1, 1e-6);
}

// Over the surface of a cylinder with rims of no radius: flat parts |x| and |z|.
TEST(SmoothGeometry, EccentricityOverTheSurface) {
  const double c = 1, k = 0.6, r = 1e-4;
  const RoundedHull disk("disk", DiskCore{c, k}, r);
  const double flat = 2 * M_PI * c * c, side = 4 * M_PI * c * k;
  const double mean = (flat * 2 * c / 3 + side * k / 2) / (flat + side);
  EXPECT_NEAR(eccentricity_surface(disk).mean() * disk.equivalent_radius(), mean, 1e-3);
  const ConvexCore box = box_core({c, c, c});
  const RoundedHull cube("cube", box, r);
  // Mean distance from the middle of a square of half edge 1.
  const double of_square = (std::sqrt(2) + std::log(1 + std::sqrt(2))) / 3;
  EXPECT_NEAR(eccentricity_surface(cube).mean() * cube.equivalent_radius(), of_square, 1e-3);
}

TEST(SmoothGeometry, HullsAreThinned) {
  std::vector<Vector3d> sphere;
  for (int k = 0; k < 2000; ++k)
    sphere.push_back(fibonacci_direction(k, 2000));
  const ThinnedHull thin = thinned_hull(sphere);
  EXPECT_LE(thin.core.vertices.size(), 64u);
  EXPECT_GT(thin.core.vertices.size(), 60u);
  EXPECT_LT(thin.error, 0.12); // 64 points on a sphere leave caps of about 1/8
  double worst = 0;
  for (const Vector3d& p : sphere)
    worst = std::max(worst, distance_to_core(thin.core, p).distance);
  EXPECT_NEAR(worst, thin.error, 0.02);
  // A cube of many points, with the digits of a float, is a cube.
  std::vector<Vector3d> cube;
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; j <= 6; ++j)
      for (int k = 0; k <= 6; ++k)
        cube.push_back((Vector3d(i, j, k) / 7).cast<float>().cast<double>());
  const ConvexCore core = convex_hull(cube);
  EXPECT_EQ(core.vertices.size(), 8u);
  EXPECT_EQ(core.faces.size(), 6u);
  EXPECT_EQ(core.edges.size(), 12u);
  EXPECT_NEAR(least_width(core), 6. / 7, 1e-6);
  EXPECT_NEAR(least_width(box_core({1, 2, 3})), 2, 1e-14);
}

// Closed, right side out, on the body's surface; its volume comes to the body's as it gets finer.
TEST(SmoothGeometry, SurfaceToDraw) {
  for (const char* line :
       {"smooth cube rounding .15", "smooth box 1 3 3 rounding 1", "smooth box 1 1 3 rounding 1",
        "smooth cube rounding 1", "smooth disk aspect .31 rounding .5", "smooth disk aspect .31 rounding 1"}) {
    const RoundedHull hull = made(line, 1);
    double error[2];
    for (int way = 0; way < 2; ++way) {
      const eccentra::shape::TriangleSurface surface = eccentra::shape::drawn_surface(hull, way ? 16 : 8);
      for (const auto& p : surface.points) {
        EXPECT_NEAR(hull.distance_to_core(p.position).distance, hull.radius(), 1e-12) << line;
        EXPECT_NEAR((p.normal.cross(hull.distance_to_core(p.position).normal)).norm(), 0, 1e-9) << line;
        EXPECT_LT(p.vertex, static_cast<int>(hull.points().size())) << line;
      }
      double volume = 0;
      Vector3d area = Vector3d::Zero();
      for (const auto& t : surface.triangles) {
        const Vector3d &a = surface.points[t[0]].position, &b = surface.points[t[1]].position,
                       &c = surface.points[t[2]].position;
        volume += a.dot(b.cross(c)) / 6;
        area += (b - a).cross(c - a) / 2;
        EXPECT_GE((b - a).cross(c - a).dot(surface.points[t[0]].normal), -1e-15) << line;
      }
      EXPECT_LT(area.norm(), 1e-12) << line;
      error[way] = 1 - volume / hull.volume();
    }
    EXPECT_GT(error[1], 0) << line;
    EXPECT_LT(error[1], 0.01) << line;
    EXPECT_NEAR(error[0] / error[1], 4, 0.4) << line; // second order
  }
}

// A body meets another as it meets a sphere or a plane where that is what the other is.
TEST(SmoothGeometry, EccentricityAgainstOtherBodies) {
  std::size_t used = 0;
  const auto shape = [&](const std::vector<std::string>& words) { return make_shape(words, 0, used, 1); };
  const ClusterShape cube = shape({"smooth", "cube", "rounding", ".3"}),
                     ball = shape({"smooth", "cube", "rounding", "1"}), sphere = shape({"sphere", "1"}),
                     cluster = shape({"cube", "8"});
  const double on_sphere = eccentra::shape::eccentricity_sphere(cube, 0.5).mean();
  EXPECT_NEAR(eccentricity_cluster(cube, ball).mean(), on_sphere, 3e-3);
  EXPECT_NEAR(eccentricity_cluster(cube, sphere).mean(), on_sphere, 3e-3);
  EXPECT_NEAR(eccentricity_cluster(cluster, ball).mean(), eccentricity_cluster(cluster, sphere).mean(), 1e-9);
  const double both = eccentricity_cluster(cube, cube).mean();
  EXPECT_GT(both, eccentra::shape::eccentricity_plane(sphere).mean());
  EXPECT_LT(both, eccentra::shape::eccentricity_plane(cube).max());
}

void expect_refused(const std::string& line, double diameter, const std::string& part) {
  try {
    made(line, diameter);
    ADD_FAILURE() << line << " was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << line << ": " << error.what();
  }
}

TEST(SmoothGeometry, WordsThatAreRefused) {
  expect_refused("smooth", 1, "last word");
  expect_refused("smooth ball rounding .1", 1, "'ball'");
  expect_refused("smooth cube", 1, "'rounding R' is not given");
  expect_refused("smooth cube rounding", 1, "last word");
  expect_refused("smooth cube rounding 0", 1, "'0'");
  expect_refused("smooth cube rounding -1", 1, "'-1'");
  expect_refused("smooth cube rounding nan", 1, "'nan'");
  expect_refused("smooth cube rounding 1.2", 1, "'1.2'");
  expect_refused("smooth cube rounding 0.001", 1, "'0.001'");
  expect_refused("smooth cube rounding .1 rounding .2", 1, "not given once");
  expect_refused("smooth cube rounding .1 sphericity .9", 1, "one of the two");
  expect_refused("smooth cube sphericity .7", 1, "from 0.80");
  expect_refused("smooth cube sphericity 1.1", 1, "up to 1");
  expect_refused("smooth cube rounding .1", 0, "no size of its own");
  expect_refused("smooth cube rounding .1", NAN, "finite");
  expect_refused("smooth cube rounding .1 contact_radius 0", 1, "contact_radius");
  expect_refused("smooth box 1 2 rounding .1", 1, "'rounding'");
  expect_refused("smooth box 1 2 0 rounding .1", 1, "'0'");
  expect_refused("smooth disk .3 rounding .1", 1, "aspect");
  expect_refused("smooth disk aspect inf rounding .1", 1, "'inf'");
  expect_refused("smooth disk rounding .1", 1, "aspect");
  expect_refused("hull nothing.stl rounding .1", 1, "no reader");
}

TEST(SmoothGeometry, WordsThatAreTaken) {
  const RoundedHull box = made("smooth box 1e-3 2e-3 3e-3 rounding .5 contact_radius 1e-4", 0);
  EXPECT_NEAR(box.radius(), 2.5e-4, 1e-16);
  EXPECT_EQ(box.contact_radius(), 1e-4);
  EXPECT_NEAR(box.support({0, 0, 1}).z(), 1.25e-3, 1e-15);
  for (const double s : {0.82, 0.85, 0.9, 0.99})
    EXPECT_NEAR(made("smooth cube sphericity " + std::to_string(s), 1).sphericity(), s, 1e-9);
  for (const double s : {0.75, 0.79})
    EXPECT_NEAR(made("smooth disk aspect .3 sphericity " + std::to_string(s), 1).sphericity(), s, 1e-9);
  std::size_t used = 0;
  make_shape({"x", "smooth", "cube", "rounding", ".2", "diameter", "3"}, 1, used, 3);
  EXPECT_EQ(used, 4u);
}

TEST(SmoothGeometry, PrincipalFrameOfAHullGivenAnywhere) {
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  ConvexCore core = box_core({0.5, 1, 2});
  std::vector<Vector3d> points;
  for (const Vector3d& v : core.vertices)
    points.push_back(turn * v + Vector3d(5, 6, 7));
  const RoundedHull hull("box", convex_hull(points), 0.2), straight("box", core, 0.2);
  EXPECT_LT((hull.given_centre() - Vector3d(5, 6, 7)).norm(), 1e-12);
  Vector3d a = hull.inertia_per_mass(), b = straight.inertia_per_mass();
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  EXPECT_LT((a - b).norm(), 1e-11);
  for (const Vector3d& v : hull.polyhedron()->vertices) {
    Vector3d sorted = v.cwiseAbs();
    std::sort(sorted.begin(), sorted.end());
    EXPECT_LT((sorted - Vector3d(0.5, 1, 2)).norm(), 1e-6);
  }
}

} // namespace
