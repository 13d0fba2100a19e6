// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Built-in shapes against Table 1 of Akhshik, Behzad & Rajabi (2016) and high-precision reference geometry.
#include "shape/cluster_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace {
using namespace eccentra::shape;

constexpr double diameter = 6.35e-3;

struct Reference {
  const char* family;
  int count, touchable;
  double sphericity;             // Table 1
  double radius, largest_offset; // [mm], [R_eq]
  double bounding, inertia_x, inertia_z;
};
void PrintTo(const Reference& r, std::ostream* out) {
  *out << r.family << r.count;
}

class Builtin : public testing::TestWithParam<Reference> {
 protected:
  static ClusterShape make(const Reference& r) {
    std::size_t used = 0;
    return make_shape({"shape", r.family, std::to_string(r.count)}, 1, used, diameter);
  }
};

TEST_P(Builtin, HasTheVolumeAskedForAndTheSphericityOfTable1) {
  const ClusterShape s = make(GetParam());
  EXPECT_NEAR(s.volume(), M_PI / 6 * std::pow(diameter, 3), 1e-10 * s.volume());
  EXPECT_NEAR(s.sphericity(), GetParam().sphericity, 0.005);
  EXPECT_EQ(static_cast<int>(s.spheres().size()), GetParam().count);
  EXPECT_EQ(static_cast<int>(s.surface_spheres().size()), GetParam().touchable);
}

TEST_P(Builtin, HasTheReferenceGeometry) {
  const Reference& r = GetParam();
  const ClusterShape s = make(r);
  const double equivalent = s.equivalent_radius();
  double offset = 0;
  for (const Sphere& sphere : s.spheres())
    offset = std::max(offset, sphere.centre.norm());
  const double half_digit4 = 0.5e-4, half_digit3 = 0.5e-3; // the references' last printed digit
  EXPECT_NEAR(s.smallest_radius() * 1e3, r.radius, 1e-4 * r.radius);
  EXPECT_NEAR(offset / equivalent, r.largest_offset, 2 * half_digit4);
  EXPECT_NEAR(s.bounding_radius() / equivalent, r.bounding, 1.1 * half_digit3);
  const Eigen::Vector3d inertia = s.inertia_per_mass() / (0.4 * equivalent * equivalent);
  // The references' inertias come from sampling and are good to about 1e-3; the exact check is in union_geometry_test.
  EXPECT_NEAR(inertia.x(), r.inertia_x, 1e-3);
  EXPECT_NEAR(inertia.z(), r.inertia_z, 1e-3);
}

TEST_P(Builtin, IsExactlySymmetric) {
  const ClusterShape s = make(GetParam());
  EXPECT_EQ(s.inertia_per_mass().x(), s.inertia_per_mass().y());
  if (std::string(GetParam().family) != "disk") {
    EXPECT_EQ(s.inertia_per_mass().x(), s.inertia_per_mass().z());
  }
  for (const Sphere& a : s.spheres()) { // the mirror image of every centre is a centre, digit by digit
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d mirrored = a.centre;
      mirrored[k] = -mirrored[k];
      bool found = false;
      for (const Sphere& b : s.spheres())
        found = found || b.centre == mirrored;
      EXPECT_TRUE(found) << a.centre.transpose() << " along axis " << k;
    }
  }
}

TEST_P(Builtin, IsTheSameEveryTime) {
  const ClusterShape a = make(GetParam()), b = make(GetParam());
  EXPECT_EQ(a.volume(), b.volume());
  EXPECT_EQ(a.inertia_per_mass(), b.inertia_per_mass());
}

INSTANTIATE_TEST_SUITE_P(Table1, Builtin,
                         testing::Values(Reference{"sphere", 1, 1, 1.00, 3.175, 0, 1, 1, 1},
                                         Reference{"sphere", 6, 6, 0.98, 2.44478, .2957, 1.066, 1.008, 1.008},
                                         Reference{"cube", 8, 8, 0.91, 1.89107, .5296, 1.125, 1.034, 1.034},
                                         Reference{"cube", 27, 26, 0.87, 1.37487, .7525, 1.186, 1.049, 1.049},
                                         Reference{"cube", 64, 56, 0.85, 1.09877, .8740, 1.220, 1.057, 1.057},
                                         Reference{"disk", 7, 7, 0.68, 1.69381, .9005, 1.434, 1.190, 2.083},
                                         Reference{"disk", 19, 19, 0.75, 1.41688, .9470, 1.393, 1.172, 2.096},
                                         Reference{"disk", 48, 48, 0.79, 1.34345, .9454, 1.369, 1.165, 2.084}),
                         testing::PrintToStringParamName());

TEST(Builtin, OtherCubesFollowTheirLattice) {
  std::size_t used = 0;
  const ClusterShape s = make_shape({"cube", "125"}, 0, used, diameter);
  EXPECT_EQ(used, 2u);
  EXPECT_EQ(s.spheres().size(), 125u);
  EXPECT_EQ(s.surface_spheres().size(), 125u - 27u);
  EXPECT_GT(s.sphericity(), 0.806); // a perfect cube
  EXPECT_LT(s.sphericity(), 0.85);
}

} // namespace
