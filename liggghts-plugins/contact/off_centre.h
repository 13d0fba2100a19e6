// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mass that the contacts of two bodies feel when they meet off centre, for many pairs of bodies at a time; pure.
#pragma once

#include "contact/contact_law.h"

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

/// Pairs of bodies A and B that touch, as structure of arrays; world frame. No more pairs than contacts in a block.
struct PairBlock {
  using Row = double[ContactBlock::capacity + contact_width];

  // In: what all contacts of a pair have in common.
  Row offset[3];                  ///< from A's centre to B's [m]
  Row ease_a, ease_b;             ///< 1/m of A and B, 0 for one that is held, in a common unit; not both 0
  Row inverse_a[6], inverse_b[6]; ///< of the inertia per unit mass: xx yy zz xy xz yz [1/m2]; 0 for spheres
  // In: sums over the pair's contacts, weighted by their stiffness (any unit).
  Row stiffness, normal[3], arm[3]; ///< arm: from A's centre to the contact point [m]
  // Out.
  Row factor;              ///< of the contacts' damping, in (0, 1]
  Row force[3], torque[3]; ///< on A, torque about its centre of mass [N, N m]
};

/// Weighs contacts 0..n-1 of a block for the sums of their pairs, in the rows that contact_forces writes later ...
template <class Block> inline void start_off_centre_sums(Block& c, int n) {
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double s = c.contact_radius[m], reach = c.radius_a[m] - 0.5 * c.overlap[m];
    const double nx = c.normal[0][m], ny = c.normal[1][m], nz = c.normal[2][m];
    c.force[0][m] = s * nx;
    c.force[1][m] = s * ny;
    c.force[2][m] = s * nz;
    c.torque[0][m] = s * (c.arm[0][m] - reach * nx);
    c.torque[1][m] = s * (c.arm[1][m] - reach * ny);
    c.torque[2][m] = s * (c.arm[2][m] - reach * nz);
  }
}

/// ... and sums them up over the contacts of each of `pairs` pairs; `pair_of` tells the pair of contacts 0..n-1. One
/// loop over all contacts: with one over the contacts of each pair the processor would guess each one's end.
template <class Block>
inline void add_off_centre_sums(const Block& c, const int* pair_of, int n, PairBlock& p, int pairs) {
  for (int m = 0; m < pairs; ++m) {
    p.stiffness[m] = 0;
    for (int k = 0; k < 3; ++k)
      p.normal[k][m] = p.arm[k][m] = 0;
  }
  for (int m = 0; m < n; ++m) {
    const int pair = pair_of[m];
    p.stiffness[pair] += c.contact_radius[m];
    for (int k = 0; k < 3; ++k) {
      p.normal[k][pair] += c.force[k][m];
      p.arm[k][pair] += c.torque[k][m];
    }
  }
}

/// Sums up forces and torques over the contacts of each pair, likewise.
template <class Block>
inline void add_contact_forces(const Block& c, const int* pair_of, int n, PairBlock& p, int pairs) {
  for (int k = 0; k < 3; ++k) {
    std::fill(p.force[k], p.force[k] + pairs, 0.);
    std::fill(p.torque[k], p.torque[k] + pairs, 0.);
  }
  for (int m = 0; m < n; ++m) {
    const int pair = pair_of[m];
    for (int k = 0; k < 3; ++k) {
      p.force[k][pair] += c.force[k][m];
      p.torque[k][pair] += c.torque[k][m];
    }
  }
}

/// An impact off centre has to bring to rest only m_c, with 1/m_c = 1/m_A + 1/m_B + (r_A x n) . I_A^-1 (r_A x n) + the
/// same of B; dampers tuned to m_A m_B / (m_A + m_B) take too much (rim against rim of two disks, m_c = 0.39 of it: e =
/// 0.9 becomes 0.84). Damping goes with the root of the mass. The contacts of a pair act as one at their mean arm and
/// mean normal: two faces that meet squarely are hit in the centre though none of their contacts is. Where normals
/// disagree (a corner in a niche) the mean normal is shorter than 1, and the factor fades to 1 with its square. Compare
/// ImpactMass, the same for walls. Pairs 0..n-1, n a multiple of contact_width.
inline void off_centre_factors(PairBlock& p, int n) {
  constexpr double none = 1e-12, tiny = 1e-100; // keep 0/0 out
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double mean = 1 / (p.stiffness[m] + tiny);
    double nx = p.normal[0][m] * mean, ny = p.normal[1][m] * mean, nz = p.normal[2][m] * mean;
    const double agreement = nx * nx + ny * ny + nz * nz;
    const double to_unit = 1 / std::sqrt(std::max(agreement, none));
    nx *= to_unit;
    ny *= to_unit;
    nz *= to_unit;
    const double ax = p.arm[0][m] * mean, ay = p.arm[1][m] * mean, az = p.arm[2][m] * mean;
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
    const double root = std::sqrt(straight / (straight + p.ease_a[m] * turn_a + p.ease_b[m] * turn_b));
    p.factor[m] = agreement > none ? 1 + (root - 1) * agreement : 1;
  }
}

} // namespace eccentra::contact
