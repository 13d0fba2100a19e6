// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mass that contacts feel where two bodies, or a body and a wall, meet off centre, for many at a time; pure.
#pragma once

#include "contact/contact_law.h"

#include <cmath>

namespace eccentra::contact {

/// Impacts of bodies A and B along a normal, as structure of arrays; world frame, SI. One row for a pair of bodies
/// whose contacts have one normal, else one for each contact. No more than contacts in a block.
struct ImpactRows {
  static constexpr int capacity = ContactBlock::capacity; ///< contacts
  /// One quantity of all impacts, with room for a whole vector behind.
  using Row = double[capacity + contact_width];

  // In: what all contacts of a pair have in common.
  Row offset[3];                  ///< from A's centre to B's [m]
  Row ease_a, ease_b;             ///< 1/m of A and B, 0 for one that is held, in a common unit; not both 0
  Row inverse_a[6], inverse_b[6]; ///< of the inertia per unit mass: xx yy zz xy xz yz [1/m2]; 0 for spheres and walls
  // In.
  Row normal[3]; ///< unit
  Row arm[3];    ///< from A's centre to where the contacts act together [m]
  // Out.
  Row factor; ///< sqrt(m_c / m*), in (0, 1]

  /// Row `to` becomes row `from` of `other` but for its normal and arm.
  void copy_bodies(int to, const ImpactRows& other, int from) {
    for (int k = 0; k < 3; ++k)
      offset[k][to] = other.offset[k][from];
    ease_a[to] = other.ease_a[from];
    ease_b[to] = other.ease_b[from];
    for (int k = 0; k < 6; ++k) {
      inverse_a[k][to] = other.inverse_a[k][from];
      inverse_b[k][to] = other.inverse_b[k][from];
    }
  }
};

/// An impact off centre has to bring to rest only m_c, with 1/m_c = 1/m_A + 1/m_B + (r_A x n) . I_A^-1 (r_A x n) + the
/// same of B; dampers tuned to m* = m_A m_B / (m_A + m_B) take too much (rim against rim of two disks, m_c = 0.39 m*: e
/// = 0.9 becomes 0.84). Damping goes with the root of the mass. Rows 0..n-1, n a multiple of contact_width.
inline void impact_factors(ImpactRows& p, int n) {
  constexpr double tiny = 1e-300; // keeps 0/0 out of unused rows
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double nx = p.normal[0][m], ny = p.normal[1][m], nz = p.normal[2][m];
    const double ax = p.arm[0][m], ay = p.arm[1][m], az = p.arm[2][m];
    const double bx = ax - p.offset[0][m], by = ay - p.offset[1][m], bz = az - p.offset[2][m];
    // r x n, and what A turns by an impulse along n there; likewise B.
    double x = ay * nz - az * ny, y = az * nx - ax * nz, z = ax * ny - ay * nx;
    const double turn_a = p.inverse_a[0][m] * x * x + p.inverse_a[1][m] * y * y + p.inverse_a[2][m] * z * z +
                          2 * (p.inverse_a[3][m] * x * y + p.inverse_a[4][m] * x * z + p.inverse_a[5][m] * y * z);
    x = by * nz - bz * ny;
    y = bz * nx - bx * nz;
    z = bx * ny - by * nx;
    const double turn_b = p.inverse_b[0][m] * x * x + p.inverse_b[1][m] * y * y + p.inverse_b[2][m] * z * z +
                          2 * (p.inverse_b[3][m] * x * y + p.inverse_b[4][m] * x * z + p.inverse_b[5][m] * y * z);
    const double straight = p.ease_a[m] + p.ease_b[m];
    p.factor[m] = std::sqrt(straight / (straight + p.ease_a[m] * turn_a + p.ease_b[m] * turn_b + tiny));
  }
}

} // namespace eccentra::contact
