// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of delta_e: closed forms, reference statistics of the built-in shapes, invariances.
#include "shape/directions.h"
#include "shape/eccentricity.h"
#include "shape/union_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace {
using namespace eccentra::shape;
using Eigen::Vector3d;

ClusterShape builtin(const std::string& family, int count) {
  std::size_t used = 0;
  return make_shape({family, std::to_string(count)}, 0, used, 6.35e-3);
}

TEST(Eccentricity, OfASphereIsZero) {
  const ClusterShape s = builtin("sphere", 1);
  for (const auto& d : {eccentricity_plane(s), eccentricity_sphere(s, s.equivalent_radius()), eccentricity_surface(s),
                        eccentricity_cluster(s, builtin("cube", 8))})
    EXPECT_EQ(d.max(), 0);
}

// Two equal spheres a apart on a line: a plane touches the nearer one, |c x n| = (a/2) sin(angle), whose mean is pi/4.
TEST(Eccentricity, OfADumbbellOnAPlane) {
  const double r = 1, a = 1.6;
  const std::vector<Sphere> spheres{{Vector3d(0, 0, 0), r}, {Vector3d(a, 0, 0), r}};
  const ClusterShape s("dumbbell", spheres, measure_union(spheres).properties);
  const double unit = a / 2 / s.equivalent_radius();
  const EccentricityDistribution d = eccentricity_plane(s);
  EXPECT_NEAR(d.min(), 0, 1e-6);
  EXPECT_NEAR(d.mean(), unit * M_PI / 4, 1e-4 * unit);
  EXPECT_NEAR(d.max(), unit, 1e-6 * unit);
  // P(sin(angle) <= q) = 1 - sqrt(1 - q^2) over uniform directions
  for (double q : {0.2, 0.5, 0.9})
    EXPECT_NEAR(d.quantile(1 - std::sqrt(1 - q * q)), q * unit, 1e-3 * unit);
}

// The free part of each sphere of the dumbbell is cos(angle) < a / 2r seen from the other sphere's side.
TEST(Eccentricity, OfADumbbellOverItsSurface) {
  const double r = 1, a = 1.2, cap = a / 2 / r;
  const std::vector<Sphere> spheres{{Vector3d(0, 0, 0), r}, {Vector3d(a, 0, 0), r}};
  const ClusterShape s("dumbbell", spheres, measure_union(spheres).properties);
  // mean of sin over cos in [-1, cap]: integral of sqrt(1 - x^2) dx / (1 + cap)
  const double mean = (cap * std::sqrt(1 - cap * cap) + std::asin(cap) + M_PI / 2) / 2 / (1 + cap);
  const double unit = a / 2 / s.equivalent_radius();
  const EccentricityDistribution d = eccentricity_surface(s);
  EXPECT_NEAR(d.mean(), unit * mean, 1e-3 * unit);
  EXPECT_NEAR(d.max(), unit, 1e-4 * unit);
}

TEST(Eccentricity, OfALargeSphereIsThatOfAPlane) {
  const ClusterShape s = builtin("cube", 27);
  const EccentricityDistribution plane = eccentricity_plane(s),
                                 sphere = eccentricity_sphere(s, 1e5 * s.equivalent_radius());
  EXPECT_NEAR(sphere.mean(), plane.mean(), 1e-3 * plane.mean());
  EXPECT_NEAR(sphere.max(), plane.max(), 1e-3 * plane.max());
}

TEST(Eccentricity, OfAClusterAgainstASphereClusterIsThatOfTheSphere) {
  const ClusterShape s = builtin("disk", 19), ball = builtin("sphere", 1);
  const EccentricityDistribution a = eccentricity_cluster(s, ball),
                                 b = eccentricity_sphere(s, ball.equivalent_radius());
  EXPECT_NEAR(a.mean(), b.mean(), 3e-3 * b.mean());
  EXPECT_NEAR(a.max(), b.max(), 3e-3 * b.max());
}

