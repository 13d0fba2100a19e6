// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry and motion of analytic walls: planes and circular cylinders, without LIGGGHTS types.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace eccentra::contact {

/// Position of a point relative to a wall. World frame, metres.
struct WallPoint {
  double distance;        ///< from the point to the wall, >= 0
  Eigen::Vector3d normal; ///< unit vector from the wall to the point
};

/// A plane or a circular cylinder that may turn about its axis and slide along itself. The position of its
/// centre decides whether a particle is outside or inside (above or below): a cylinder is a pipe for particles outside
/// and a hole for particles inside.
class WallSurface {
 public:
  /// A plane through `point`; `normal` of any length > 0.
  static WallSurface plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    return {Kind::plane, point, normal.normalized(), 0.0};
  }
  /// A cylinder of `radius` [m] whose axis runs through `point` along `axis` (any length > 0).
  static WallSurface cylinder(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double radius) {
    return {Kind::cylinder, point, axis.normalized(), radius};
  }

  /// False for a cylinder.
  bool is_plane() const { return kind_ == Kind::plane; }
  /// A point of the plane, or of the cylinder's axis. Torques on the wall are taken about it.
  const Eigen::Vector3d& reference() const { return reference_; }
  /// Unit normal of the plane, or unit vector along the cylinder's axis.
  const Eigen::Vector3d& direction() const { return direction_; }
  /// Two unit vectors that span, with direction(), a right-handed frame.
  const Eigen::Vector3d& across() const { return across_; }
  /// The second of them.
  const Eigen::Vector3d& across2() const { return across2_; }
  /// Of the cylinder [m].
  double radius() const { return radius_; }

  /// Angular velocity about the axis through reference() [rad/s], right-handed along direction().
  void set_rotation(double omega) { omega_ = omega * direction_; }
  /// Velocity of the wall's material [m/s]; its component normal to the wall must be zero, as the wall stays where it
  /// is.
  void set_velocity(const Eigen::Vector3d& velocity) { velocity_ = velocity; }
  /// Of the wall's material [rad/s], world frame.
  const Eigen::Vector3d& angular_velocity() const { return omega_; }

  /// Velocity of the wall's material at point x of the wall.
  Eigen::Vector3d velocity_at(const Eigen::Vector3d& x) const { return velocity_ + omega_.cross(x - reference_); }

  /// Distance [m] without the normal.
  double distance(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d from_reference = x - reference_;
    const double along = from_reference.dot(direction_);
    if (kind_ == Kind::plane)
      return std::abs(along);
    return std::abs((from_reference - along * direction_).norm() - radius_);
  }

  /// A point on the plane itself counts as above it. On the axis of a cylinder no normal exists: the distance is the
  /// radius and the normal is arbitrary. A particle smaller than the hole does not touch there.
  WallPoint nearest(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d from_reference = x - reference_;
    const double along = from_reference.dot(direction_);
    if (kind_ == Kind::plane)
      return {std::abs(along), along < 0.0 ? Eigen::Vector3d(-direction_) : direction_};
    const Eigen::Vector3d radial = from_reference - along * direction_;
    const double r = radial.norm();
    const Eigen::Vector3d outward = r > 0.0 ? Eigen::Vector3d(radial / r) : across_;
    if (r > radius_)
      return {r - radius_, outward};
    return {radius_ - r, -outward};
  }

 private:
  enum class Kind { plane, cylinder };
  WallSurface(Kind kind, const Eigen::Vector3d& reference, const Eigen::Vector3d& direction, double radius)
      : kind_(kind), reference_(reference), direction_(direction), across_(direction.unitOrthogonal()),
        across2_(direction.cross(across_)), radius_(radius) {}

  Kind kind_;
  Eigen::Vector3d reference_;
  Eigen::Vector3d direction_;
  Eigen::Vector3d across_;
  Eigen::Vector3d across2_;
  double radius_;
  Eigen::Vector3d omega_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
};

} // namespace eccentra::contact
