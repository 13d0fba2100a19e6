// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The law of rounded bodies beside the rule that codes for spheropolyhedra publish (Rockable; exaDEM): a spring for
// each pair of features whose closest points lie inside of both.
#include "contact/manifold_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace {
using namespace eccentra::contact;
using namespace eccentra::test;

/// Distance of point `p` from the part of a box at which `free` axes are between the faces and the others at them.
/// Nothing where the foot of p is not inside of that part, or where p is under a face.
std::optional<double> distance_from_part(const Vector3d& half, const Vector3d& p, const std::array<bool, 3>& free) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double out = std::abs(p[k]) - half[k];
    if (free[k] && out > 0)
      return {};
    if (!free[k])
      square += out * out;
  }
  return std::sqrt(square);
}

/// Springs of a point over a box by that rule, in units of the force of one spring at the depth `depth`: on the nearest
/// face, the edges around it and their corners, each by itself.
double springs_by_parts(const Vector3d& half, const Vector3d& p, double reach, double depth) {
  Vector3d force = Vector3d::Zero();
  for (int kept = 0; kept < 4; ++kept) { // the face whose axis is z, its edges and corners
    const std::array<bool, 3> free = {(kept & 1) != 0, (kept & 2) != 0, false};
    const std::optional<double> distance = distance_from_part(half, p, free);
    if (!distance || *distance >= reach)
      continue;
    Vector3d from = p;
    for (int k = 0; k < 3; ++k)
      from[k] = free[k] ? 0 : p[k] - std::copysign(half[k], p[k]);
    force += std::pow((reach - *distance) / depth, 1.5) * from.normalized();
  }
  return force.norm();
}

/// A cube whose corner points down slides over the upper face of another and out over an edge.
class CornerOverEdge : public testing::Test {
 protected:
  CornerOverEdge() : cube(made("smooth cube rounding .15")) {
    const Vector3d diagonal = Vector3d(-1, -1, -1).normalized(), low = -Vector3d::UnitZ();
    down.pose(cube, AngleAxisd(std::acos(diagonal.dot(low)), diagonal.cross(low).normalized()).toRotationMatrix());
    flat.pose(cube, Matrix3d::Identity());
  }

  double reach() const { return 2 * cube.radius; }
  double depth() const { return 0.05 * cube.radius; }
  /// Of the corner of the core, from the centre of the lower cube; `out`: beyond the edge.
  Vector3d corner(double out) const {
    return {cube.half.x() + out, 0.1 * cube.half.y(), cube.half.z() + reach() - depth()};
  }

  /// Force in units of one spring at the depth, by our law.
  double ours(double out) const {
    const Vector3d centre = corner(out) + cube.half.norm() * Vector3d::UnitZ();
    const Load load = load_of(find({down, flat, -centre}, 0.1 * reach()).contacts);
    return load.force.norm() / std::pow(depth(), 1.5);
  }
  double by_parts(double out) const { return springs_by_parts(cube.half, corner(out), reach(), depth()); }

  ContactCore cube;
  PosedCore down, flat;
};

TEST_F(CornerOverEdge, ByPartsTheSpringsOfAFaceAndAnEdgeAddAndOneGoes) {
  const double a_little = 1e-9 * cube.radius;
  EXPECT_NEAR(by_parts(-0.5 * cube.half.x()), 1, 1e-12); // in the middle of the face
  EXPECT_NEAR(by_parts(-a_little), 2, 1e-6);             // over its margin, as far as the edge is in reach
  EXPECT_NEAR(by_parts(a_little), 1, 1e-6);              // and outside
}

TEST_F(CornerOverEdge, OursIsOneSpringWithoutAJump) {
  const double margin =
      std::sqrt(reach() * reach() - std::pow(reach() - depth(), 2)); // where the edge comes into reach
  double before = ours(-2 * margin), largest = 0;
  EXPECT_NEAR(before, 1, 1e-12);
  constexpr int kSteps = 4000;
  for (int k = 1; k <= kSteps; ++k) {
    const double out = 3 * margin * k / kSteps - 2 * margin, force = ours(out);
    largest = std::max(largest, std::abs(force - before));
    before = force;
    if (out <= 0) {
      EXPECT_NEAR(force, 1, 1e-12) << out;
    }
  }
  EXPECT_NEAR(before, 0, 1e-3); // out of touch
  // Beyond the edge it falls from 1 to 0 over the margin, with a slope of at most some 3 / margin.
  EXPECT_LT(largest, 4. * 3 / kSteps);
}

} // namespace
