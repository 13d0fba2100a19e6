// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Principal axes in the order and with the signs that turn the given frame least.
#include "shape/principal_frame.h"

#include "base/linear_algebra.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace eccentra::shape {
namespace {

/// Part of the largest moment within which moments are equal.
constexpr double equal_moments = 1e-6;
/// Centres of mass closer to the origin than this part of the size are at the origin.
constexpr double negligible_offset = 1e-12;

} // namespace

Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& inertia) {
  const double scale = inertia.diagonal().cwiseAbs().maxCoeff();
  const Eigen::Vector3d off(inertia(0, 1), inertia(0, 2), inertia(1, 2));
  if (off.cwiseAbs().maxCoeff() < equal_moments * scale)
    return Eigen::Matrix3d::Identity();
  const auto [moment, vectors] = base::symmetric_modes(inertia);
  const bool low_equal = moment[1] - moment[0] < equal_moments * scale;
  const bool high_equal = moment[2] - moment[1] < equal_moments * scale;
  Eigen::Matrix3d axes;
  if (low_equal || high_equal) {
    // One axis of symmetry; the other two are free: take them near the given ones.
    Eigen::Vector3d unique = vectors.col(low_equal ? 2 : 0);
    int k = 0;
    unique.cwiseAbs().maxCoeff(&k);
    if (unique[k] < 0)
      unique = -unique;
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const Eigen::Vector3d side = Eigen::Vector3d::Unit(next) - unique[next] * unique;
    axes.row(k) = unique;
    axes.row(next) = side.normalized();
    axes.row(last) = unique.cross(side.normalized());
    return axes;
  }
  // Three axes: the order and the signs that turn the given frame least.
  std::array<int, 3> order{0, 1, 2}, best = order;
  double closest = -1;
  do {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += std::abs(vectors(k, order[k]));
    if (sum > closest + equal_moments) {
      closest = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  for (int k = 0; k < 3; ++k)
    axes.row(k) = vectors.col(best[k]).transpose() * (vectors(k, best[k]) < 0 ? -1 : 1);
  if (axes.determinant() < 0)
    axes.row(2) *= -1;
  return axes;
}

Eigen::Vector3d merge_equal_moments(Eigen::Vector3d moment) {
  const double tolerance = equal_moments * moment.maxCoeff();
  if (moment.maxCoeff() - moment.minCoeff() < tolerance)
    return Eigen::Vector3d::Constant(moment.mean());
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    if (std::abs(moment[a] - moment[b]) < tolerance) {
      moment[a] = moment[b] = (moment[a] + moment[b]) / 2;
      break;
    }
  }
  return moment;
}

Eigen::Vector3d without_round_off(Eigen::Vector3d centre, double size) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(centre[k]) < negligible_offset * size)
      centre[k] = 0;
  return centre;
}

} // namespace eccentra::shape
