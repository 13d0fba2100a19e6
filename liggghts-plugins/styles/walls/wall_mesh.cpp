// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle meshes as walls.
#include "styles/walls/wall_mesh.h"

#include "base/eigen_views.h"

#include <mpi.h>

#include "atom.h"
#include "fix_mesh_surface.h"
#include "fix_neighlist_mesh.h"
#include "lammps.h"
#include "modify.h"
#include "tri_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

constexpr int kFaceContact = 7; // all three barycentric coordinates positive, in the code of TriMesh

Eigen::Vector3d node(TriMesh* mesh, int triangle, int k) {
  double x[3];
  mesh->node(triangle, k, x);
  return base::vector3(x);
}

/// Velocities of a triangle's nodes, or null for a mesh at rest.
double** node_velocities(TriMesh* mesh, int triangle) {
  auto* v = mesh->prop().getElementProperty<MultiVectorContainer<double, 3, 3>>("v");
  return v ? v->begin()[triangle] : nullptr;
}

} // namespace

void WallMeshes::find() {
  fixes_.clear();
  meshes_.clear();
  for (const std::string& id : ids_) {
    auto* fix = dynamic_cast<FixMeshSurface*>(lmp_->modify->find_fix_id(id.c_str()));
    if (!fix)
      throw std::invalid_argument("there is no fix mesh/surface with id '" + id + "': define the mesh before its wall");
    fixes_.push_back(fix);
    meshes_.push_back(fix->triMesh());
  }
}

void WallMeshes::create_neighbour_lists(int groupbit) {
  list_is_ours_.clear();
  for (FixMeshSurface* fix : fixes_) {
    list_is_ours_.push_back(fix->meshNeighlist() == nullptr);
    fix->createWallNeighList(groupbit);
  }
}

void WallMeshes::delete_neighbour_lists() {
  for (std::size_t m = 0; m < ids_.size(); ++m) {
    auto* fix = dynamic_cast<FixMeshSurface*>(lmp_->modify->find_fix_id(ids_[m].c_str()));
    if (fix && m < list_is_ours_.size() && list_is_ours_[m])
      fix->deleteWallNeighList();
  }
}

void WallMeshes::invert_neighbour_lists(int groupbit, std::vector<int>& near) {
  const int nlocal = lmp_->atom->nlocal;
  const int* mask = lmp_->atom->mask;
  const auto for_each_pair = [&](auto visit) {
    for (int m = 0; m < static_cast<int>(meshes_.size()); ++m) {
      FixNeighlistMesh* list = fixes_[m]->meshNeighlist();
      const int triangles = meshes_[m]->sizeLocal() + meshes_[m]->sizeGhost();
      for (int t = 0; t < triangles; ++t)
        for (const int i : list->get_contact_list(t))
          if (i < nlocal && (mask[i] & groupbit))
            visit(i, m, t);
    }
  };
  first_.assign(nlocal + 2, 0);
  for_each_pair([&](int i, int, int) { ++first_[i + 2]; });
  for (int i = 0; i < nlocal; ++i)
    first_[i + 2] += first_[i + 1];
  near_.resize(first_[nlocal + 1]);
  for_each_pair([&](int i, int m, int t) { near_[first_[i + 1]++] = {m, t}; });
  near.clear();
  for (int i = 0; i < nlocal; ++i)
    if (first_[i + 1] > first_[i])
      near.push_back(i);
}

contact::WallSurface WallMeshes::plane(int mesh, int triangle) const {
  Eigen::Vector3d normal;
  meshes_[mesh]->surfaceNorm(triangle, normal.data());
  return contact::WallSurface::plane(node(meshes_[mesh], triangle, 0), normal);
}

void WallMeshes::touch(int mesh, int triangle, int atom, int sub, const Eigen::Vector3d& x, const Eigen::Vector3d& arm,
                       double radius, std::vector<contact::WallTouch>& touches) const {
  TriMesh* tri_mesh = meshes_[mesh];
  Eigen::Vector3d centre = x + arm;
  double to_wall[3];
  double bary[3];
  int sign = 0;
  const double gap =
      tri_mesh->resolveTriSphereContactBary(atom, triangle, radius, centre.data(), to_wall, bary, sign, true);
  if (gap >= 0.0)
    return;
  const int id = tri_mesh->id(triangle);
  if (sign == kFaceContact)
    for (const contact::WallTouch& other : touches)
      if (other.atom == atom && other.key.sub() == sub && other.key.mesh() == mesh &&
          coplanar(mesh, other.key.triangle(), id))
        return;
  const double distance = radius + gap;
  Eigen::Vector3d normal;
  if (distance > 0.0)
    normal = -base::vector3(to_wall) / distance;
  else
    tri_mesh->surfaceNorm(triangle, normal.data());
  contact::WallTouch touch = at_triangle(mesh, triangle, atom, sub, bary);
  touch.normal = normal;
  touch.overlap = -gap;
  touch.radius = radius;
  touch.lever = arm - (radius + 0.5 * gap) * normal;
  touch.to_wall = arm - distance * normal;
  touches.push_back(touch);
}

