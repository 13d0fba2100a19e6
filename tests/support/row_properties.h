// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Mass and moments of a row of equal spheres.
#pragma once

#include "shape/cluster_shape.h"

#include <cmath>

namespace eccentra::test {

/// `count` spheres of `radius` along `axis` (0 to 2), `spacing` from centre to centre [m], about the middle.
inline shape::MassProperties row_properties(int count, double radius, double spacing, int axis) {
  double spread = 0; // mean square distance along the row
  for (int k = 0; k < count; ++k)
    spread += std::pow((k - 0.5 * (count - 1)) * spacing, 2) / count;
  const double own = 0.4 * radius * radius;
  Eigen::Vector3d moments = Eigen::Vector3d::Constant(own + spread);
  moments[axis] = own;
  shape::MassProperties properties;
  properties.volume = count * 4. / 3 * M_PI * std::pow(radius, 3);
  properties.surface = count * 4 * M_PI * radius * radius;
  properties.centre.setZero();
  properties.inertia_per_mass = moments.asDiagonal();
  return properties;
}

} // namespace eccentra::test
