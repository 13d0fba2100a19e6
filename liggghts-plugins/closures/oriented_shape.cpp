// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenframes of the resistance, modes of rotation, and the spheroids that turn alike.
#include "closures/oriented_shape.h"

#include "base/linear_algebra.h"
#include "closures/rheology.h"

#include <algorithm>
#include <cmath>

namespace eccentra::closures {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSameBlade = 1e-9;

bool is_diagonal(const Matrix3d& m) {
  return Matrix3d(m.diagonal().asDiagonal()) == m;
}

/// Semi-axes (with a product of 1) whose ratios squared are r_jk^2 = (1 + B_i)/(1 - B_i), in the mean of the three: an
/// ellipsoid has them exactly, another body nearly.
Vector3d axes_of_turning(const Vector3d& bretherton) {
  const auto log_ratio = [&](int i) {
    const double b = std::clamp(bretherton[i], -0.999, 0.999);
    return 0.5 * std::log((1.0 + b) / (1.0 - b)); // ln a_j - ln a_k, (i, j, k) cyclic
  };
  const double yz = log_ratio(0), zx = log_ratio(1), xy = log_ratio(2);
  return {std::exp((xy - zx) / 3.0), std::exp((yz - xy) / 3.0), std::exp((zx - yz) / 3.0)};
}

} // namespace

OrientedShape oriented_shape(const shape::Resistance& resistance, const Vector3d& inertia, const Shadow& shadow) {
  OrientedShape s;
  s.centre = resistance.centre;
  s.off_centre = s.centre.norm() > 0.0;
  s.rotation = resistance.rotation;
  s.inertia = inertia;
  s.spin_by_strain = resistance.spin_by_strain();

  if (is_diagonal(resistance.translation)) {
    s.drag = resistance.translation.diagonal();
  } else {
    const base::SymmetricModes modes = base::symmetric_modes(resistance.translation);
    s.drag = modes.values;
    s.drag_axes = modes.vectors.transpose();
    if (s.drag_axes.determinant() < 0.0)
      s.drag_axes.row(2) *= -1.0;
  }
  for (int k = 0; k < 3; ++k)
    s.crosswise[k] = 0.25 * kPi / shadow(s.drag_axes.row(k).transpose());
  // Axes that resist alike show the same shadow: that of their mean.
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    if (s.drag[a] == s.drag[b])
      s.crosswise[a] = s.crosswise[b] = 2.0 / (1.0 / s.crosswise[a] + 1.0 / s.crosswise[b]);
  }
  if (s.drag[0] == s.drag[1] && s.drag[1] == s.drag[2])
    s.crosswise.setConstant(3.0 / s.crosswise.cwiseInverse().sum());

  // inertia q' = -K_rot q pi mu d/m: with q = M^-1/2 V y both are diagonal.
  const Vector3d root = inertia.cwiseSqrt();
  if (is_diagonal(s.rotation)) {
    s.rates = s.rotation.diagonal().cwiseQuotient(inertia);
  } else {
    s.shared_modes = false;
    const Matrix3d scaled = root.cwiseInverse().asDiagonal() * s.rotation * root.cwiseInverse().asDiagonal();
    const base::SymmetricModes modes = base::symmetric_modes(scaled);
    s.rates = modes.values;
    s.modes = modes.vectors.transpose() * root.asDiagonal();
    s.modes_inverse = root.cwiseInverse().asDiagonal() * modes.vectors;
  }

  const Vector3d axes = axes_of_turning(resistance.bretherton());
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (resistance.bretherton()[k] == 0.0)
      continue;
    const double ratio = std::max(axes[i], axes[j]) / std::min(axes[i], axes[j]);
    OrientedShape::Pitching& p = s.pitching[k];
    p.sign = axes[i] > axes[j] ? 1.0 : -1.0;
    p.blade = std::clamp(std::log(axes[k] / std::min(axes[i], axes[j])) / std::log(ratio), 0.0, 1.0);
    // A body of revolution, whatever the last digit says.
    for (const double end : {0.0, 1.0})
      if (std::abs(p.blade - end) < kSameBlade)
        p.blade = end;
    p.rod = PitchingLaw(ratio);
    p.disk = PitchingLaw(1.0 / ratio);
  }
  return s;
}

} // namespace eccentra::closures
