// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes from STL files, and how well so many spheres do for the solid.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/vtk/inscribed_spheres.h"
#include "shape/vtk/solid.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Whose mass, centre and inertia a body made of a solid has.
enum class MassOf { solid, spheres };

/// The shape of these spheres, sized so that the volume of `mass_of` is that of a sphere of `diameter` [m] (<= 0: as it
/// is).
ClusterShape shape_of_solid(const Solid& solid, std::vector<Sphere> spheres, MassOf mass_of, double diameter);

/// Deviation of a union of spheres from its solid; parts of the solid's values, lengths in units of its R_eq.
struct FitQuality {
  int spheres;
  double volume;                      ///< missing part of the volume
  double inertia;                     ///< norm of the difference of the inertia tensors per mass, own centres
  double mean_distance, max_distance; ///< from the solid's surface to the spheres
  double mean_eccentricity;           ///< delta_e / R_eq on a plane: value of the spheres less that of the solid
  double max_eccentricity;
};

/// delta_e / R_eq of the solid itself on a plane (contact at its outermost vertex).
struct SolidEccentricity {
  double mean, max;
};
SolidEccentricity solid_eccentricity(const Solid& solid);

/// `own` is solid_eccentricity(solid), which is worth keeping for the next call.
FitQuality fit_quality(const Solid& solid, const SolidEccentricity& own, const std::vector<Sphere>& spheres,
                       MassOf mass_of);

/// Makes `stl NAME spheres N [scale S] [mass solid|union] [resolution M]` known to make_shape. Call once at start.
void install_stl_keywords();

} // namespace eccentra::shape
