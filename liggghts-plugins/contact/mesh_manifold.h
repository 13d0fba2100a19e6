// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contacts of a rounded body with a mesh of triangles.
#pragma once

#include "contact/manifold.h"

#include <array>
#include <vector>

namespace eccentra::contact {

/// Corners from the body's centre [m]; edge k joins corners k and k + 1. An edge is active in one of the triangles that
/// share it, and in none where a plane goes on across it.
struct MeshTriangle {
  std::array<Eigen::Vector3d, 3> corner; ///< from the body's centre [m]
  std::array<bool, 3> edge_active;       ///< by the number of an edge
  /// Unit, by the order of the corners.
  Eigen::Vector3d normal() const;
  /// The point closest to another.
  Eigen::Vector3d closest(const Eigen::Vector3d& point) const;
};

/// The mesh is a solid of radius 0, seen from either side. The body's points touch where the mesh is closest: a point
/// of an edge or corner counts where all triangles that have it are closest there, and once. Of polyhedra edges touch
/// active edges, and the solid touches the corners at their ends, with weights as in Manifolds. Disks touch with their
/// points alone.
class MeshManifold {
 public:
  /// Features of a triangle in ids: corners 0 to 2, edges 3 to 5, the face.
  static constexpr int features = 7;

  /// Normals lead out of the mesh; the body is A of each contact.
  struct Touch {
    int triangle;    ///< index of the triangle
    Contact contact; ///< of the body with it
  };
  MeshManifold();
  /// Valid until the next call.
  const std::vector<Touch>& touches(const ContactBody& body, const std::vector<MeshTriangle>& triangles);

 private:
  void take(const ContactBody& body, const std::vector<MeshTriangle>& triangles, int number);
  void pose_triangle(const MeshTriangle& triangle, const Eigen::Vector3d& middle);

  ContactCore core_; ///< of the triangle at hand
  PosedCore posed_;
  Manifolds manifolds_;
  std::vector<int> candidates_;
  std::vector<Eigen::Vector3d> closest_; ///< of each triangle to the point at hand
  std::vector<std::vector<int>> points_; ///< of the body, by the triangle that they touch
  std::vector<Eigen::Vector3d> corners_; ///< that have been counted
  std::vector<Touch> touches_;
};

} // namespace eccentra::contact
