// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contacts of a rounded body with a mesh of triangles.
#pragma once

#include "contact/manifold.h"
#include "contact/mesh_triangle.h"

#include <vector>

namespace eccentra::contact {

/// The mesh is a solid of radius 0, seen from either side. The body's points touch where the mesh is closest: a point
/// of an edge or corner counts where all triangles that have it are closest there, and once. Of polyhedra edges touch
/// active edges, and the solid touches the corners at their ends, with weights as in Manifolds. Disks touch each of
/// surfaces_of() as they touch a solid.
class MeshManifold {
 public:
  /// Features of a triangle in ids: corners 0 to 2, edges 3 to 5, the face; from 7 on further points of an arc on it.
  static constexpr int features = 16;

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
  bool belongs_to(std::size_t triangle, const Eigen::Vector3d& on, const Eigen::Vector3d& point,
                  const std::vector<MeshTriangle>& triangles) const;
  bool take_corner(const Eigen::Vector3d& corner, double near, const ContactBody& body);
  void touches_of_disk(const ContactBody& disk, const std::vector<MeshTriangle>& triangles);
  void take_surface(const ContactBody& disk, const std::vector<MeshTriangle>& triangles,
                    const std::vector<int>& surface, int number);
  void pose_triangle(const MeshTriangle& triangle, const Eigen::Vector3d& middle);

  ContactCore core_; ///< of the triangle at hand
  PosedCore posed_;
  Manifolds manifolds_;
  std::vector<int> candidates_;
  std::vector<TriangleExtent> extents_;  ///< of the triangles
  std::vector<std::vector<int>> points_; ///< of the body, by the triangle that they touch
  std::vector<Eigen::Vector3d> corners_; ///< that have been counted
  std::vector<Touch> touches_;
};

} // namespace eccentra::contact
