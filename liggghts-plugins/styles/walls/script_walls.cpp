// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads walls out of the fixes of a script.
#include "styles/walls/script_walls.h"

#include "styles/entry/private_access.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include <mpi.h>

#include "fix_mesh_surface.h"
#include "fix_wall_gran.h"
#include "lammps.h"
#include "modify.h"
#include "primitive_wall.h"
#include "tri_mesh.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace eccentra::styles {
namespace {

namespace stock = PRIMITIVE_WALL_DEFINITIONS;

// What stock keeps of its primitive walls has no getter.
struct WallKind {
  using type = stock::WallType PrimitiveWall::*;
};
struct WallNumbers {
  using type = double* PrimitiveWall::*;
};
struct WallShears {
  using type = int FixWallGran::*;
};
struct WallShearDirection {
  using type = int FixWallGran::*;
};
struct WallShearAxis {
  using type = int FixWallGran::*;
};
struct WallShearSpeed {
  using type = double FixWallGran::*;
};

} // namespace
} // namespace eccentra::styles

namespace eccentra::styles {
template struct PrivateMember<WallKind, &LAMMPS_NS::PrimitiveWall::wType>;
template struct PrivateMember<WallNumbers, &LAMMPS_NS::PrimitiveWall::param>;
template struct PrivateMember<WallShears, &LAMMPS_NS::FixWallGran::shear_>;
template struct PrivateMember<WallShearDirection, &LAMMPS_NS::FixWallGran::shearDim_>;
template struct PrivateMember<WallShearAxis, &LAMMPS_NS::FixWallGran::shearAxis_>;
template struct PrivateMember<WallShearSpeed, &LAMMPS_NS::FixWallGran::vshear_>;
} // namespace eccentra::styles

