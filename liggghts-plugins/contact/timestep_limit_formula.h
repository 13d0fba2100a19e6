// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The largest stable step of a body in contact, from stiffness, mass, inertia and all its contacts at once; pure.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace eccentra::contact {

/// Linear stiffness and damping of one contact.
struct ContactStiffness {
  double normal;             ///< d Fn / d overlap [N/m]
  double tangential;         ///< [N/m]
  double normal_damping;     ///< [kg/s]
  double tangential_damping; ///< [kg/s]
};

/// Of contact m of a block whose stiffness and damping a model with this exponent has filled in.
template <class Block> ContactStiffness stiffness_of(const Block& c, int m, double exponent) {
  return {exponent * c.kn[m], c.kt[m], c.gamma_n[m], c.gamma_t[m]};
}

/// Overlap that an impact reaches [m] without damping, where F ~ overlap^exponent and the secant stiffness is `kn`
/// [N/m] at the overlap `at` [m].
inline double impact_overlap(double exponent, double kn, double at, double mass, double speed) {
  const double work = 0.5 * (exponent + 1) * mass * speed * speed; // F overlap there
  return std::pow(work * std::pow(at, exponent - 1) / kn, 1 / (exponent + 1));
}

/// Sums what a body's contacts resist: 6 x 6, translation and rotation of the body, the others held in place.
class BodyStiffness {
 public:
  /// Of velocity and angular velocity.
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// Adds a contact at `arm` from the centre of mass [m] with unit normal n. `coupling` is 2 where the partner moves,
  /// too: two bodies in antiphase see the contact twice (a bound of the assembly's highest frequency, after
  /// Gershgorin); 1 for a wall.
  void add(const ContactStiffness& contact, const Eigen::Vector3d& n, const Eigen::Vector3d& arm, double coupling) {
    const Eigen::Matrix3d nn = n * n.transpose();
    const Eigen::Matrix3d tt = Eigen::Matrix3d::Identity() - nn;
    Eigen::Matrix<double, 3, 6> motion; // of the contact point
    motion << 1, 0, 0, 0, arm.z(), -arm.y(), 0, 1, 0, -arm.z(), 0, arm.x(), 0, 0, 1, arm.y(), -arm.x(), 0;
    stiffness_ += coupling * motion.transpose() * (contact.normal * nn + contact.tangential * tt) * motion;
    damping_ +=
        coupling * motion.transpose() * (contact.normal_damping * nn + contact.tangential_damping * tt) * motion;
    ++contacts_;
  }

  /// Number of contacts added.
  int contacts() const { return contacts_; }

  /// Largest stable step of the explicit scheme (damping from the half step before) [s]: 2/w (sqrt(1 + z^2) - z) with
  /// the highest frequency w and its damping ratio z. `inertia`: tensor about the centre of mass, world frame [kg m2].
  double critical_step(double mass, const Eigen::Matrix3d& inertia) const {
    if (contacts_ == 0)
      return std::numeric_limits<double>::infinity();
    Matrix6 inverse_root = Matrix6::Zero(); // of the mass matrix
    inverse_root.topLeftCorner<3, 3>().diagonal().setConstant(1 / std::sqrt(mass));
    inverse_root.bottomRightCorner<3, 3>() =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).operatorInverseSqrt();
    const Eigen::SelfAdjointEigenSolver<Matrix6> modes(inverse_root * stiffness_ * inverse_root);
    const double w = std::sqrt(modes.eigenvalues()[5]);
    const Eigen::Matrix<double, 6, 1> mode = inverse_root * modes.eigenvectors().col(5);
    const double z = mode.dot(damping_ * mode) / (2 * w);
    return 2 / w * (std::sqrt(1 + z * z) - z);
  }

 private:
  Matrix6 stiffness_ = Matrix6::Zero();
  Matrix6 damping_ = Matrix6::Zero();
  int contacts_ = 0;
};

} // namespace eccentra::contact
