// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The exposed surface of a shape as triangles.
#pragma once

#include "shape/cluster_shape.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <vector>

namespace eccentra::shape {

/// Names of the point arrays.
constexpr const char* eccentricity_array = "delta_e/R_eq";
constexpr const char* sphere_array = "sub-sphere"; ///< which sub-sphere a point belongs to

/// The part of one sphere of a union that no other covers, as triangles with exact normals in the frame of the spheres;
/// without points if all of it is covered. `fineness` and `margin` as in union_surface.
vtkSmartPointer<vtkPolyData> free_part(const std::vector<Sphere>& spheres, std::size_t index, int fineness,
                                       double margin);

/// Triangles of a rounded body, or of the free part of every touchable sphere, moved by `offset` [m], with the exact
/// normals and the arrays above. `fineness` is the number of meridians per sphere; a margin > 0, in radii, keeps that
/// much of the covered part, so that no cracks show between facets when the surface is drawn.
vtkSmartPointer<vtkPolyData> union_surface(const ClusterShape& shape, const Eigen::Vector3d& offset, int fineness,
                                           double margin);

} // namespace eccentra::shape
