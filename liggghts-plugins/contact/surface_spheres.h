// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The sub-spheres of a shape that another body can touch, laid out for vector loops.
#pragma once

#include "contact/body_state.h"
#include "contact/contact_core.h"
#include "shape/cluster_shape.h"

#include <vector>

namespace eccentra::contact {

/// Structure of arrays, body frame [m]; index k is what contacts call a sub-sphere. The single-precision copies are
/// padded to whole vectors with spheres that touch nothing; they only preselect, forces use the double values.
struct SurfaceSpheres {
  /// A plain sphere: one sub-sphere of radius 0 at the centre, to which the atom's own radius is added.
  SurfaceSpheres();
  /// The surface sub-spheres of a cluster, or the points of a rounded body.
  explicit SurfaceSpheres(const shape::ClusterShape& shape);

  static constexpr int padding = 16;      ///< the longest vector of single-precision values
  int count;                              ///< sub-spheres
  int padded;                             ///< length of the single-precision arrays
  std::vector<double> x, y, z, r;         ///< centres and radii
  std::vector<Double4> sphere;            ///< the same again, x y z r together
  std::vector<float> xf, yf, zf, rf;      ///< the same, padded
  double bounding_radius;                 ///< about the centre of mass
  double smallest_radius, largest_radius; ///< of the sub-spheres
  /// Of the body: 1 over its principal moments of inertia per unit mass [1/m2]; 0 for spheres, whose contacts never
  /// turn them by their normal force.
  double inverse_inertia[3] = {0, 0, 0};
  bool equal_moments = true; ///< a body whose normal forces turn it alike about all axes
  /// The same body for the contacts of rounded ones; `hull`: it is one itself.
  contact::ContactCore core;
  bool hull = false;     ///< a rounded body
  bool single_at_centre; ///< one sphere at the centre of mass: its orientation cannot matter

 private:
  void finish();
};

/// Radius with which a contact of this body enters Hertz's law [m], where its own radius is `radius`.
inline double hertz_radius(const SurfaceSpheres& surface, double extra, double radius) {
  return surface.hull ? surface.core.contact_radius + extra : radius;
}

} // namespace eccentra::contact
