// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finds facets of a surface that cross or cover each other.
#pragma once

#include "shape/surface.h"

#include <optional>

namespace eccentra::shape {

/// Two triangles that cross.
struct Crossing {
  int first, second;     ///< triangles
  Eigen::Vector3d place; ///< a point that they share
};

/// A pair of triangles that intersect beyond their common vertices and edges: one pierces the other, or both lie in one
/// plane and overlap. Distances below `tolerance` [units of the surface] count as none. Pairs come from a
/// VTK locator; triangles thinner than the tolerance are ignored.
std::optional<Crossing> find_crossing(const Surface& surface, double tolerance);

} // namespace eccentra::shape
