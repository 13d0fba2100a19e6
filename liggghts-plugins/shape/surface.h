// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulated surfaces: what is wrong with them, what can be repaired without a choice, and what they enclose.
#pragma once

#include "shape/cluster_shape.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace eccentra::shape {

struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles; ///< counter-clockwise from outside once it is oriented
};

/// Triangles at each edge, keyed by its two vertices in rising order.
using EdgeFacets = std::map<std::pair<int, int>, std::vector<int>>;
EdgeFacets facets_of_edges(const Surface& surface);

/// Edges where not an even number of facets meet: a closed surface has none.
struct OpenEdges {
  int single = 0;  ///< with one facet
  int several = 0; ///< with three, five, ...
  std::array<int, 2> first{-1, -1};
  int total() const { return single + several; }
};
OpenEdges open_edges(const Surface& surface);

/// Drops facets with a vertex twice; returns how many.
int drop_degenerate(Surface& surface);

/// Facets with the same three vertices: how many were dropped.
struct RepeatedFacets {
  int copies = 0; ///< of facets of which one stays
  int walls = 0;  ///< of walls between two solids that share them, and of sheets: all of them
};
/// Of facets with the same three vertices one stays, or none where the surface is closed only without them.
RepeatedFacets drop_repeated(Surface& surface);

/// Drops vertices that no facet has.
void drop_unused_vertices(Surface& surface);

/// A connected closed part of a surface.
struct Shell {
  std::vector<int> triangles;
  double volume; ///< negative where its facets face inward
  int turned;    ///< facets that were turned to face as the others do
};

/// Turns the facets of each connected part the same way round, that of the larger area, and lists the parts; facets are
/// connected by edges that exactly two of them share. Throws std::invalid_argument(`where` + reason) if a part has no
/// inside.
std::vector<Shell> orient_shells(Surface& surface, const std::string& where);

/// How many times the shell winds about a point that is not on it: 1 inside, 0 outside, -1 inside an inward shell.
int winding_number(const Surface& surface, const std::vector<int>& triangles, const Eigen::Vector3d& point);

/// Sums over the tetrahedra that the triangles span with a point: exact for a closed surface.
MassProperties solid_properties(const Surface& surface);

} // namespace eccentra::shape
