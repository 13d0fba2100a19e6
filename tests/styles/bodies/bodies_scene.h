// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of a few bodies placed by hand.
#pragma once

#include "shape/cluster_shape.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "support/granular_script.h"
#include "support/liggghts_session.h"

#include "atom_vec.h"
#include "modify.h"

#include <Eigen/Geometry>

#include <mpi.h>

#include <string>
#include <vector>

namespace eccentra::test {

/// A box of 0.2 m about the origin without gravity, no pair style yet.
inline void open_box(LiggghtsSession& session, const Material& material, const std::string& boundary = "f f f") {
  session.script(granular_box("-0.1 0.1 -0.1 0.1 -0.1 0.1", boundary) + granular_material(material));
}

inline void use_clusters(LiggghtsSession& session, const std::string& arguments = "") {
  session.script(cluster_contacts("rolling_friction off " + arguments) + "fix integrate all nve/cluster\n");
}

inline shape::ClusterShape shape_of(const std::vector<std::string>& arguments, double diameter = 6.35e-3) {
  std::size_t used = 0;
  return shape::make_shape(arguments, 0, used, diameter);
}

inline shape::ClusterShape shape_of(const std::string& family, const std::string& count, double diameter = 6.35e-3) {
  std::size_t used = 0;
  return shape::make_shape({family, count}, 0, used, diameter);
}

/// A body as it starts.
struct Start {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Creates one atom on the rank that owns its place; its tag is the next free one. Returns its local index or -1.
inline int create_atom(LiggghtsSession& session, const Start& start) {
  const auto& x = start.position;
  session.command("create_atoms 1 single " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " +
                  std::to_string(x[2]) + " units box");
  const int i = session.local(static_cast<int>(session.atom().natoms));
  if (i >= 0)
    for (int k = 0; k < 3; ++k) {
      session.atom().x[i][k] = x[k]; // with all its digits
      session.atom().v[i][k] = start.velocity[k];
      session.atom().omega[i][k] = start.omega[k];
    }
  return i;
}

inline void add_sphere(LiggghtsSession& session, const Start& start, double radius, double density = 2619) {
  const int i = create_atom(session, start);
  if (i < 0)
    return;
  session.atom().radius[i] = radius;
  session.atom().density[i] = density;
  session.atom().rmass[i] = density * 4 * M_PI / 3 * radius * radius * radius;
}

inline void add_body(LiggghtsSession& session, const shape::ClusterShape& shape, const Start& start,
                     double density = 2619) {
  styles::FixClusterBodies& bodies = styles::FixClusterBodies::require(&session.lammps());
  const int id = bodies.shapes().add(shape);
  const int i = create_atom(session, start);
  const auto& q = start.orientation;
  const double arguments[4] = {q.w(), q.x(), q.y(), q.z()};
  if (i >= 0)
    bodies.make_body(i, id, density, arguments);
}

/// Kinetic energy of translation and rotation, from fix nve/cluster.
inline double kinetic_energy(LiggghtsSession& session) {
  LAMMPS_NS::Fix* motion = session.lammps().modify->find_fix_id("integrate");
  return motion->compute_vector(0) + motion->compute_vector(1);
}

} // namespace eccentra::test
