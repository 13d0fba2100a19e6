// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation of rigid bodies: quaternions (w x y z, body to world), angular velocity, and an exact-rotation free step.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace eccentra::contact {

/// Row-major matrix that turns body into world, from the unit quaternion q.
inline void rotation_matrix(const double* q, double* r) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  r[0] = 1 - 2 * (y * y + z * z);
  r[1] = 2 * (x * y - w * z);
  r[2] = 2 * (x * z + w * y);
  r[3] = 2 * (x * y + w * z);
  r[4] = 1 - 2 * (x * x + z * z);
  r[5] = 2 * (y * z - w * x);
  r[6] = 2 * (x * z - w * y);
  r[7] = 2 * (y * z + w * x);
  r[8] = 1 - 2 * (x * x + y * y);
}

/// World = R body.
inline void to_world(const double* r, const double* body, double* world) {
  for (int k = 0; k < 3; ++k)
    world[k] = r[3 * k] * body[0] + r[3 * k + 1] * body[1] + r[3 * k + 2] * body[2];
}

/// Body = R^T world.
inline void to_body(const double* r, const double* world, double* body) {
  for (int k = 0; k < 3; ++k)
    body[k] = r[k] * world[0] + r[3 + k] * world[1] + r[6 + k] * world[2];
}

/// Angular velocity [rad/s] of a body with principal moments `inertia` [kg m2], from its angular momentum; both in
/// world.
inline void angular_velocity(const double* r, const double* inertia, const double* momentum, double* omega) {
  double body[3];
  to_body(r, momentum, body);
  for (int k = 0; k < 3; ++k)
    body[k] /= inertia[k];
  to_world(r, body, omega);
}

/// Angular momentum [kg m2/s] from angular velocity; both in world.
inline void angular_momentum(const double* r, const double* inertia, const double* omega, double* momentum) {
  double body[3];
  to_body(r, omega, body);
  for (int k = 0; k < 3; ++k)
    body[k] *= inertia[k];
  to_world(r, body, momentum);
}

/// sin(h)/h and cos(h) for the square of h: a series, exact to round-off for the small angles of a time step.
inline void sinc_cos(double h2, double& sinc, double& cosine) {
  constexpr double series_limit = 0.01; // the first term left out is below 1e-17 there
  if (h2 < series_limit) {
    // Products, as a chain of divisions would take most of the time of a step.
    constexpr double s3 = -1. / 6, s5 = 1. / 120, s7 = -1. / 5040, s9 = 1. / 362880;
    constexpr double c2 = -1. / 2, c4 = 1. / 24, c6 = -1. / 720, c8 = 1. / 40320;
    sinc = 1 + h2 * (s3 + h2 * (s5 + h2 * (s7 + h2 * s9)));
    cosine = 1 + h2 * (c2 + h2 * (c4 + h2 * (c6 + h2 * c8)));
  } else {
    const double h = std::sqrt(h2);
    sinc = std::sin(h) / h;
    cosine = std::cos(h);
  }
}

/// q = p q for a rotation by the vector `angle` [rad] in world.
inline void rotate_in_world(double* q, const double* angle) {
  double sinc, c;
  const double hx = angle[0] / 2, hy = angle[1] / 2, hz = angle[2] / 2;
  sinc_cos(hx * hx + hy * hy + hz * hz, sinc, c);
  const double x = sinc * hx, y = sinc * hy, z = sinc * hz;
  const double a = q[0], b = q[1], d = q[2], e = q[3];
  q[0] = c * a - x * b - y * d - z * e;
  q[1] = c * b + x * a + y * e - z * d;
  q[2] = c * d - x * e + y * a + z * b;
  q[3] = c * e + x * d - y * b + z * a;
}

/// q = q p for a rotation by `angle` [rad] about body axis `axis`.
inline void rotate_about_body_axis(double* q, int axis, double angle) {
  double sinc, c;
  sinc_cos(angle * angle / 4, sinc, c);
  const double s = sinc * angle / 2;
  const int i = axis + 1, j = (axis + 1) % 3 + 1, k = (axis + 2) % 3 + 1;
  const double w = q[0], a = q[i], b = q[j], d = q[k];
  q[0] = c * w - s * a;
  q[i] = c * a + s * w;
  q[j] = c * b + s * d;
  q[k] = c * d - s * b;
}

