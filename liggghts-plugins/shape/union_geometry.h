// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Volume, centre, inertia and surface of a union of spheres, without sampling noise.
#pragma once

#include "shape/cluster_shape.h"

#include <vector>

namespace eccentra::shape {

/// Measures of a union of spheres. Overlaps count once; the walls of enclosed voids belong to the surface, and
/// the voids do not belong to the volume.
struct UnionGeometry {
  MassProperties properties; ///< in the frame of the spheres
  /// Area of each sphere that no other sphere covers [m2], in the order of the spheres given.
  std::vector<double> exposed_area;
};

/// Measures the union by the divergence theorem: volume and moments are integrals of polynomials over the exposed part
/// of each sphere. That part is cut along circles of latitude, whose exposed arcs are known exactly; the
/// remaining integral is smooth between the heights where arcs appear, vanish or touch, and is computed by Gauss
/// quadrature. Relative error about 1e-10. Deterministic; the result does not depend on the order of the spheres beyond
/// round-off. Throws std::invalid_argument for an empty list, a radius that is not positive, or coordinates that are
/// not finite.
UnionGeometry measure_union(const std::vector<Sphere>& spheres);

/// Throws std::invalid_argument if the spheres are not connected, with the number (from 1) of a sphere that neither
/// touches nor overlaps the rest. Gaps up to `touch_tolerance` radii of the smaller sphere count as touching.
void require_connected(const std::vector<Sphere>& spheres);

} // namespace eccentra::shape
