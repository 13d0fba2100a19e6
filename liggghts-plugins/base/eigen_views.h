// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS keeps vectors and matrices in plain arrays: the same numbers for Eigen.
#pragma once

#include <Eigen/Core>

namespace eccentra::base {

inline Eigen::Vector3d vector3(const double* v) {
  return {v[0], v[1], v[2]};
}

/// Rotations are kept row by row: world = R body.
inline Eigen::Matrix3d row_major(const double* m) {
  return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(m);
}

inline void add(double* sum, const Eigen::Vector3d& v) {
  for (int k = 0; k < 3; ++k)
    sum[k] += v[k];
}

} // namespace eccentra::base
