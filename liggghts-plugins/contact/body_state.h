// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies as contacts see them; pure.
#pragma once

namespace eccentra::contact {

struct SurfaceSpheres;

/// Four numbers that the compiler keeps in one register (or two), on any machine.
typedef float Float4 __attribute__((vector_size(16)));
typedef double Double4 __attribute__((vector_size(32)));

/// A vector of three numbers; the fourth lane is 0.
inline Double4 load3(const double* vector) {
  return Double4{vector[0], vector[1], vector[2], 0};
}

/// a x b; the fourth lane is 0 where those of both are finite.
inline Double4 cross(Double4 a, Double4 b) {
  const Double4 next_a = __builtin_shufflevector(a, a, 1, 2, 0, 3), last_a = __builtin_shufflevector(a, a, 2, 0, 1, 3);
  const Double4 next_b = __builtin_shufflevector(b, b, 1, 2, 0, 3), last_b = __builtin_shufflevector(b, b, 2, 0, 1, 3);
  return next_a * last_b - last_a * next_b;
}

/// What a contact asks of a body, together: arrays of positions, velocities, masses ... of which each contact needs one
/// row cost a cache line each. The orientation is all zero for a round body, whose own nobody sees. Fourth lanes are 0.
struct alignas(64) BodyState {
  double x[3];                             ///< centre of mass [m]
  double mass;                             ///< [kg]
  double v[3];                             ///< [m/s]
  int type;                                ///< atom type
  bool held;                               ///< cannot move at all
  double omega[3];                         ///< [rad/s]
  const SurfaceSpheres* surface = nullptr; ///< its shape; where it stands it keeps the columns aligned
  Double4 column[3] = {};                  ///< of the rotation body to world
  double inverse_inertia[6] = {}; ///< of the inertia tensor per unit mass, world frame: xx yy zz xy xz yz [1/m2]
  double extra_radius = 0;        ///< added to the radii of the shape's spheres (plain spheres) [m]
  int tag = 0;                    ///< of the atom

  /// rotation: row-major, body to world.
  void turn(const double* rotation) {
    for (int k = 0; k < 3; ++k)
      column[k] = Double4{rotation[k], rotation[3 + k], rotation[6 + k], 0.};
  }

  /// inverse_principal: 1 over the principal moments of inertia per unit mass, not all the same; after turn().
  void turn_inertia(const double* inverse_principal) {
    const Double4 x_axis = column[0] * inverse_principal[0], y_axis = column[1] * inverse_principal[1],
                  z_axis = column[2] * inverse_principal[2];
    constexpr int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) {
      const int i = first[k], j = second[k];
      inverse_inertia[k] = x_axis[i] * column[0][j] + y_axis[i] * column[1][j] + z_axis[i] * column[2][j];
    }
  }
};

static_assert(sizeof(BodyState) == 256, "four cache lines");

/// Forces on a body that contacts add up; fourth lanes are 0.
struct alignas(64) BodyForce {
  Double4 force = {};  ///< [N]
  Double4 torque = {}; ///< about the centre of mass [N m]
};

} // namespace eccentra::contact
