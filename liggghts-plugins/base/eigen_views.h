// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Views of the plain arrays of LIGGGHTS as vectors and matrices of Eigen.
#pragma once

#include <Eigen/Core>

namespace eccentra::base {

/// A copy of three numbers.
inline Eigen::Vector3d vector3(const double* v) {
  return {v[0], v[1], v[2]};
}

/// A rotation matrix from nine numbers in row-major order: world = R body.
inline Eigen::Matrix3d row_major(const double* m) {
  return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(m);
}

/// Adds v to the three numbers at `sum`.
inline void add(double* sum, const Eigen::Vector3d& v) {
  for (int k = 0; k < 3; ++k)
    sum[k] += v[k];
}

} // namespace eccentra::base
