// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The largest stable step of a body in contact, from stiffness, mass, inertia and all its contacts at once; pure.
#pragma once

#include "contact/contact_stiffness.h"

#include <Eigen/Core>

namespace eccentra::contact {

/// Overlap that an impact reaches [m] without damping, where F ~ overlap^exponent and the secant stiffness is `kn`
/// [N/m] at the overlap `at` [m].
double impact_overlap(double exponent, double kn, double at, double mass, double speed);

/// Sums what a body's contacts resist: 6 x 6, translation and rotation of the body, the others held in place.
class BodyStiffness {
 public:
  /// Of velocity and angular velocity.
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// Adds a contact at `arm` from the centre of mass [m] with unit normal n. `coupling` is 2 where the partner moves,
  /// too: two bodies in antiphase see the contact twice (a bound of the assembly's highest frequency, after
  /// Gershgorin); 1 for a wall.
  void add(const ContactStiffness& contact, const Eigen::Vector3d& n, const Eigen::Vector3d& arm, double coupling);

  /// Number of contacts added.
  int contacts() const { return contacts_; }

  /// Largest stable step of the explicit scheme (damping from the half step before) [s]: 2/w (sqrt(1 + z^2) - z) with
  /// the highest frequency w and its damping ratio z. `inertia`: tensor about the centre of mass, world frame [kg m2].
  double critical_step(double mass, const Eigen::Matrix3d& inertia) const;

 private:
  Matrix6 stiffness_ = Matrix6::Zero();
  Matrix6 damping_ = Matrix6::Zero();
  int contacts_ = 0;
};

} // namespace eccentra::contact
