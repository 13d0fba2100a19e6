// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mass that contacts feel where two bodies, or a body and a wall, meet off centre, for many at a time; pure.
#pragma once

#include "contact/contact_law.h"

#include <cmath>

namespace eccentra::contact {

/// Pairs of bodies A and B that meet, as structure of arrays of `length`; world frame, SI.
template <int length> struct ImpactTable {
  /// One quantity of all pairs.
  using Row = double[length];

  Row offset[3];                  ///< from A's centre to B's [m]
  Row ease_a, ease_b;             ///< 1/m of A and B, 0 for one that is held, in a common unit; not both 0
  Row inverse_a[6], inverse_b[6]; ///< of the inertia per unit mass: xx yy zz xy xz yz [1/m2]; 0 for spheres and walls

  /// Pair `to` becomes pair `from` of another table; with `offset_only` its other rows are left alone.
  template <int other> void copy(int to, const ImpactTable<other>& source, int from, bool offset_only) {
    for (int k = 0; k < 3; ++k)
      offset[k][to] = source.offset[k][from];
    if (offset_only)
      return;
    ease_a[to] = source.ease_a[from];
    ease_b[to] = source.ease_b[from];
    for (int k = 0; k < 6; ++k) {
      inverse_a[k][to] = source.inverse_a[k][from];
      inverse_b[k][to] = source.inverse_b[k][from];
    }
  }
};

/// The pairs of a block of contacts, with room for a whole vector behind.
struct ImpactRows : ImpactTable<ContactBlock::capacity + contact_width> {
  bool alike = false; ///< all pairs have the ease and the inertia of the first
};

/// A ratio of two numbers above 0, kept apart: a loop over contacts divides once.
struct Ratio {
  double over;  ///< numerator
  double under; ///< denominator
};

/// m_c / m*, in (0, 1], of an impact of pair `k` along a unit normal `n`, at the arm `a` / `weight` from A's centre
/// [m]. An impact off centre has to bring to rest only m_c, with 1/m_c = 1/m_A + 1/m_B + (r_A x n) . I_A^-1 (r_A x n) +
/// the same of B; dampers tuned to m* = m_A m_B / (m_A + m_B) take too much (rim against rim of two disks, m_c = 0.39
/// m*: e = 0.9 becomes 0.84). Damping goes with the root of the mass. `alike`: see ImpactRows.
template <bool alike, int length>
inline Ratio impact_mass(const ImpactTable<length>& p, int k, double nx, double ny, double nz, double ax, double ay,
                         double az, double weight) {
  constexpr double tiny = 1e-200; // 1 where nothing presses, and in unused rows
  const int row = alike ? 0 : k;
  const double bx = ax - weight * p.offset[0][k], by = ay - weight * p.offset[1][k], bz = az - weight * p.offset[2][k];
  // r x n, and what A turns by an impulse along n there; likewise B.
  double x = ay * nz - az * ny, y = az * nx - ax * nz, z = ax * ny - ay * nx;
  const double turn_a = p.inverse_a[0][row] * x * x + p.inverse_a[1][row] * y * y + p.inverse_a[2][row] * z * z +
                        2 * (p.inverse_a[3][row] * x * y + p.inverse_a[4][row] * x * z + p.inverse_a[5][row] * y * z);
  x = by * nz - bz * ny;
  y = bz * nx - bx * nz;
  z = bx * ny - by * nx;
  const double turn_b = p.inverse_b[0][row] * x * x + p.inverse_b[1][row] * y * y + p.inverse_b[2][row] * z * z +
                        2 * (p.inverse_b[3][row] * x * y + p.inverse_b[4][row] * x * z + p.inverse_b[5][row] * y * z);
  const double straight = (p.ease_a[row] + p.ease_b[row]) * weight * weight + tiny;
  return {straight, straight + p.ease_a[row] * turn_a + p.ease_b[row] * turn_b};
}

} // namespace eccentra::contact
