// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fills a solid with overlapping spheres that touch its surface from within.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/vtk/solid.h"

#include <vector>

namespace eccentra::shape {

/// How many spheres a solid receives, and how finely they are sought.
struct InscribedOptions {
  int spheres = 0;         ///< stop at this number; 0: `volume_error` alone decides
  double volume_error = 0; ///< stop when the union lacks at most this part of the solid's volume; 0: not used
  int resolution = 0;      ///< grid points along the longest side; 0: chosen from the solid
};

/// Spheres in the order of their gain: the first k are the result for k spheres. Candidates are the largest inscribed
/// spheres at the points of a grid; each step takes the one that adds most volume and touches those taken before.
/// Deterministic. Throws std::invalid_argument if the solid is thinner than the grid, or if number or error cannot be
/// reached.
std::vector<Sphere> inscribed_spheres(const Solid& solid, const InscribedOptions& options);

/// The same number of spheres as inscribed_spheres. Each stands out of the solid by the same length, which gives their
/// union the volume of the solid. Their places are found for these larger spheres and differ from those of
/// inscribed_spheres.
std::vector<Sphere> balanced_spheres(const Solid& solid, const InscribedOptions& options);

} // namespace eccentra::shape
