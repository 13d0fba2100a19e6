// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Per-body data of clusters: one LIGGGHTS atom is one body (decision D1).
#pragma once

#include "contact/rigid_rotation.h"
#include "contact/surface_spheres.h"
#include "shape/cluster_shape.h"
#include "styles/bodies/insertion_overlap.h"
#include "styles/bodies/last_forces.h"

#include <mpi.h>

#include "fix.h"

#include <array>
#include <memory>
#include <vector>

namespace eccentra::styles {

/// The shapes of a scene; an atom's shape id is an index into it. Ids are stable through restart.
class ShapeTable {
 public:
  /// Id of the shape; one that is already there (same name, same spheres) keeps its id.
  int add(shape::ClusterShape shape);
  int size() const { return static_cast<int>(shapes_.size()); }
  const shape::ClusterShape& operator[](int id) const { return *shapes_[id]; }
  /// Sub-spheres that can touch; id -1 is a plain sphere.
  const contact::SurfaceSpheres& surface(int id) const { return *surfaces_[id + 1]; }
  const contact::FreeRotation& free_rotation(int id) const { return rotations_[id]; }

  ShapeTable();

 private:
  std::vector<std::unique_ptr<shape::ClusterShape>> shapes_;
  std::vector<std::unique_ptr<contact::SurfaceSpheres>> surfaces_; ///< first the plain sphere, then one per shape
  std::vector<contact::FreeRotation> rotations_;
};

/// Fix style "cluster/bodies", created by the first particletemplate/cluster of a scene (users never type it).
/// Holds orientation, angular momentum and shape id per atom; they migrate, restart and reach ghosts.
/// For a cluster atom: radius = bounding radius, rmass = body mass, density = that of the solid.
/// Per-atom array for dumps, f_cluster_bodies[1..8]: quaternion w x y z, angular momentum x y z, shape id.
class FixClusterBodies : public LAMMPS_NS::Fix {
 public:
  static constexpr const char* fix_id = "cluster_bodies";
  static constexpr const char* style_name = "cluster/bodies";
  static constexpr int plain_sphere = -1;

  FixClusterBodies(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixClusterBodies() override;

  /// The scene's instance, or null where no cluster was declared.
  static FixClusterBodies* find(LAMMPS_NS::LAMMPS* lmp);
  /// The scene's instance, made if there is none. Needs the simulation box.
  static FixClusterBodies& require(LAMMPS_NS::LAMMPS* lmp);

  ShapeTable& shapes() { return shapes_; }
  const ShapeTable& shapes() const { return shapes_; }
  /// What clusters under insertion must not touch.
  InsertionOverlap& insertion() { return insertion_; }
  const LAMMPS_NS::Atom& host_atoms() const { return *atom; }

  /// Shape id of local or ghost atom i; -1 is a plain sphere.
  int shape_id(int i) const { return static_cast<int>(data_[i][shape_column]); }
  /// Orientation (w x y z), body to world, of local or ghost atom i (ghosts: valid from pre_force on).
  double* quaternion(int i) { return data_[i]; }
  const double* quaternion(int i) const { return data_[i]; }
  /// Angular momentum about the centre of mass of local atom i, world frame [kg m2/s]. Atom::omega follows from it.
  double* angular_momentum(int i) { return data_[i] + momentum_column; }
  const double* angular_momentum(int i) const { return data_[i] + momentum_column; }
  /// Row-major matrix, body to world, of local or ghost atom i (valid from pre_force on; nve/cluster keeps that of
  /// local atoms up to date). Round bodies have no use for it: theirs is some rotation.
  const double* rotation(int i) const { return rotation_.data() + 9 * static_cast<std::size_t>(i); }
  double* rotation(int i) { return rotation_.data() + 9 * static_cast<std::size_t>(i); }
  /// True for plain spheres and one-sphere clusters: their orientation touches nothing.
  bool is_round(int i) const { return shapes_.surface(shape_id(i)).single_at_centre; }
  /// What is to be added to a sub-sphere's radius of atom i: 0 for clusters, the atom's radius for a plain sphere [m].
  double extra_radius(int i) const;
  /// Principal moments of inertia of local atom i [kg m2]; plain spheres: 2/5 m r^2.
  Eigen::Vector3d inertia(int i) const;

  /// Makes local atom i a body of this shape: sets radius, mass and density (of the solid, [kg/m3]), orientation, and
  /// the angular momentum that its present Atom::omega means.
  void make_body(int i, int shape_id, double density, const double* quaternion);
  /// Sets the angular momentum of local atom i from Atom::omega.
  void momentum_from_omega(int i);
  /// Sets Atom::omega of local atom i from the angular momentum and rotation(i).
  void omega_from_momentum(int i);

  /// The first step of a run: goes on with the forces and torques of the last step of the run before, or of the run
  /// that wrote the restart file, where nothing has changed in between.
  void resume_forces();

  int setmask() override;
  void post_create() override;
  void setup_pre_force(int vflag) override;
  void pre_force(int vflag) override;
  void post_run() override;
  void grow_arrays(int nmax) override;
  void copy_arrays(int i, int j, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buf) override;
  int unpack_exchange(int nlocal, double* buf) override;
  int pack_restart(int i, double* buf) override;
  void unpack_restart(int nlocal, int nth) override;
  int size_restart(int nlocal) override;
  int maxsize_restart() override;
  void write_restart(FILE* fp) override;
  void restart(char* buf) override;
  int pack_comm(int n, int* list, double* buf, int pbc_flag, int* pbc) override;
  void unpack_comm(int n, int first, double* buf) override;
  double memory_usage() override;

 private:
  static constexpr int momentum_column = 4;
  static constexpr int shape_column = 7;
  static constexpr int columns = 8;

  /// Of ghosts and, to be safe, of all where atoms are new.
  void update_rotations(int first, int last);
  void bring_to_ghosts();
  /// False where the bytes of the restart file cannot be what write_restart wrote.
  bool read_shapes(const char* data, int size);

  ShapeTable shapes_;
  InsertionOverlap insertion_{*this};
  double** data_ = nullptr; ///< [nmax][columns]
  LastForces last_forces_;
  bool stepped_ = false; ///< this run has made a step
  std::vector<double> rotation_;
  bool send_shapes_ = true; ///< ghosts are new: they need their shape id, too
  bool new_bodies_ = false; ///< made on this rank since the last check
  bool all_round_ = false;  ///< nobody asks for ghosts' orientation
};

} // namespace eccentra::styles
