// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation of several bodies at a time whose moments of inertia are equal about all axes; pure.
#pragma once

#include "contact/rigid_rotation.h"

#include <cmath>

namespace eccentra::contact {

/// The rotation of one body is a chain of dependent operations, so that several bodies at once take little longer than
/// one. Structure of arrays with whole vectors, so that rounding does not depend on the place of a body. Unused places
/// contain any finite values.
struct alignas(64) TurningBlock {
  static constexpr int width = 8; ///< bodies of a block
  /// One quantity of all bodies.
  using Row = double[width];

  Row angle[3] = {};    ///< in: rotation vector in world [rad], short enough for turns_in_block()
  Row quaternion[4];    ///< in and out: w x y z, body to world
  Row matrix[9];        ///< out: the same rotation, row-major
  int body[width] = {}; ///< index of the body at each place
  int count = 0;        ///< places in use

  TurningBlock() {
    for (int k = 0; k < 4; ++k)
      for (double& q : quaternion[k])
        q = k == 0;
  }
};

/// True if the series of sinc_cos() is exact to round-off, as in any reasonable time step.
inline bool turns_in_block(const double* angle) {
  constexpr double longest = 0.04; // four times the limit of the square of half the angle
  return angle[0] * angle[0] + angle[1] * angle[1] + angle[2] * angle[2] < longest;
}

/// rotate_in_world(), normalise() and rotation_matrix() for all places.
inline void turn_all(TurningBlock& b) {
#pragma GCC ivdep
  for (int m = 0; m < TurningBlock::width; ++m) {
    const double hx = b.angle[0][m] / 2, hy = b.angle[1][m] / 2, hz = b.angle[2][m] / 2;
    const double h2 = hx * hx + hy * hy + hz * hz;
    constexpr double s3 = -1. / 6, s5 = 1. / 120, s7 = -1. / 5040, s9 = 1. / 362880;
    constexpr double c2 = -1. / 2, c4 = 1. / 24, c6 = -1. / 720, c8 = 1. / 40320;
    const double sinc = 1 + h2 * (s3 + h2 * (s5 + h2 * (s7 + h2 * s9)));
    const double p = 1 + h2 * (c2 + h2 * (c4 + h2 * (c6 + h2 * c8)));
    const double x = sinc * hx, y = sinc * hy, z = sinc * hz;
    const double a = b.quaternion[0][m], i = b.quaternion[1][m], j = b.quaternion[2][m], k = b.quaternion[3][m];
    const double qw = p * a - x * i - y * j - z * k, qx = p * i + x * a + y * k - z * j;
    const double qy = p * j - x * k + y * a + z * i, qz = p * k + x * j - y * i + z * a;
    const double square = qw * qw + qx * qx + qy * qy + qz * qz;
    // Within a time step only round-off is removed, for which one Newton step is exact to the last digit.
    constexpr double newton_limit = 1e-8; // the error is 3/8 of its square
    const double newton = 1.5 - 0.5 * square, exact = 1 / std::sqrt(square);
    const double scale = std::fabs(square - 1) < newton_limit ? newton : exact;
    const double w = qw * scale, u = qx * scale, v = qy * scale, t = qz * scale;
    b.quaternion[0][m] = w;
    b.quaternion[1][m] = u;
    b.quaternion[2][m] = v;
    b.quaternion[3][m] = t;
    b.matrix[0][m] = 1 - 2 * (v * v + t * t);
    b.matrix[1][m] = 2 * (u * v - w * t);
    b.matrix[2][m] = 2 * (u * t + w * v);
    b.matrix[3][m] = 2 * (u * v + w * t);
    b.matrix[4][m] = 1 - 2 * (u * u + t * t);
    b.matrix[5][m] = 2 * (v * t - w * u);
    b.matrix[6][m] = 2 * (u * t - w * v);
    b.matrix[7][m] = 2 * (v * t + w * u);
    b.matrix[8][m] = 1 - 2 * (u * u + v * v);
  }
}

} // namespace eccentra::contact
