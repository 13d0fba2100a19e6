// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces given by flat faces, taken apart at their edges into planes, cylinders and other pieces.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace eccentra::link {

/// A flat face. World frame, metres.
struct Facet {
  /// Computes centre, normal and area; `corners` in order around the face.
  explicit Facet(std::vector<Eigen::Vector3d> corners);
  std::vector<Eigen::Vector3d> corners; ///< in order
  Eigen::Vector3d centre;               ///< mean of the corners
  Eigen::Vector3d normal;               ///< unit vector; zero where the face has no area
  double area;                          ///< [m2]
};

/// Form of a smooth piece of a surface.
enum class SurfaceForm { plane, cylinder, other };

/// A plane, a cylinder or another smooth surface.
struct SurfacePiece {
  SurfaceForm form = SurfaceForm::other;                ///< what it is
  Eigen::Vector3d point = Eigen::Vector3d::Zero();      ///< of the plane, or of the axis
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ(); ///< normal of the plane, or along the axis
  double low = 0, high = 0;                             ///< radii of the cylinder between which its faces lie [m]
  double begin = 0, end = 0; ///< where the cylinder begins and ends along the axis, from `point`
  double extent = 0;         ///< diagonal of the box around it; 0: without end
  double chord = 0;          ///< how far its flat faces lie from the surface they stand for
  std::vector<int> facets;   ///< indices of its faces
};

/// Pieces end where neighbouring faces meet at an edge of more than 60 degrees.
std::vector<SurfacePiece> pieces_of(const std::vector<Facet>& facets);

} // namespace eccentra::link