void WallMeshes::touch(int atom, const Eigen::Vector3d& x, const contact::PosedCore& body,
                       std::vector<contact::WallTouch>& touches) const {
  in_order_.clear();
  for_each_near(atom, [&](int mesh, int triangle) {
    if (plane(mesh, triangle).distance(x) < body.core->bound)
      in_order_.push_back({mesh, triangle});
  });
  // By their ids, so that it is the same triangle on any rank that has a contact which others could have.
  std::sort(in_order_.begin(), in_order_.end(), [&](const Near& a, const Near& b) {
    return a.mesh != b.mesh ? a.mesh < b.mesh : meshes_[a.mesh]->id(a.triangle) < meshes_[b.mesh]->id(b.triangle);
  });
  for (auto first = in_order_.begin(); first != in_order_.end();) {
    const int mesh = first->mesh;
    const auto last = std::find_if(first, in_order_.end(), [&](const Near& near) { return near.mesh != mesh; });
    triangles_.clear();
    for (auto near = first; near != last; ++near) {
      contact::MeshTriangle t;
      for (int k = 0; k < 3; ++k) {
        t.corner[k] = node(meshes_[mesh], near->triangle, k) - x;
        t.edge_active[k] = meshes_[mesh]->edgeActive(near->triangle, k);
      }
      triangles_.push_back(t);
    }
    for (const auto& [number, c] : manifold_.touches({&body}, triangles_)) {
      const contact::MeshTriangle& t = triangles_[number];
      const Eigen::Vector3d to_wall = c.arm - c.distance * c.normal, from = to_wall - t.corner[0];
      const Eigen::Vector3d e1 = t.corner[1] - t.corner[0], e2 = t.corner[2] - t.corner[0], area = e1.cross(e2);
      const double b1 = area.dot(from.cross(e2)) / area.squaredNorm(),
                   b2 = area.dot(e1.cross(from)) / area.squaredNorm();
      const double bary[3] = {1 - b1 - b2, b1, b2};
      const int sub = contact::feature_a(c.id) * contact::MeshManifold::features + contact::feature_b(c.id);
      contact::WallTouch touch = at_triangle(mesh, first[number].triangle, atom, sub, bary);
      touch.normal = c.normal;
      touch.overlap = c.overlap();
      touch.radius = c.radius_a;
      touch.lever = c.contact_point();
      touch.to_wall = to_wall;
      touch.weight = c.weight;
      touch.hertz_radius = body.core->contact_radius;
      touches.push_back(touch);
    }
    first = last;
  }
}

contact::WallTouch WallMeshes::at_triangle(int mesh, int triangle, int atom, int sub, const double* bary) const {
  contact::WallTouch touch;
  touch.atom = atom;
  touch.history = nullptr;
  touch.key = contact::WallContactKey(sub, mesh, meshes_[mesh]->id(triangle));
  touch.wall_type = fixes_[mesh]->atomTypeWall();
  touch.triangle = triangle;
  motion(mesh, triangle, bary, touch.wall_velocity, touch.wall_omega);
  return touch;
}

void WallMeshes::motion(int mesh, int triangle, const double* bary, Eigen::Vector3d& velocity,
                        Eigen::Vector3d& omega) const {
  velocity.setZero();
  omega.setZero();
  double** v = node_velocities(meshes_[mesh], triangle);
  if (!v)
    return;
  for (int k = 0; k < 3; ++k)
    velocity += bary[k] * base::vector3(v[k]);
  // A rigid triangle: v1 - v0 = omega x e1 and v2 - v0 = omega x e2, solved in the basis (e1, e2, n).
  const Eigen::Vector3d e1 = node(meshes_[mesh], triangle, 1) - node(meshes_[mesh], triangle, 0);
  const Eigen::Vector3d e2 = node(meshes_[mesh], triangle, 2) - node(meshes_[mesh], triangle, 0);
  const Eigen::Vector3d dv1 = base::vector3(v[1]) - base::vector3(v[0]);
  const Eigen::Vector3d dv2 = base::vector3(v[2]) - base::vector3(v[0]);
  const Eigen::Vector3d area = e1.cross(e2);
  const double twice = area.norm();
  const Eigen::Vector3d n = area / twice;
  omega = (n.dot(dv2) * e1 - n.dot(dv1) * e2 + dv1.dot(e2) * n) / twice;
}

bool WallMeshes::coplanar(int mesh, int id1, int id2) const {
  TriMesh* tri_mesh = meshes_[mesh];
  return id1 != id2 && tri_mesh->map(id1, 0) >= 0 && tri_mesh->areCoplanarNodeNeighs(id1, id2);
}

void WallMeshes::report(const contact::WallTouch& touch, const Eigen::Vector3d& force_on_particle) const {
  Eigen::Vector3d force = force_on_particle;
  Eigen::Vector3d to_wall = touch.to_wall;
  Eigen::Vector3d velocity = touch.wall_velocity;
  fixes_[touch.key.mesh()]->add_particle_contribution(touch.atom, force.data(), to_wall.data(), touch.triangle,
                                                      velocity.data());
}

int WallMeshes::smallest_type() const {
  int type = std::numeric_limits<int>::max();
  for (FixMeshSurface* fix : fixes_)
    type = std::min(type, fix->atomTypeWall());
  return type;
}

int WallMeshes::largest_type() const {
  int type = 0;
  for (FixMeshSurface* fix : fixes_)
    type = std::max(type, fix->atomTypeWall());
  return type;
}

} // namespace eccentra::styles