/// Component of a world vector along body axis `axis` of the orientation q.
inline double along_body_axis(const double* q, int axis, const double* world) {
  const double w = q[0], x = q[axis + 1], y = q[(axis + 1) % 3 + 1], z = q[(axis + 2) % 3 + 1];
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  return (1 - 2 * (y * y + z * z)) * world[axis] + 2 * (x * y + w * z) * world[j] + 2 * (x * z - w * y) * world[k];
}

/// Gives a quaternion (not 0) length 1.
inline void normalise(double* q) {
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  // Within a time step only round-off has to go: there one step of Newton's is exact to the last digit.
  constexpr double newton_limit = 1e-8; // the error is 3/8 of its square
  const double scale = std::abs(square - 1) < newton_limit ? 1.5 - 0.5 * square : 1 / std::sqrt(square);
  for (int k = 0; k < 4; ++k)
    q[k] *= scale;
}

/// How a torque-free body with given principal moments turns. The kinetic energy of rotation is
/// L^2/(2 I_mid) + (1/2) sum over the two other axes k of (1/I_k - 1/I_mid) l_k^2; each term alone turns the body about
/// a fixed direction, so a symmetric product of these exact rotations keeps the angular momentum in world exactly and
/// the energy to second order without drift (a symplectic splitting; compare Dullweber, Leimkuhler & McLachlan 1997, J.
/// Chem. Phys. 107, 5840). For bodies with two equal moments it is the exact motion.
class FreeRotation {
 public:
  FreeRotation() = default;
  /// Principal moments per unit mass [m2].
  explicit FreeRotation(const Eigen::Vector3d& inertia_per_mass) {
    int order[3] = {0, 1, 2};
    const auto& moment = inertia_per_mass;
    for (int a = 0; a < 3; ++a)
      for (int b = a + 1; b < 3; ++b)
        if (moment[order[b]] < moment[order[a]])
          std::swap(order[a], order[b]);
    const int mid = order[1];
    // Moments that agree to this relative difference are those of a symmetric body.
    constexpr double symmetry_tolerance = 1e-9;
    world_rate_ = 1 / moment[mid];
    const double difference[2] = {1 / moment[order[0]] - world_rate_, 1 / moment[order[2]] - world_rate_};
    axis_[0] = order[0];
    axis_[1] = order[2];
    for (int k = 0; k < 2; ++k)
      rate_[k] = std::abs(difference[k]) > symmetry_tolerance * world_rate_ ? difference[k] : 0;
  }

  /// True if all moments of inertia are alike: no torque couples the axes.
  bool spherical() const { return rate_[0] == 0 && rate_[1] == 0; }
  /// 1 / (moment of inertia per unit mass) that all axes of a spherical body share [1/m2].
  double world_rate() const { return world_rate_; }

  /// Turns q by the time dt [s]; `momentum` is the angular momentum per unit mass in world [m2/s].
  void step(double* q, const double* momentum, double dt) const {
    if (rate_[0] != 0 && rate_[1] != 0) {
      turn(q, 0, momentum, dt / 2);
      turn(q, 1, momentum, dt);
      turn(q, 0, momentum, dt / 2);
    } else if (rate_[0] != 0) {
      turn(q, 0, momentum, dt);
    } else if (rate_[1] != 0) {
      turn(q, 1, momentum, dt);
    }
    const double angle[3] = {momentum[0] * world_rate_ * dt, momentum[1] * world_rate_ * dt,
                             momentum[2] * world_rate_ * dt};
    rotate_in_world(q, angle);
    normalise(q);
  }

 private:
  void turn(double* q, int k, const double* momentum, double dt) const {
    rotate_about_body_axis(q, axis_[k], rate_[k] * along_body_axis(q, axis_[k], momentum) * dt);
  }

  int axis_[2] = {0, 2};
  double rate_[2] = {0, 0};
  double world_rate_ = 1;
};

} // namespace eccentra::contact