TEST(Eccentricity, DirectionsAndRotationsAreUniform) {
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero(), rotated = second, mean = second;
  const int count = 20000;
  for (int k = 0; k < count; ++k) {
    const DirectionAndRotation w = even_direction_and_rotation(k);
    const Eigen::Matrix3d r = w.rotation.toRotationMatrix();
    EXPECT_NEAR(w.rotation.norm(), 1, 1e-14);
    second += w.direction * w.direction.transpose() / count;
    rotated += r.col(0) * r.col(0).transpose() / count;
    mean += r / count;
  }
  EXPECT_LT((second - Eigen::Matrix3d::Identity() / 3).norm(), 2e-3);
  EXPECT_LT((rotated - Eigen::Matrix3d::Identity() / 3).norm(), 2e-3);
  EXPECT_LT(mean.norm(), 3e-3);
}

/// Means and maxima over 2e5 random orientations (plane, sphere, surface); over 4000 to 200,000 random pairs (cluster).
struct Reference {
  const char* family;
  int count;
  double plane_mean, plane_max, sphere_mean, sphere_max, surface_mean, surface_max, cluster_mean, cluster_max;
  double cluster_error; ///< three standard errors of the reference's own sample of pairs
};
void PrintTo(const Reference& r, std::ostream* out) {
  *out << r.family << r.count;
}

class ReferenceStatistics : public testing::TestWithParam<Reference> {};

TEST_P(ReferenceStatistics, AreMetWithinOnePercent) {
  const Reference& r = GetParam();
  const ClusterShape s = builtin(r.family, r.count);
  const double part = 0.01;
  const EccentricityDistribution plane = eccentricity_plane(s), sphere = eccentricity_sphere(s, s.equivalent_radius());
  const EccentricityDistribution surface = eccentricity_surface(s), cluster = eccentricity_cluster(s, s);
  EXPECT_NEAR(plane.min(), 0, 1e-3);
  EXPECT_NEAR(plane.mean(), r.plane_mean, part * r.plane_mean);
  EXPECT_NEAR(plane.max(), r.plane_max, part * r.plane_max);
  EXPECT_NEAR(sphere.mean(), r.sphere_mean, part * r.sphere_mean);
  EXPECT_NEAR(sphere.max(), r.sphere_max, part * r.sphere_max);
  EXPECT_NEAR(surface.mean(), r.surface_mean, part * r.surface_mean);
  EXPECT_NEAR(surface.max(), r.surface_max, part * r.surface_max);
  EXPECT_NEAR(cluster.mean(), r.cluster_mean, r.cluster_error);
  EXPECT_NEAR(cluster.max(), r.cluster_max, part * r.cluster_max);
}

// disk 7, 19 and 48 against clusters: our own plain Monte Carlo of 200,000, 200,000 and 50,000 pairs, as 4000 pairs
// leave 1.5 %.
INSTANTIATE_TEST_SUITE_P(Builtin, ReferenceStatistics,
                         testing::Values(Reference{"sphere", 6, .153, .241, .173, .262, .192, .282, .173, .264, .0025},
                                         Reference{"cube", 8, .245, .432, .309, .499, .386, .530, .313, .512, .0055},
                                         Reference{"cube", 27, .349, .613, .374, .692, .449, .753, .383, .724, .007},
                                         Reference{"cube", 64, .405, .713, .420, .791, .482, .874, .430, .839, .0075},
                                         Reference{"disk", 7, .521, .9005, .636, .9005, .656, .9005, .6378, .9005,
                                                   .0020},
                                         Reference{"disk", 19, .500, .947, .614, .947, .659, .947, .6169, .947, .0020},
                                         Reference{"disk", 48, .482, .945, .591, .945, .622, .945, .5902, .945, .0040}),
                         testing::PrintToStringParamName());

TEST(Eccentricity, DoesNotDependOnSizeOrFrame) {
  const std::vector<Sphere> spheres{{Vector3d(0, 0, 0), 1}, {Vector3d(1, 0, 0), .8}, {Vector3d(0.2, 1, 0), .7}};
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Sphere> moved;
  for (const Sphere& s : spheres)
    moved.push_back({1e-3 * (turn * s.centre + Vector3d(5, 5, 5)), 1e-3 * s.radius});
  const ClusterShape a("a", spheres, measure_union(spheres).properties), b("b", moved, measure_union(moved).properties);
  EXPECT_NEAR(eccentricity_plane(a).mean(), eccentricity_plane(b).mean(), 1e-4);
  EXPECT_NEAR(eccentricity_plane(a).max(), eccentricity_plane(b).max(), 1e-4);
  EXPECT_NEAR(eccentricity_surface(a).mean(), eccentricity_surface(b).mean(), 1e-3);
}

} // namespace
