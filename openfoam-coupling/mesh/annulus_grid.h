// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of an orthogonal grid in the cross-section of an eccentric annulus. Includes no OpenFOAM header.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace eccentra::mesh {

/// Hole axis at the origin, pipe centre at (0, -eccentricity (hole_radius - pipe_radius)): towards the low side. [m]
struct AnnulusSection {
  double hole_radius;
  double pipe_radius;
  double eccentricity; ///< 0 (concentric) up to below 1 (touching)

  double offset() const { return eccentricity * (hole_radius - pipe_radius); }
  double area() const; ///< of the exact annulus [m2]
};

/// Position of the vertices of a wall: on its circle, or slightly outside such that the polygon has the circle's area.
/// A polygon of 48 chords on the circle is 0.3 % smaller, which widens the narrow gap of an eccentric annulus.
enum class WallVertices { kOnCircle, kEqualArea };

struct GridOptions {
  std::size_t radial;      ///< cells from pipe to hole
  std::size_t around;      ///< cells around, at least 3
  double wall_grading = 1; ///< width of the middle cell over that of the wall cells, above 0
  WallVertices vertices = WallVertices::kEqualArea;
};

/// Bipolar coordinates, in which both walls are coordinate lines and all lines cross at right angles; polar if
/// concentric. points[i * around + j]: i = 0 on the pipe to `radial` on the hole; j counter-clockwise from +y. [m]
std::vector<std::array<double, 2>> annulus_points(const AnnulusSection& section, const GridOptions& options);

} // namespace eccentra::mesh
