// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the elements of four vectors at once, which is faster than four single sums.
#pragma once

#include <Eigen/Core>

namespace eccentra::contact {

/// Eight values that are computed together.
using EightLanes = Eigen::Array<double, 8, 1>;

/// The sums of a, b, c and d.
inline Eigen::Vector4d lane_sums(const EightLanes& a, const EightLanes& b, const EightLanes& c, const EightLanes& d) {
  typedef double Four __attribute__((vector_size(32)));
  // Vectors go by reference: passed by value, their width would be part of the calling convention of machines without
  // it.
  const auto halves = [](const EightLanes& v, Four& out) {
    const Eigen::Array4d sum = v.head<4>() + v.tail<4>();
    out = Four{sum[0], sum[1], sum[2], sum[3]};
  };
  // Sums of neighbouring elements of u and v: u0 + u1, v0 + v1, u2 + u3, v2 + v3.
  const auto pairs = [](const Four& u, const Four& v, Four& out) {
    out = __builtin_shufflevector(u, v, 0, 4, 2, 6) + __builtin_shufflevector(u, v, 1, 5, 3, 7);
  };
  Four u, v, ab, cd;
  halves(a, u);
  halves(b, v);
  pairs(u, v, ab);
  halves(c, u);
  halves(d, v);
  pairs(u, v, cd);
  const Four sums = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  return {sums[0], sums[1], sums[2], sums[3]};
}

/// The largest element.
inline double largest_lane(const EightLanes& v) {
  const Eigen::Array4d four = v.head<4>().max(v.tail<4>());
  const Eigen::Array2d two = four.head<2>().max(four.tail<2>());
  return std::max(two[0], two[1]);
}

} // namespace eccentra::contact
