// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mass that a contact feels: what an off-centre impact has to bring to rest is less than the body; pure.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace eccentra::contact {

/// A frictionless impact at arm r from the centre of mass, with normal n, sees the mass m_c = 1 / (1/m + (r x n) . I^-1
/// (r x n)). Dampers tuned to m instead of m_c take too much: at a rim sphere of a disk tilted by 30 degrees (m_c =
/// 0.41 m) e = 0.9 becomes 0.85. So `contacts shared` multiplies the damping by sqrt(m_c / m). Several contacts at once
/// act as one at their mean arm, weighted by stiffness and by how far their normals agree: a body that lands on a face
/// is hit in the centre though none of its contacts is. Make one per body and wall (or body and body), add all
/// contacts, then ask.
class ImpactMass {
 public:
  /// Adds a contact: stiffness S [any unit, the same for all], unit normal, arm from the centre of mass [m].
  void add(double stiffness, const Eigen::Vector3d& n, const Eigen::Vector3d& arm) {
    Eigen::Matrix<double, 6, 1> nn;
    nn << n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), n.x() * n.y(), n.x() * n.z(), n.y() * n.z();
    arms_ += stiffness * arm * nn.transpose();
    stiffness_ += stiffness * nn;
  }

  /// m_c / m, in (0, 1], along normal n of one of the contacts that were added. `inverse_inertia`: of the inertia per
  /// unit mass about the centre of mass, world frame [1/m2].
  double ratio(const Eigen::Vector3d& n, const Eigen::Matrix3d& inverse_inertia) const {
    Eigen::Matrix<double, 6, 1> weights;
    weights << n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), 2 * n.x() * n.y(), 2 * n.x() * n.z(), 2 * n.y() * n.z();
    const Eigen::Vector3d arm = arms_ * weights / stiffness_.dot(weights);
    const Eigen::Vector3d turn = arm.cross(n);
    return 1 / (1 + turn.dot(inverse_inertia * turn));
  }

 private:
  Eigen::Matrix<double, 3, 6> arms_ = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Matrix<double, 6, 1> stiffness_ = Eigen::Matrix<double, 6, 1>::Zero();
};

} // namespace eccentra::contact
