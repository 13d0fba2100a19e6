// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Panels on the surface of a body: what a boundary integral sums over.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/surface.h"

#include <array>
#include <vector>

namespace eccentra::shape {

/// A point of a panel with its share of the area. Lengths in the unit of the body that it was made from.
struct PanelPoint {
  Eigen::Vector3d place;  ///< on the surface
  Eigen::Vector3d normal; ///< unit, outward
  double area;            ///< that it stands for
};

/// A small part of a surface. Near panels see its points, far ones its centre alone.
struct Panel {
  std::vector<PanelPoint> points; ///< of the panel
  int middle;                     ///< index of the point nearest to the centre: where the velocity is matched
  Eigen::Vector3d centre;         ///< mean place of the points
  double area;                    ///< sum over the points
  double extent;                  ///< largest distance of a point from the centre
};

/// Planes through the origin, normal to the axes, that mirror a surface onto itself.
using MirrorPlanes = std::array<bool, 3>;
/// Of the union, or of the surface, in its body frame; to round-off.
MirrorPlanes mirror_planes(const std::vector<Sphere>& spheres);
MirrorPlanes mirror_planes(const Surface& surface);

/// At most `most` panels on the part of the union's surface where every mirrored coordinate is positive; with no mirror
/// plane, on all of it. Each sphere carries an octahedral pattern, so that mirrored spheres have mirrored panels; parts
/// inside other spheres are cut away.
std::vector<Panel> panels_of(const std::vector<Sphere>& spheres, const MirrorPlanes& mirrors, std::size_t most);
/// The same for a closed surface, whose triangles are the panels. Triangles must not cross a mirror plane.
std::vector<Panel> panels_of(const Surface& surface, const MirrorPlanes& mirrors, std::size_t most);

/// The octahedron about the origin, its edges in n parts, blown up to the unit sphere: 8 n^2 triangles that no
/// coordinate plane cuts.
Surface octahedral_sphere(int n);

} // namespace eccentra::shape
