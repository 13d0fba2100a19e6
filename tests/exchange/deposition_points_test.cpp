// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a particle have its volume, its centre and its second moments.
#include "exchange/depositionPoints.H"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

using namespace eccentra::exchange;

constexpr double kVolume = 4.0 / 3.0 * M_PI * 0.003 * 0.003 * 0.003;

void expectMoments(const std::vector<DepositionPoint>& points, const double (&second)[3][3]) {
  double whole = 0, first[3] = {}, moment[3][3] = {};
  for (const DepositionPoint& point : points) {
    whole += point.weight;
    for (int i = 0; i < 3; ++i) {
      first[i] += point.weight * point.offset[i];
      for (int j = 0; j < 3; ++j)
        moment[i][j] += point.weight * point.offset[i] * point.offset[j];
    }
  }
  EXPECT_NEAR(whole, 1.0, 1e-15);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(first[i], 0.0, 1e-18);
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(moment[i][j], second[i][j], 1e-20);
  }
}

} // namespace

TEST(DepositionPoints, DividedSphereHasTheMomentsOfABall) {
  std::vector<DepositionPoint> points;
  depositionPoints(VoidFraction::divided, kVolume, nullptr, 0, points);
  const double ball = 0.003 * 0.003 / 5.0;
  expectMoments(points, {{ball, 0, 0}, {0, ball, 0}, {0, 0, ball}});
}

TEST(DepositionPoints, ClusterHasTheMomentsOfItsExtentWithEveryPointwiseMethod) {
  // A rod along (1,1,0): semi-vector e_k contributes e_k e_k^T / 3.
  const double extent[9] = {0.004, 0.004, 0, 0.001, -0.001, 0, 0, 0, 0.0005};
  const double xx = (1.6e-5 + 1e-6) / 3, xy = (1.6e-5 - 1e-6) / 3, zz = 2.5e-7 / 3;
  for (const VoidFraction method : {VoidFraction::centre, VoidFraction::divided, VoidFraction::diffusion}) {
    std::vector<DepositionPoint> points;
    depositionPoints(method, kVolume, extent, 0, points);
    expectMoments(points, {{xx, xy, 0}, {xy, xx, 0}, {0, 0, zz}});
  }
}

TEST(DepositionPoints, GaussianKernelHasItsVarianceAndFourthMoment) {
  std::vector<DepositionPoint> points;
  const double width = 0.006, variance = width * width;
  depositionPoints(VoidFraction::gaussian, kVolume, nullptr, width, points);
  expectMoments(points, {{variance, 0, 0}, {0, variance, 0}, {0, 0, variance}});
  double fourth = 0;
  for (const DepositionPoint& point : points)
    fourth += point.weight * std::pow(point.offset[0], 4);
  EXPECT_NEAR(fourth, 3 * variance * variance, 1e-24);
}

TEST(DepositionPoints, UnknownMethodIsNamedWithTheRemedy) {
  try {
    voidFractionOf("center");
    FAIL();
  } catch (const std::invalid_argument& problem) {
    EXPECT_STREQ(problem.what(), "voidFraction 'center' is unknown: use centre, divided, gaussian or diffusion");
  }
}
