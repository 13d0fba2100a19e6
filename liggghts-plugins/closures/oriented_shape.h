// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What forces of the real shape know of it: resistance, shadows and inertia along axes of its own.
#pragma once

#include "closures/pitching_laws.h"
#include "shape/resistance.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <functional>

namespace eccentra::closures {

/// All lengths in units of d, the diameter of the sphere of equal volume. Rows of matrices turn body into other axes.
struct OrientedShape {
  /// Axes of the drag: eigenvectors of K, as rows, body frame. The body axes for a body with three planes of symmetry.
  Eigen::Matrix3d drag_axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d drag = Eigen::Vector3d::Ones();      ///< K along them
  Eigen::Vector3d crosswise = Eigen::Vector3d::Ones(); ///< phi_perp along them: pi d^2/4 over the shadow
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of resistance, body frame
  bool off_centre = false;                             ///< the centre of resistance is not the centre of mass

  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();   ///< K_rot, body frame
  Eigen::Vector3d inertia = Eigen::Vector3d::Constant(0.1); ///< principal moments over m d^2, along the body axes
  /// y = modes q turns a spin in the body frame into modes that rotation and inertia share: dy/dt = -rate y pi mu d/m.
  /// modes_inverse turns them back.
  Eigen::Matrix3d modes = Eigen::Matrix3d::Identity(), modes_inverse = Eigen::Matrix3d::Identity();
  bool shared_modes = true;                                ///< the modes are the body axes, and `modes` the unit matrix
  Eigen::Vector3d rates = Eigen::Vector3d::Constant(10.0); ///< K_rot over inertia, by mode
  /// Spin by strain (shape::Resistance::spin_by_strain), columns xx yy zz yz xz xy, body frame.
  Eigen::Matrix<double, 3, 6> spin_by_strain = Eigen::Matrix<double, 3, 6>::Zero();

  /// Pitching about body axis k by slips along the axes k+1 and k+2: of the spheroids that turn alike in a strain.
  struct Pitching {
    double sign = 0.0;     ///< 1: axis k+1 is the longer one, -1: k+2 is, 0: they are alike and there is no torque
    double blade = 0.0;    ///< 0: axis k is as the shorter one (a rod), 1: as the longer one (a disk)
    PitchingLaw rod, disk; ///< of a prolate and of an oblate spheroid
    /// Coefficient C'(Re), between rod and disk by `blade`.
    double operator()(double re) const {
      return (blade < 1.0 ? (1.0 - blade) * rod(re) : 0.0) + (blade > 0.0 ? blade * disk(re) : 0.0);
    }
  };
  Pitching pitching[3]; ///< by the axis of the torque
};

/// Shadow of the body along a direction in the body frame, in units of d^2.
using Shadow = std::function<double(const Eigen::Vector3d&)>;

/// From a resistance, principal moments over m d^2 in the same body frame, and shadows.
OrientedShape oriented_shape(const shape::Resistance& resistance, const Eigen::Vector3d& inertia, const Shadow& shadow);

} // namespace eccentra::closures
