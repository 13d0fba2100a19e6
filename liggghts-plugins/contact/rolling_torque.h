// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rolling resistance of one contact as pure functions: coefficient, lever arm, and the three forms of the torque.
// Conventions: n is the unit normal from the partner (or wall) to the particle; spins are relative, particle minus
// partner [rad/s], world frame; torques act on the particle [N m], the partner gets the opposite.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

/// Eq (33): the coefficient that carries shape, mu_r + delta_e / R_eq. Both are >= 0 and without unit.
inline double effective_coefficient(double mu_r, double mu_shape) {
  return mu_r + mu_shape;
}

/// Lever arm [m] of eq (19), |r_c| = R_eq of a sphere. Each partner's own radius would give two torques, action =
/// reaction allows one: the smaller radius is that of both for equal spheres, and that of the sphere at a wall. (Stock
/// cdt uses R_i R_j / (R_i + R_j): half of this for equal spheres, the same at a wall.)
inline double lever_arm(double radius_i, double radius_j) {
  return std::min(radius_i, radius_j);
}

/// Largest torque [N m] that the contact can resist with, mu |r_c| |F_n|; F_n is the elastic force of eq (12).
inline double torque_cap(double coefficient, double lever, double normal_force) {
  return coefficient * lever * std::abs(normal_force);
}

/// The part of a spin (or torque) that rolls: torsion about the contact normal removed.
inline Eigen::Vector3d rolling_part(const Eigen::Vector3d& vector, const Eigen::Vector3d& n) {
  return vector - vector.dot(n) * n;
}

/// Scaled down to length `cap` if it is longer.
inline Eigen::Vector3d bounded(const Eigen::Vector3d& torque, double cap) {
  const double squared = torque.squaredNorm();
  return squared > cap * cap ? Eigen::Vector3d(torque * (cap / std::sqrt(squared))) : torque;
}

/// Eq (19) as printed: against the spin, of constant length; zero without spin.
inline Eigen::Vector3d directional_torque(const Eigen::Vector3d& spin, double cap) {
  const double squared = spin.squaredNorm();
  return squared > 0.0 ? Eigen::Vector3d(spin * (-cap / std::sqrt(squared))) : Eigen::Vector3d::Zero();
}

/// Elastic-plastic spring-dashpot, type C of Ai et al. (2011), with the sum of spring and dashpot bounded by the cap: a
/// fast start would otherwise meet a dashpot that resists many times more than the cap.
struct SpringDashpot {
  Eigen::Vector3d spring; ///< torque of the spring, what the contact remembers
  Eigen::Vector3d total;  ///< torque of both; the dashpot is off once the spring is fully mobilised
};

/// Rolling stiffness [N m]: k_r = 2.25 k_n (mu R)^2, k_n [N/m] the secant stiffness F_n / delta.
/// Explicit integration needs dt < 2 sqrt(I / k_r).
inline double rolling_stiffness(double kn, double coefficient, double lever) {
  constexpr double ai_factor = 2.25;
  const double reach = coefficient * lever;
  return ai_factor * kn * reach * reach;
}

/// One step of the spring-dashpot. `remembered`: spring torque after the last step; `inertia`: reduced moment of
/// inertia about the contact point [kg m2]; `damping_ratio`: fraction of critical damping.
inline SpringDashpot spring_dashpot(const Eigen::Vector3d& remembered, const Eigen::Vector3d& spin, double stiffness,
                                    double cap, double inertia, double damping_ratio, double dt) {
  const Eigen::Vector3d trial = remembered - stiffness * dt * spin;
  const double squared = trial.squaredNorm();
  if (squared > cap * cap) {
    const Eigen::Vector3d mobilised = trial * (cap / std::sqrt(squared));
    return {mobilised, mobilised};
  }
  const double dashpot = 2.0 * damping_ratio * std::sqrt(inertia * stiffness);
  return {trial, bounded(trial - dashpot * spin, cap)};
}

} // namespace eccentra::contact
