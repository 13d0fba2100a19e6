// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mass that the contacts of two bodies feel when they meet off centre; pure.
#pragma once

#include "cluster/surface_spheres.h"

#include <cmath>

namespace eccentra::cluster {

/// A body as an impact meets it.
struct BodyAtImpact {
  double mass;                   ///< [kg]
  bool held;                     ///< cannot move at all
  const SurfaceSpheres* surface; ///< for its inertia
  const double* rotation;        ///< body to world, row-major
};

/// How much more easily a body gives way to an impulse along n at this arm [m] because it turns: m (arm x n) . I^-1
/// (arm x n).
inline double turning(const BodyAtImpact& body, const double* arm, const double* n) {
  const double* inverse = body.surface->inverse_inertia;
  if (inverse[0] == 0 || body.held)
    return 0;
  const double x = arm[1] * n[2] - arm[2] * n[1], y = arm[2] * n[0] - arm[0] * n[2], z = arm[0] * n[1] - arm[1] * n[0];
  if (body.surface->equal_moments)
    return inverse[0] * (x * x + y * y + z * z);
  const double* r = body.rotation;
  const double u = r[0] * x + r[3] * y + r[6] * z, v = r[1] * x + r[4] * y + r[7] * z,
               w = r[2] * x + r[5] * y + r[8] * z;
  return inverse[0] * u * u + inverse[1] * v * v + inverse[2] * w * w;
}

/// Factor of the damping of a contact at this arm from A's centre, `offset` [m] from A's to B's. An impact has to bring
/// to rest only m_c, with 1/m_c = 1/m_A + 1/m_B + (r_A x n) . I_A^-1 (r_A x n) + the same of B; dampers tuned to m_A
/// m_B / (m_A + m_B) take too much (rim against rim of two disks, m_c = 0.39 of it: e = 0.9 becomes 0.84). Damping goes
/// with the root of the mass.
inline double off_centre_factor(const double* n, const double* arm, const double* offset, const BodyAtImpact& a,
                                const BodyAtImpact& b) {
  const double arm_b[3] = {arm[0] - offset[0], arm[1] - offset[1], arm[2] - offset[2]};
  // All masses over m_A m_B.
  const double of_a = a.held ? 0 : b.held ? 1 : b.mass, of_b = b.held ? 0 : a.held ? 1 : a.mass;
  const double straight = of_a + of_b;
  return std::sqrt(straight / (straight + of_a * turning(a, arm, n) + of_b * turning(b, arm_b, n)));
}

/// The same for all contacts first..last-1 of A and B in a block. They act as one at their mean arm and mean normal,
/// weighted by stiffness: two faces that meet squarely are hit in the centre though none of their contacts is. Where
/// normals disagree (a corner in a niche) the mean normal is shorter than 1, and the factor fades to 1 with its square.
/// Compare ImpactMass, the same for walls.
template <class Block>
inline double off_centre_factor(const Block& c, int first, int last, const double* offset, const BodyAtImpact& a,
                                const BodyAtImpact& b) {
  if (last - first == 1) {
    const double n[3] = {c.normal[0][first], c.normal[1][first], c.normal[2][first]};
    // To the sub-sphere's centre: the rest of the way to the contact is along n.
    const double arm[3] = {c.arm[0][first], c.arm[1][first], c.arm[2][first]};
    return off_centre_factor(n, arm, offset, a, b);
  }
  double stiffness = 0, normal[3] = {0, 0, 0}, arm[3] = {0, 0, 0};
  for (int m = first; m < last; ++m) {
    const double s = c.contact_radius[m], reach = c.radius_a[m] - 0.5 * c.overlap[m];
    stiffness += s;
    for (int k = 0; k < 3; ++k) {
      normal[k] += s * c.normal[k][m];
      arm[k] += s * (c.arm[k][m] - reach * c.normal[k][m]);
    }
  }
  const double mean = 1 / stiffness;
  const double agreement = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]) * mean * mean;
  constexpr double none = 1e-12;
  if (!(agreement > none))
    return 1;
  const double to_unit = mean / std::sqrt(agreement);
  for (int k = 0; k < 3; ++k) {
    normal[k] *= to_unit;
    arm[k] *= mean;
  }
  return 1 + (off_centre_factor(normal, arm, offset, a, b) - 1) * agreement;
}

} // namespace eccentra::cluster