namespace eccentra::styles {
namespace {

template <class Tag, class Object> auto& member(Object& object) {
  return object.*Published<Tag>::pointer;
}

link::Vector3 three(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}

std::string named(const std::string& id, const std::string& form) {
  return "fix " + id + " (" + form + ")";
}

link::PrimitiveWall of_ours(const contact::WallSurface& surface, const std::string& id) {
  link::PrimitiveWall wall;
  wall.id = id;
  wall.name = named(id, surface.is_plane() ? "plane" : "cylinder");
  wall.form = surface.is_plane() ? link::PrimitiveWall::Form::plane : link::PrimitiveWall::Form::cylinder;
  wall.point = three(surface.reference());
  wall.direction = three(surface.direction());
  wall.radius = surface.is_plane() ? 0 : surface.radius();
  wall.velocity = three(surface.velocity_at(surface.reference()));
  wall.angular_velocity = three(surface.angular_velocity());
  return wall;
}

link::PrimitiveWall of_stock(FixWallGran& fix) {
  PrimitiveWall& primitive = *fix.primitiveWall();
  const stock::WallType kind = member<WallKind>(primitive);
  const double* numbers = member<WallNumbers>(primitive);
  const bool plane = kind == stock::XPLANE || kind == stock::YPLANE || kind == stock::ZPLANE;
  const int axis = plane ? kind - stock::XPLANE : kind - stock::XCYLINDER;
  link::PrimitiveWall wall;
  wall.id = fix.id;
  wall.name = named(fix.id, stock::wallString[kind]);
  wall.form = plane ? link::PrimitiveWall::Form::plane : link::PrimitiveWall::Form::cylinder;
  wall.direction[axis] = 1;
  if (plane) {
    wall.point[axis] = numbers[0];
  } else {
    wall.radius = numbers[0];
    wall.point[(axis + 1) % 3] = numbers[1];
    wall.point[(axis + 2) % 3] = numbers[2];
  }
  if (!member<WallShears>(fix))
    return wall;
  // A cylinder slides along its axis or turns about it; `shear` then is a rate of rotation.
  const double speed = member<WallShearSpeed>(fix);
  const int about = member<WallShearAxis>(fix);
  if (!plane && about >= 0)
    wall.angular_velocity[about] = speed;
  else
    wall.velocity[member<WallShearDirection>(fix)] = speed;
  return wall;
}

/// All triangles of a mesh on rank 0, nine doubles each, as `write(triangle, nine doubles)` gives them.
template <class Write> std::vector<std::array<link::Vector3, 3>> gathered(MPI_Comm world, int own, Write write) {
  constexpr int kDoubles = 9;
  int rank = 0, size = 1;
  MPI_Comm_rank(world, &rank);
  MPI_Comm_size(world, &size);
  std::vector<double> mine(static_cast<std::size_t>(own) * kDoubles);
  for (int i = 0; i < own; ++i)
    write(i, mine.data() + static_cast<std::size_t>(i) * kDoubles);
  MPI_Datatype triangle;
  MPI_Type_contiguous(kDoubles, MPI_DOUBLE, &triangle);
  MPI_Type_commit(&triangle);
  std::vector<int> counts(size), begins(size);
  MPI_Gather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  int total = 0;
  for (int r = 0; r < size && rank == 0; ++r) {
    begins[r] = total;
    total += counts[r];
  }
  std::vector<std::array<link::Vector3, 3>> all(total);
  static_assert(sizeof(all[0]) == kDoubles * sizeof(double));
  MPI_Gatherv(mine.data(), own, triangle, all.data(), counts.data(), begins.data(), triangle, 0, world);
  MPI_Type_free(&triangle);
  return all;
}

link::TriangleWall of_mesh(LAMMPS& lmp, FixMeshSurface& fix, bool running) {
  TriMesh& mesh = *fix.triMesh();
  link::TriangleWall wall;
  wall.id = fix.id;
  wall.name = "mesh '" + wall.id + "'";
  wall.moves = mesh.isMoving();
  wall.corners = gathered(lmp.world, mesh.sizeLocal(), [&mesh](int i, double* nine) {
    for (int k = 0; k < 3; ++k)
      mesh.node(i, k, nine + 3 * k);
  });
  auto* velocity = mesh.prop().getElementProperty<MultiVectorContainer<double, 3, 3>>("v");
  int any = velocity && (running || !wall.moves);
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, lmp.world);
  wall.velocity_known = any || !wall.moves;
  if (any)
    wall.velocities = gathered(lmp.world, mesh.sizeLocal(), [velocity](int i, double* nine) {
      if (velocity)
        std::copy_n(&velocity->begin()[i][0][0], 9, nine);
    });
  return wall;
}

} // namespace

link::WallDescription walls_of_script(LAMMPS* lmp, bool running) {
  link::WallDescription walls;
  std::set<FixMeshSurface*> seen;
  const auto add_mesh = [&](FixMeshSurface* mesh) {
    if (mesh && seen.insert(mesh).second)
      walls.meshes.push_back(of_mesh(*lmp, *mesh, running));
  };
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    Fix* const fix = lmp->modify->fix[i];
    if (const auto* ours = dynamic_cast<FixWallGranCluster*>(fix)) {
      if (ours->arguments().surface)
        walls.primitives.push_back(of_ours(*ours->arguments().surface, fix->id));
      for (const std::string& id : ours->arguments().meshes)
        add_mesh(dynamic_cast<FixMeshSurface*>(lmp->modify->find_fix_id(id.c_str())));
    } else if (auto* gran = dynamic_cast<FixWallGran*>(fix)) {
      if (!gran->is_mesh_wall() && gran->primitiveWall())
        walls.primitives.push_back(of_stock(*gran));
      for (int m = 0; m < gran->n_meshes(); ++m)
        add_mesh(gran->mesh_list()[m]);
    }
  }
  return walls;
}

bool any_moves(const link::WallDescription& walls) {
  return std::any_of(walls.meshes.begin(), walls.meshes.end(), [](const auto& mesh) { return mesh.moves; });
}

} // namespace eccentra::styles
