// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/timestep_limit_formula.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace eccentra::contact {

double impact_overlap(double exponent, double kn, double at, double mass, double speed) {
  const double work = 0.5 * (exponent + 1) * mass * speed * speed; // F overlap there
  return std::pow(work * std::pow(at, exponent - 1) / kn, 1 / (exponent + 1));
}

void BodyStiffness::add(const ContactStiffness& contact, const Eigen::Vector3d& n, const Eigen::Vector3d& arm,
                        double coupling) {
  const Eigen::Matrix3d nn = n * n.transpose();
  const Eigen::Matrix3d tt = Eigen::Matrix3d::Identity() - nn;
  Eigen::Matrix<double, 3, 6> motion; // of the contact point
  motion << 1, 0, 0, 0, arm.z(), -arm.y(), 0, 1, 0, -arm.z(), 0, arm.x(), 0, 0, 1, arm.y(), -arm.x(), 0;
  stiffness_ += coupling * motion.transpose() * (contact.normal * nn + contact.tangential * tt) * motion;
  damping_ += coupling * motion.transpose() * (contact.normal_damping * nn + contact.tangential_damping * tt) * motion;
  ++contacts_;
}

double BodyStiffness::critical_step(double mass, const Eigen::Matrix3d& inertia) const {
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

} // namespace eccentra::contact
