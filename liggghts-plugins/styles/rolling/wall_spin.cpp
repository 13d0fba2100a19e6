// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the spin of primitive walls from fix wall/gran, and of triangles from the velocities of their nodes.
#include "styles/rolling/wall_spin.h"

#include "styles/entry/private_access.h"

#include "fix_wall_gran.h"

#include <Eigen/Geometry>

namespace eccentra::styles {
// `shear` on a primitive cylinder turns it about its axis; the fix has no accessor for that.
struct WallShearAxis {
  using type = int LAMMPS_NS::FixWallGran::*;
};
struct WallShearVector {
  using type = double (LAMMPS_NS::FixWallGran::*)[3];
};
template struct PrivateMember<WallShearAxis, &LAMMPS_NS::FixWallGran::shearAxis_>;
template struct PrivateMember<WallShearVector, &LAMMPS_NS::FixWallGran::shearAxisVec_>;
} // namespace eccentra::styles

namespace eccentra::styles {

using namespace LAMMPS_NS;

WallSpin::WallSpin(LIGGGHTS::IContactHistorySetup* owner)
    : turning_(dynamic_cast<const TurningWall*>(owner)), stock_(dynamic_cast<FixWallGran*>(owner)) {}

void WallSpin::refresh() {
  primitive_.setZero();
  if (turning_) {
    primitive_ = turning_->wall_spin();
  } else if (stock_ && !stock_->is_mesh_wall() && stock_->*Published<WallShearAxis>::pointer >= 0) {
    const auto& spin = stock_->*Published<WallShearVector>::pointer;
    primitive_ = Eigen::Vector3d(spin[0], spin[1], spin[2]);
  }
}

Eigen::Vector3d WallSpin::at(TriMesh* mesh, int triangle) const {
  if (!mesh)
    return primitive_;
  const auto* velocities = mesh->prop().getElementProperty<MultiVectorContainer<double, 3, 3>>("v");
  if (!velocities)
    return Eigen::Vector3d::Zero();
  double*** const v = const_cast<MultiVectorContainer<double, 3, 3>*>(velocities)->begin();
  Eigen::Vector3d position[3];
  Eigen::Vector3d velocity[3];
  for (int k = 0; k < 3; ++k) {
    mesh->node(triangle, k, position[k].data());
    velocity[k] = Eigen::Vector3d(v[triangle][k][0], v[triangle][k][1], v[triangle][k][2]);
  }
  return triangle_spin(position, velocity);
}

Eigen::Vector3d triangle_spin(const Eigen::Vector3d (&position)[3], const Eigen::Vector3d (&velocity)[3]) {
  const Eigen::Vector3d edge1 = position[1] - position[0];
  const Eigen::Vector3d edge2 = position[2] - position[0];
  const Eigen::Vector3d normal = edge1.cross(edge2);
  const Eigen::Vector3d turn1 = velocity[1] - velocity[0];
  const Eigen::Vector3d turn2 = velocity[2] - velocity[0];
  // Out-of-plane velocities of the edges give the spin within the plane, in-plane velocity of one edge the rest.
  const double area_squared = normal.squaredNorm();
  const Eigen::Vector3d within = (turn2.dot(normal) * edge1 - turn1.dot(normal) * edge2) / area_squared;
  const double about = turn1.dot(normal.cross(edge1)) / (edge1.squaredNorm() * area_squared);
  return within + about * normal;
}

} // namespace eccentra::styles
