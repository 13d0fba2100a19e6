// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fills a solid with overlapping spheres that touch its surface from within.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/vtk/solid.h"

#include <vector>

namespace eccentra::shape {

struct InscribedOptions {
  int spheres = 0; ///< stop at this number; 0: no limit but the error's
  double volume_error =
      0;              ///< stop where the union lacks no more than this part of the solid's volume; 0: not asked for
  int resolution = 0; ///< grid points along the longest side; 0: chosen from the solid
};

/// Spheres in the order of their gain: the k first are the answer for k spheres. Candidates are the largest inscribed
/// spheres at the points of a grid; each step takes the one that adds most volume and touches those taken before.
/// Deterministic. Throws std::invalid_argument where the solid is thinner than the grid, or where count or error cannot
/// be reached.
std::vector<Sphere> inscribed_spheres(const Solid& solid, const InscribedOptions& options);

/// As many spheres as inscribed_spheres gives, each standing out of the solid by one and the same length, chosen so
/// that their union has the volume of the solid. Their places are sought for these larger spheres: they are not those
/// of inscribed_spheres.
std::vector<Sphere> balanced_spheres(const Solid& solid, const InscribedOptions& options);

} // namespace eccentra::shape
