// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes from STL files, and the deviation of the spheres from the solid.
#pragma once

#include "base/option_reader.h"
#include "shape/cluster_shape.h"
#include "shape/vtk/inscribed_spheres.h"
#include "shape/vtk/solid.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Source of mass, centre and inertia of a body that is made of a solid.
enum class MassOf { solid, spheres };

/// Whether spheres stay inside the solid, or all grow until their union has the volume of the solid.
enum class Cover { inside, balanced };

/// The arguments of `stl NAME ...`.
struct StlRequest {
  std::string path;                 ///< of the STL file
  InscribedOptions options;         ///< spheres, error and resolution
  double scale = 1;                 ///< factor of all lengths
  bool scale_given = false;         ///< the user has stated the unit
  MassOf mass_of = MassOf::spheres; ///< what mass, centre and inertia are those of
  Cover cover = Cover::inside;      ///< where the spheres lie
  double max_missing = 0.5;         ///< part of the volume that spheres inside may lack
};
/// Reads the words behind `stl`, and no others. Throws std::invalid_argument.
StlRequest read_stl_request(base::OptionReader& words);

/// The spheres of a request. Throws std::invalid_argument if they lack more of the volume of the solid than
/// `max_missing` and `error` allow, or if they do not lie in the solid.
std::vector<Sphere> cover_of(const Solid& solid, const StlRequest& request);

/// The shape of these spheres, sized so that the volume of `mass_of` is that of a sphere of `diameter` [m] (<= 0: the
/// size of the file). Adds the notes of the solid, how much of the volume the spheres hold, and whether lengths may be
/// millimetres.
ClusterShape shape_of_solid(const Solid& solid, std::vector<Sphere> spheres, const StlRequest& request, double diameter,
                            Notes& notes);

/// Deviation of a union of spheres from its solid; parts of the solid's values, lengths in units of its R_eq.
struct FitQuality {
  int spheres;                        ///< number of spheres
  double volume;                      ///< missing part of the volume
  double protrusion;                  ///< largest length by which a sphere stands out of the solid
  double inertia;                     ///< norm of the difference of the inertia tensors per mass, own centres
  double mean_distance, max_distance; ///< from the solid's surface to the spheres
  double mean_eccentricity;           ///< delta_e / R_eq on a plane: value of the spheres less that of the solid
  double max_eccentricity;            ///< the same of the largest value
};

/// delta_e / R_eq of the solid itself on a plane (contact at its outermost vertex).
struct SolidEccentricity {
  double mean, max; ///< over all directions
};
/// Mean and largest over evenly spread directions.
SolidEccentricity solid_eccentricity(const Solid& solid);

/// `own` is solid_eccentricity(solid), which the caller keeps for several calls.
FitQuality fit_quality(const Solid& solid, const SolidEccentricity& own, const std::vector<Sphere>& spheres,
                       MassOf mass_of);

/// Adds the family `stl`, which needs VTK, to the table of families. Call once at start.
void install_stl_keywords();

} // namespace eccentra::shape
