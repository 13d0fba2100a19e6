// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle meshes of stock fix mesh/surface as walls: who is near which triangle, and where a sphere touches one.
#pragma once

#include "contact/mesh_manifold.h"
#include "contact/wall_contact.h"
#include "contact/wall_surface.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
class FixMeshSurface;
class TriMesh;
} // namespace LAMMPS_NS

namespace eccentra::styles {

class WallMeshes {
 public:
  WallMeshes(LAMMPS_NS::LAMMPS* lmp, std::vector<std::string> ids) : lmp_(lmp), ids_(std::move(ids)) {}

  /// Finds the meshes by their ids. Throws std::invalid_argument with one sentence if one is not there.
  void find();
  /// Makes stock's neighbour lists of triangles where no other wall has made them.
  void create_neighbour_lists(int groupbit);
  void delete_neighbour_lists();

  /// Turns stock's lists (atoms of a triangle) into ours (triangles of an atom). `near` becomes the local atoms of the
  /// group that have any.
  void invert_neighbour_lists(int groupbit, std::vector<int>& near);

  /// Calls visit(mesh, triangle) for all triangles near local atom i; triangle is a local index.
  template <class Visit> void for_each_near(int i, Visit visit) const {
    for (int k = first_[i]; k < first_[i + 1]; ++k)
      visit(near_[k].mesh, near_[k].triangle);
  }

  /// The plane in which a triangle lies.
  contact::WallSurface plane(int mesh, int triangle) const;
  /// Adds the contact of a sphere to `touches`, unless there is none, or a coplanar neighbour has the same one already.
  /// `arm`: from the body's centre x to the sphere's centre.
  void touch(int mesh, int triangle, int atom, int sub, const Eigen::Vector3d& x, const Eigen::Vector3d& arm,
             double radius, std::vector<contact::WallTouch>& touches) const;
  /// Adds all contacts of a rounded body, posed at x, with the triangles near it.
  void touch(int atom, const Eigen::Vector3d& x, const contact::PosedCore& body,
             std::vector<contact::WallTouch>& touches) const;
  /// True if contacts with these two triangles (by id) of a mesh are one, so that history passes from one to the other.
  bool coplanar(int mesh, int id1, int id2) const;
  /// Tells the mesh of a force on it, for stock's own stress output.
  void report(const contact::WallTouch& touch, const Eigen::Vector3d& force_on_particle) const;

  int smallest_type() const;
  int largest_type() const;

 private:
  struct Near {
    int mesh;
    int triangle;
  };
  contact::WallTouch at_triangle(int mesh, int triangle, int atom, int sub, const double* bary) const;
  /// Of the mesh's material at barycentric coordinates, and of the triangle as a rigid body.
  void motion(int mesh, int triangle, const double* bary, Eigen::Vector3d& velocity, Eigen::Vector3d& omega) const;

  LAMMPS_NS::LAMMPS* lmp_;
  std::vector<std::string> ids_;
  std::vector<LAMMPS_NS::FixMeshSurface*> fixes_;
  std::vector<LAMMPS_NS::TriMesh*> meshes_;
  std::vector<bool> list_is_ours_;
  std::vector<int> first_;
  std::vector<Near> near_;
  // Of the rounded body at hand.
  mutable contact::MeshManifold manifold_;
  mutable std::vector<Near> in_order_;
  mutable std::vector<contact::MeshTriangle> triangles_;
};

} // namespace eccentra::styles
