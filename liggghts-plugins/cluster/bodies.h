// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Per-body data of clusters: one LIGGGHTS atom is one body (decision D1).
#pragma once

#include "shape/cluster_shape.h"

#include <mpi.h>

#include "fix.h"

#include <memory>
#include <vector>

namespace eccentra::cluster {

/// The shapes of a scene; an atom's shape id is an index into it. Ids are stable through restart.
class ShapeTable {
public:
  int add(shape::ClusterShape shape);
  int size() const { return static_cast<int>(shapes_.size()); }
  const shape::ClusterShape& operator[](int id) const { return *shapes_[id]; }

private:
  std::vector<std::unique_ptr<shape::ClusterShape>> shapes_;
};

/// Fix style "cluster/bodies", created by the first particletemplate/cluster of a scene (users never type it).
/// Holds orientation, angular momentum and shape id per atom; they migrate, restart and reach ghosts.
/// For a cluster atom: radius = bounding radius, rmass = body mass, density = that of the solid.
class FixBodies : public LAMMPS_NS::Fix {
public:
  FixBodies(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  /// The scene's instance, or null where no cluster was declared.
  static FixBodies* find(LAMMPS_NS::LAMMPS* lmp);

  ShapeTable& shapes();
  /// Shape id of local or ghost atom i; -1 is a plain sphere.
  int shape_id(int i) const;
  /// Orientation (w x y z), body to world, of local or ghost atom i (ghosts: valid from pre_force on).
  double* quaternion(int i);
  /// Angular momentum about the centre of mass of local atom i, world frame [kg m2/s]. Atom::omega follows from it.
  double* angular_momentum(int i);
};

} // namespace eccentra::cluster
