// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid cluster of spheres, in its body frame: what every part of the project means by "shape".
#pragma once

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace eccentra::shape {

class RoundedHull;

/// One sub-sphere. Body frame, metres.
struct Sphere {
  Eigen::Vector3d centre; ///< [m]
  double radius;          ///< [m]
};

/// Geometry of the union of a cluster's spheres (overlaps count once). Body frame, SI.
struct MassProperties {
  double volume;                    ///< [m3]
  double surface;                   ///< [m2]
  Eigen::Vector3d centre;           ///< centre of mass [m]
  Eigen::Matrix3d inertia_per_mass; ///< about the centre [m2]
};

/// An immutable shape: a union of spheres, or a rounded convex body, whose spheres then are the points of its core with
/// its radius. The body frame has its origin at the centre of mass and its axes along the principal axes, so
/// that the inertia is diagonal; a particle's orientation quaternion (w x y z) turns body into world.
class ClusterShape {
 public:
  /// Takes spheres in any frame and the mass properties in that same frame, and turns both into the body frame.
  ClusterShape(std::string name, std::vector<Sphere> spheres, const MassProperties& properties);

  /// A rounded body, which already has its body frame.
  explicit ClusterShape(const RoundedHull& hull);

  /// Its arguments as typed, or the name of its file.
  const std::string& name() const { return name_; }
  /// The rounded body, or null for a union of spheres.
  const RoundedHull* hull() const { return hull_.get(); }
  /// All sub-spheres, body frame.
  const std::vector<Sphere>& spheres() const { return spheres_; }
  /// Indices of the sub-spheres that another body can touch (C64: 56 of 64); contact needs only these.
  const std::vector<int>& surface_spheres() const { return surface_spheres_; }
  double volume() const { return volume_; }   ///< of the union [m3]
  double surface() const { return surface_; } ///< of the union [m2]
  /// Centre of mass in the frame in which the spheres were given (in the body frame it is the origin) [m].
  const Eigen::Vector3d& given_centre() const { return given_centre_; }
  /// Principal moments of inertia per unit mass [m2], in the order of the body axes.
  const Eigen::Vector3d& inertia_per_mass() const { return inertia_per_mass_; }
  double equivalent_radius() const;                           ///< radius of the sphere of equal volume, eq (34) [m]
  double bounding_radius() const { return bounding_radius_; } ///< about the centre of mass [m]
  double smallest_radius() const { return smallest_radius_; } ///< of the surface sub-spheres [m]
  double sphericity() const;                                  ///< eq (5) [-]

 private:
  std::string name_;
  std::vector<Sphere> spheres_;
  std::vector<int> surface_spheres_;
  double volume_;
  double surface_;
  Eigen::Vector3d given_centre_;
  Eigen::Vector3d inertia_per_mass_;
  double bounding_radius_;
  double smallest_radius_;
  std::shared_ptr<const RoundedHull> hull_;
};

/// Reads the arguments of a shape as users type them, from arguments[first] on: the name of a family
/// (shape_family.h) and its words. `used` becomes the number of arguments read. `diameter` [m] of the sphere of equal
/// volume; <= 0 keeps the size that a file states. Throws std::invalid_argument with one sentence that names the word,
/// its value and the remedy.
ClusterShape make_shape(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                        double diameter);

} // namespace eccentra::shape
