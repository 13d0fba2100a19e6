// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Classes of bodies of a few known ones.
#include "report/body_classes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace eccentra::report;

constexpr double kPi = 3.14159265358979323846;

double volume_of(double diameter) {
  return kPi / 6 * std::pow(diameter, 3);
}

void add(Snapshot& snapshot, double diameter, double bounding, int type, double z, double v) {
  snapshot.position.push_back({0, 0, z});
  snapshot.velocity.push_back({0, 0, v});
  snapshot.volume.push_back(volume_of(diameter));
  snapshot.radius.push_back(bounding);
  snapshot.type.push_back(type);
}

TEST(BodyClasses, ByTypeShapeAndSize) {
  Snapshot snapshot;
  add(snapshot, 4e-3, 2e-3, 1, 0.1, 0.2); // a sphere
  add(snapshot, 4e-3, 2e-3, 1, 0.3, -0.2);
  add(snapshot, 4e-3, 3e-3, 1, 0.5, 0.001); // a cluster of the same volume
  add(snapshot, 2e-3, 1e-3, 1, 0.7, 1);     // a smaller sphere
  add(snapshot, 4e-3, 2e-3, 2, 0.9, 0);     // of another material
  const auto classes = body_classes({snapshot, snapshot}, {0, 0, 1}, {0, 0, 1});
  ASSERT_EQ(classes.size(), 4U);
  const double all = 4 * volume_of(4e-3) + volume_of(2e-3);
  // In the order of type, slimness and size.
  EXPECT_NEAR(classes[0].diameter, 2e-3, 1e-9);
  EXPECT_DOUBLE_EQ(classes[0].count, 1);
  EXPECT_NEAR(classes[0].part, volume_of(2e-3) / all, 1e-12);
  EXPECT_NEAR(classes[0].along, 1, 1e-12);
  EXPECT_DOUBLE_EQ(classes[1].count, 2);
  EXPECT_NEAR(classes[1].height, 0.2, 1e-12);
  EXPECT_NEAR(classes[1].speed, 0.2, 1e-12);
  EXPECT_NEAR(classes[1].along, 0, 1e-12);
  EXPECT_DOUBLE_EQ(classes[1].slow, 0);
  EXPECT_NEAR(classes[2].slimness, 1.5, 1e-9);
  EXPECT_DOUBLE_EQ(classes[2].slow, 1);
  EXPECT_EQ(classes[3].type, 2);
}

TEST(BodyClasses, ManySizesAreRangesOfEqualRatio) {
  Snapshot snapshot;
  for (int k = 0; k <= 80; ++k)
    add(snapshot, 1e-3 * std::pow(16.0, k / 80.0), 0.5e-3 * std::pow(16.0, k / 80.0), 1, k < 40 ? 0 : 1, 0);
  const auto classes = body_classes({snapshot}, {0, 0, 1}, {0, 0, 1}, 4);
  ASSERT_EQ(classes.size(), 4U);
  double count = 0, part = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(classes[k].diameter, 1e-3 * std::pow(2.0, static_cast<double>(k)));
    EXPECT_LE(classes[k].diameter, 1e-3 * std::pow(2.0, static_cast<double>(k) + 1) * 1.003);
    count += classes[k].count;
    part += classes[k].part;
  }
  EXPECT_DOUBLE_EQ(count, 81);
  EXPECT_NEAR(part, 1, 1e-12);
  EXPECT_NEAR(classes[0].height, 0, 1e-12);
  EXPECT_NEAR(classes[3].height, 1, 1e-12);
}

TEST(BodyClasses, WithoutBodiesThereAreNone) {
  EXPECT_TRUE(body_classes({Snapshot{}}, {0, 0, 1}, {0, 0, 1}).empty());
  EXPECT_TRUE(body_classes({}, {0, 0, 1}, {0, 0, 1}).empty());
}

} // namespace
