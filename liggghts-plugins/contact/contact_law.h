// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts as springs, dashpots and friction, many at a time; pure, no LIGGGHTS. What a contact model adds are
// stiffness and damping (contact_models.h).
#pragma once

#include "contact/body_state.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace eccentra::contact {

/// Contacts between sub-spheres of bodies A and B, as structure of arrays; world frame, SI. Everything is seen from A:
/// B's torque about its own centre of mass, at `offset` from A's, is offset x force - torque.
template <class RowType> struct ContactRows {
  /// One quantity of all contacts.
  using Row = RowType;
  static constexpr int kMaterials = 3;

  // In: geometry and state.
  Row separation[3];        ///< from the centre of B's sub-sphere to that of A's [m]
  Row arm[3];               ///< from A's centre of mass to its sub-sphere's centre [m]
  Row radius_a, radius_b;   ///< of the sub-spheres [m]
  Row velocity[3];          ///< of A's centre of mass, minus that of B's matter, were it there [m/s]
  Row spin[3];              ///< angular velocity of A minus that of B [rad/s]
  Row mass;                 ///< effective mass of the two bodies [kg]
  Row material[kMaterials]; ///< properties of the pair of materials, as the contact model orders them
  Row friction;             ///< Coulomb coefficient
  // In and out: tangential displacement [m].
  Row history[3]; ///< world frame
  // Between the passes (or in), and out.
  Row normal[3];        ///< unit, from B to A
  Row overlap;          ///< [m]
  Row contact_radius;   ///< sqrt(R* overlap) [m]
  Row curvature;        ///< how the normal turns where A moves past B: 1 / distance of the centres [1/m]; 0 at a plane
  Row kn, kt;           ///< secant stiffness, normal and tangential [N/m]
  Row gamma_n, gamma_t; ///< damping [N s/m]
  Row share;            ///< of the damping, with `contacts shared`: shared_contacts.h writes these
  Row stiffness_sum, force_sum, work_sum; ///< over contacts that share
  Row force[3];                           ///< on A [N]; B gets the opposite
  Row torque[3];                          ///< on A about its centre of mass [N m]
};

/// Vector loops run over whole multiples of this, so that rounding does not depend on a contact's place in its block.
constexpr int contact_width = 8;

/// The next multiple of contact_width.
constexpr int whole_vectors(int count) {
  return (count + contact_width - 1) / contact_width * contact_width;
}

/// Rows are short, so that all of them stay in the first-level cache and on few pages, and an odd number of cache lines
/// long: strides near powers of two alias.
struct alignas(64) ContactBlock : ContactRows<double[72]> {
  /// What is left over takes whole vectors from any place on.
  static constexpr int capacity = 64;
};

/// Room for a pair of bodies with more contacts than that, however many.
class LargeContactBlock : public ContactRows<double*> {
 public:
  /// Makes room for `count` contacts; what was in the block is lost.
  void reserve(int count) {
    constexpr int rows = sizeof(ContactRows<double*>) / sizeof(double*);
    const std::size_t length = (count / contact_width + 2) * contact_width;
    if (values_.size() >= rows * length)
      return;
    values_.assign(rows * length, 0.);
    auto* row = reinterpret_cast<double**>(static_cast<ContactRows<double*>*>(this));
    for (int k = 0; k < rows; ++k)
      row[k] = values_.data() + k * length;
  }

 private:
  std::vector<double> values_;
};

/// Normal, overlap and contact radius of contacts 0..n-1. Overlaps must be >= 0.
template <class Block> inline void contact_geometry(Block& c, int n) {
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double x = c.separation[0][m], y = c.separation[1][m], z = c.separation[2][m];
    const double distance = std::sqrt(x * x + y * y + z * z);
    const double inverse = 1 / distance;
    const double sum = c.radius_a[m] + c.radius_b[m];
    const double overlap = sum - distance;
    c.normal[0][m] = x * inverse;
    c.normal[1][m] = y * inverse;
    c.normal[2][m] = z * inverse;
    c.overlap[m] = overlap;
    c.contact_radius[m] = std::sqrt(c.radius_a[m] * c.radius_b[m] / sum * overlap);
    c.curvature[m] = inverse;
  }
}

/// What ContactRows::velocity and spin are in the middle of the step, in axes that turn with B to its end. `va`, `vb`:
/// velocities of the centres; `wb`: spin of B; `half`: half a step [s].
inline void to_middle_of_step(Double4& velocity, Double4& spin, Double4 va, Double4 vb, Double4 wb, double half) {
  // B's matter at A's centre, half a step back: the centres were elsewhere.
  velocity += cross(wb, half * (va - vb));
  velocity += half * cross(wb, velocity);
  spin += half * cross(wb, spin);
}

/// How Coulomb's law bounds the tangential force. Under all of them the spring holds at most the bound.
enum class FrictionBound {
  elastic, ///< mu times the elastic normal force, for spring and damper together: a sliding impact takes mu (1 + e) m v
  stock,   ///< mu |F_n| with its damping, for the spring; the damper acts while the contact sticks
  paper    ///< mu times the elastic normal force, for the spring; the damper always acts
};

/// The choices of a law of contacts beside its model.
struct ForceChoice {
  FrictionBound bound = FrictionBound::elastic; ///< of the tangential force
  /// Velocities are those of the middle of the step, half a step before the positions; true: the displacement of the
  /// step is that of the contact point there. Else it is what these velocities give at the contact point of the end,
  /// which in a corner creeps by O(dt) (Vyas et al. 2025).
  bool synchronised = true;
  bool cylinder = false; ///< B is one, the rows `separation` are its axis (unit), along which the normal does not turn
};

/// Forces and torques of contacts 0..n-1 from kn, kt, gamma_n, gamma_t: normal kn d - gamma_n v_n, tangential kt on the
/// displacement and gamma_t, bounded by friction. `advance` moves the history by dt; without it the history is only
/// read. n: a multiple of contact_width.
void contact_forces(ContactBlock& c, int n, double dt, bool advance, const ForceChoice& choice);
void contact_forces(LargeContactBlock& c, int n, double dt, bool advance, const ForceChoice& choice);

} // namespace eccentra::contact
