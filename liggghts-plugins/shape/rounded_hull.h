// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A rounded convex body: a convex core swept by a ball, in its body frame.
#pragma once

#include "shape/rounded_core.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace eccentra::shape {

/// An immutable body. As with ClusterShape the body frame has its origin at the centre of mass and its axes along the
/// principal axes.
class RoundedHull {
 public:
  /// A polyhedron, polygon, segment or point, or a flat cylinder.
  using Core = std::variant<ConvexCore, DiskCore>;

  /// Properties of a body in its body frame, for a body that is restored.
  struct Properties {
    /// [m3], [m2] and [m].
    double volume, surface, contact_radius;
    Eigen::Vector3d inertia_per_mass; ///< principal values [m2]
  };
  /// A body whose core is in the body frame already, with its properties: nothing is computed.
  RoundedHull(std::string name, const Core& core, double radius, const Properties& properties);
  /// Takes the core in any frame (a disk in its own) and transforms it into the body frame. `radius` of the ball [m].
  RoundedHull(std::string name, const Core& core, double radius);

  /// Its arguments as typed.
  const std::string& name() const { return name_; }
  /// In the body frame.
  const Core& core() const { return core_; }
  /// The core's vertices, faces and edges, or nothing for a disk; body frame.
  const ConvexCore* polyhedron() const { return std::get_if<ConvexCore>(&core_); }
  /// The flat cylinder, or nothing for a polyhedron.
  const DiskCore* disk() const { return std::get_if<DiskCore>(&core_); }
  double radius() const { return radius_; } ///< of the ball: of all corners and edges [m]
  /// Radius of this body in the contact law of Hertz [m]; the rounding radius unless it is set.
  double contact_radius() const { return contact_radius_; }
  /// `radius` > 0 [m].
  void set_contact_radius(double radius) { contact_radius_ = radius; }

  /// The core's vertices; of a disk, points on its rims, first those above. Each is the centre of a ball of `radius`
  /// that the body contains; on planes and in holes polyhedra touch only at these.
  std::vector<Eigen::Vector3d> points() const;

  double volume() const { return volume_; }   ///< [m3]
  double surface() const { return surface_; } ///< [m2]
  /// Centre of mass in the frame in which the core was given [m].
  const Eigen::Vector3d& given_centre() const { return given_centre_; }
  /// Principal moments of inertia per unit mass [m2], in the order of the body axes.
  const Eigen::Vector3d& inertia_per_mass() const { return inertia_per_mass_; }
  double equivalent_radius() const;                           ///< radius of the sphere of equal volume, eq (34) [m]
  double bounding_radius() const { return bounding_radius_; } ///< about the centre of mass [m]
  double sphericity() const;                                  ///< eq (5) [-]

  /// A point of the core that is farthest in `direction`; the surface of the body is `radius` farther.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
  /// Distance of a point from the core [m]; its distance from the body is `radius` less.
  CoreDistance distance_to_core(const Eigen::Vector3d& point) const;

  /// Area of the shadow along `direction` (any length > 0) [m2].
  double projected_area(const Eigen::Vector3d& direction) const;
  /// The mean of projected_area() over all directions [m2].
  double mean_projected_area() const { return surface_ / 4; }

 private:
  std::string name_;
  Core core_;
  double radius_, contact_radius_;
  double volume_, surface_;
  Eigen::Vector3d given_centre_, inertia_per_mass_;
  double bounding_radius_;
};

/// Number of points on each rim of a disk, at which friction acts and on which a disk lies.
constexpr int points_on_rim = 12;

/// The same core, all lengths times `scale`.
RoundedHull::Core scaled(const RoundedHull::Core& core, double scale);

} // namespace eccentra::shape
