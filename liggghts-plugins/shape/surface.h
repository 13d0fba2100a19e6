// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulated surfaces: their defects, the unambiguous repairs, and the volume that they enclose.
#pragma once

#include "shape/cluster_shape.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace eccentra::shape {

/// A surface of triangles.
struct Surface {
  std::vector<Eigen::Vector3d> vertices;     ///< [m]
  std::vector<std::array<int, 3>> triangles; ///< counter-clockwise from outside once it is oriented
};

/// Triangles at each edge, keyed by its two vertices in rising order.
using EdgeFacets = std::map<std::pair<int, int>, std::vector<int>>;
/// Counts every facet at its three edges.
EdgeFacets facets_of_edges(const Surface& surface);

/// Edges with an odd number of facets; a closed surface has none.
struct OpenEdges {
  int single = 0;                   ///< with one facet
  int several = 0;                  ///< with three, five, ...
  std::array<int, 2> first{-1, -1}; ///< vertices of the first of them; -1: there is none
  /// Number of all.
  int total() const { return single + several; }
};
/// Counts the edges of the surface.
OpenEdges open_edges(const Surface& surface);

/// Removes facets that have a vertex twice; returns their number.
int drop_degenerate(Surface& surface);

/// Numbers of removed facets that had the same three vertices as another.
struct RepeatedFacets {
  int copies = 0; ///< of which one stays
  int walls = 0;  ///< of walls between two solids that share them, and of sheets: none stays
};
/// Removes facets with the same three vertices. One of them stays, or none if the surface is closed only without them.
RepeatedFacets drop_repeated(Surface& surface);

/// Removes vertices that no facet has.
void drop_unused_vertices(Surface& surface);

/// A connected closed part of a surface.
struct Shell {
  std::vector<int> triangles; ///< indices into the surface
  double volume;              ///< negative if its facets face inward
  int turned;                 ///< facets that were turned to face as the others do
};

/// Orients the facets of each connected part as those of the larger area, and lists the parts. Facets are
/// connected by edges that exactly two of them share. Throws std::invalid_argument(`where` + reason) if a part has no
/// inside.
std::vector<Shell> orient_shells(Surface& surface, const std::string& where);

/// Winding number of the shell about a point that is not on it: 1 inside, 0 outside, -1 inside an inward shell.
int winding_number(const Surface& surface, const std::vector<int>& triangles, const Eigen::Vector3d& point);

/// Mass properties by sums over the tetrahedra that the triangles form with a point; exact for a closed surface.
MassProperties solid_properties(const Surface& surface);

} // namespace eccentra::shape
