// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: walls for clusters and plain spheres, with the wall's velocity taken at the contact point.
#pragma once

#include "cluster/wall_contact_law.h"
#include "cluster/wall_history.h"
#include "cluster/wall_words.h"

#include <mpi.h>

#include "fix.h"

#include <array>
#include <vector>

namespace eccentra::cluster {

/// Scalar: number of (sub-)contacts. Vector: force on the wall (1-3) [N] and torque on the wall (4-6) [N m] about a
/// point of the plane or of the cylinder's axis (meshes: about the origin).
class FixWallGranCluster : public LAMMPS_NS::Fix {
 public:
  FixWallGranCluster(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixWallGranCluster() override;

  int setmask() override;
  void init() override;
  void setup(int) override;
  void pre_neighbor() override;
  void post_force(int) override;

  double compute_scalar() override;
  double compute_vector(int n) override;

  // History migrates and restarts.
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  double memory_usage() override;

  // Range of materials, asked for by LIGGGHTS's property registry.
  int min_type() override;
  int max_type() override;

 private:
  /// One contact of the particle at hand.
  struct Contact {
    WallContactKey key;
    Eigen::Vector3d normal;
    Eigen::Vector3d lever; ///< from the body's centre to the contact point
    Eigen::Vector3d wall_velocity;
    Eigen::Vector3d wall_omega;
    double overlap;
    double radius;
    double share;
    int wall_type;
  };

  [[noreturn]] void fail(const std::string& sentence);
  void rebuild_near_list();
  void collect(int i);
  void add_forces(int i);
  WallMaterial material(int particle_type, int wall_type) const;

  WallWords words_;
  WallHistory history_;
  std::vector<int> near_; ///< local atoms that may touch before the next neighbour build
  bool near_list_stale_ = true;
  std::vector<Contact> contacts_;      ///< of the particle at hand
  WallHistory::Entries next_history_;  ///< of the particle at hand
  std::array<double, 7> local_sums_{}; ///< force, torque, number of contacts on this rank
  std::array<double, 7> global_sums_{};
  long long summed_at_ = -1;

  double** youngs_ = nullptr;
  double** shear_ = nullptr;
  double** damping_ = nullptr;
  double** friction_ = nullptr;
};

} // namespace eccentra::cluster
