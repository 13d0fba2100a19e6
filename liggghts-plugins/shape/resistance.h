// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Resistance of a body in creeping flow: to translation, to rotation, and what a strain does to it.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/rounded_hull.h"
#include "shape/surface.h"

#include <Eigen/Core>

#include <array>

namespace eccentra::shape {

/// Creeping flow past a body that is held, body frame, about the centre of mass; d is the diameter of the sphere of
/// equal volume. In a flow u + w x r + E r: force F = 3 pi mu d K u, torque T = pi mu d^2 C u + pi mu d^3 (K_rot w +
/// S:E). A sphere has K = K_rot = 1 and nothing else.
struct Resistance {
  Eigen::Matrix3d translation = Eigen::Matrix3d::Identity(); ///< K, symmetric [-]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< K_rot, symmetric [-]
  Eigen::Matrix3d coupling = Eigen::Matrix3d::Zero();        ///< C [-]
  /// S by rate of strain, columns xx yy zz yz xz xy [-]; a column is the torque for E with that entry (and the one
  /// across the diagonal) 1.
  Eigen::Matrix<double, 3, 6> strain = Eigen::Matrix<double, 3, 6>::Zero();
  /// Centre of resistance from the centre of mass, in units of d: where the coupling is symmetric, so that a body
  /// without screw sense feels a force and no torque.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();

  /// Spin of a body that is free to turn, less w, by rate of strain (Jeffery 1922): K_rot^-1 S. For a body with three
  /// planes of symmetry entry (x, yz) is B_x = (a_y^2 - a_z^2)/(a_y^2 + a_z^2) of the spheroid that turns alike.
  Eigen::Matrix<double, 3, 6> spin_by_strain() const;
  /// B_x, B_y, B_z: see spin_by_strain().
  Eigen::Vector3d bretherton() const;
  /// Period of tumbling about a body axis in a shear at rate 1 in the plane normal to it: 4 pi/sqrt(1 - B^2).
  double jeffery_period(int axis) const;
};

/// Solves the boundary integral on the union's surface (less than a second). Moments of inertia that are equal make the
/// resistances equal, and mirror planes make what they forbid exactly 0. Within 0.5 %
/// (tests/shape/resistance_test.cpp).
Resistance resistance_of(const ClusterShape& shape);
Resistance resistance_of(const RoundedHull& body);
/// Of the solid inside a closed surface whose origin is the centre of mass and whose axes are the principal axes, with
/// these moments of inertia per unit mass (equal ones mean axes of equal resistance).
Resistance resistance_of(const Surface& surface, double volume, const Eigen::Vector3d& inertia_per_mass);

} // namespace eccentra::shape
