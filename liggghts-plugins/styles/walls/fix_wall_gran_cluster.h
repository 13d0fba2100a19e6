// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: walls for clusters and plain spheres, with the wall's velocity taken at the contact point.
#pragma once

#include "contact/contact_law.h"
#include "contact/manifold.h"
#include "contact/no_friction.h"
#include "contact/surface_spheres.h"
#include "contact/wall_contact.h"
#include "contact/wall_history.h"
#include "styles/bodies/contact_records.h"
#include "styles/walls/wall_arguments.h"
#include "styles/walls/wall_mesh.h"

#include <mpi.h>

#include "fix.h"

#include <array>
#include <memory>
#include <vector>

namespace eccentra::contact {
struct PlainWall;
} // namespace eccentra::contact

namespace eccentra::styles {

class FixClusterBodies;
class FixSleepCluster;

/// Scalar: number of (sub-)contacts. Vector: force on the wall (1-3) [N] and torque on the wall (4-6) [N m] about a
/// point of the plane or of the cylinder's axis (meshes: about the origin).
class FixWallGranCluster : public LAMMPS_NS::Fix {
 public:
  /// Stock styles look walls up by the prefix "wall/gran" and cast what they find to their own class: under this name
  /// they do not find us.
  static constexpr const char* inner_style = "cluster/wall/gran";

  FixWallGranCluster(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixWallGranCluster() override;

  /// What the user typed: the wall's surface or the ids of its meshes, and how it moves.
  const WallArguments& arguments() const { return arguments_; }

  int setmask() override;
  void post_create() override;
  void pre_delete(bool unfix) override;
  void init() override;
  void setup(int) override;
  void pre_neighbor() override;
  void post_force(int) override;

  double compute_scalar() override;
  double compute_vector(int n) override;

  /// Visits the contacts that there are now, for whoever wants to know (fix timestep/limit). Forces and history stay.
  template <class Visit> void for_each_touch(Visit visit) {
    if (near_list_stale_)
      rebuild_near_list();
    for (const int i : near_) {
      touches_.clear();
      find_touches(i);
      if (arguments_.shared)
        share_damping(i, 0);
      for (const contact::WallTouch& touch : touches_)
        visit(touch);
    }
    touches_.clear();
  }

  // History migrates and restarts.
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  void write_restart(FILE* file) override;
  void restart(char* state) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  /// Doubles of the longest record of an atom of this rank.
  int largest_record() const;
  double memory_usage() override;

  // Range of materials, asked for by LIGGGHTS's property registry.
  int min_type() override;
  int max_type() override;

 private:
  // Contacts are collected from body after body until so many are together: whole vectors, and still in the cache.
  static constexpr int kBatch = 32;

  [[noreturn]] void fail(const std::string& sentence);
  void refuse_rolling_of_clusters_alone();
  void rebuild_near_list();
  /// Appends the contacts of local atom i to touches_ and makes them the atom's history.
  void collect(int i);
  void find_touches(int i);
  void collect_primitive(int i);
  void collect_mesh(int i);
  /// The same for a rounded body at a primitive wall.
  void collect_hull(int i, const contact::SurfaceSpheres& spheres, const Eigen::Matrix3d& rotation);
  /// History with which a contact of this atom goes on: its own, or that of a coplanar triangle before.
  contact::WallHistoryEntry old_entry(int i, const contact::WallTouch& touch) const;
  /// Hands the contacts their entries of the last step, or new ones.
  void renew_history(int i, std::size_t first);
  /// Scales the damping of the atom's contacts, touches_[first] and after, to what all of them are together.
  void share_damping(int i, std::size_t first);
  template <class Stiffness> bool share_damping_of_one_normal(int i, std::size_t first, const Stiffness& stiffness);
  /// Forces on near_spheres_ and near_clusters_.
  void near_forces();
  bool stands_still() const;
  void rest();
  struct Resting {
    int atom;
    std::array<double, 6> force; ///< and torque
    std::array<double, 7> sums;
  };
  Resting evaluate_alone(int i);
  /// Forces of all collected contacts, a block at a time.
  void add_forces();
  /// Contacts, forces and torques of near_spheres_, all in one go.
  void sphere_forces();
  /// Writes the contact of sphere i, if it has one, to place m of the block; returns the next free place.
  int add_sphere(const contact::PlainWall& wall, int i, int m);
  void scatter_spheres(const contact::PlainWall& wall, int n);
  /// The same for near_clusters_ at a primitive wall.
  void cluster_forces();
  /// Writes those of the `count` sub-spheres in hits_ that touch to places `first` and after; returns the next free
  /// one.
  int add_cluster(const contact::PlainWall& wall, int i, int count, int first);
  void share_damping_in_block(int i, int first, int last);
  void scatter_clusters(const contact::PlainWall& wall);
  void evaluate(int n, bool advance);
  void fill(int m, const contact::WallTouch& touch);
  void scatter(int m, const contact::WallTouch& touch);
  /// Torque [N m] of the rolling model on atom i from place m of the block, evaluated.
  Eigen::Vector3d rolling_torque(int m, int i, int wall_type, const Eigen::Vector3d& wall_spin,
                                 contact::WallHistoryEntry& entry);
  /// Looks whether an output wants the contacts of this step.
  void open_records();
  bool is_plain_sphere(int i) const;
  bool moves_like_sphere(int i) const;

  WallArguments arguments_;
  std::unique_ptr<WallMeshes> meshes_; ///< null: a primitive wall
  int smallest_type_ = 0;
  int largest_type_ = 0;
  FixClusterBodies* bodies_ = nullptr; ///< null where the scene has no clusters
  contact::WallHistory history_;
  std::vector<int> near_;                  ///< local atoms that may touch before the next neighbour build
  std::vector<int> near_spheres_;          ///< of these, spheres at a primitive wall
  std::vector<int> near_clusters_;         ///< the others
  const FixSleepCluster* sleep_ = nullptr; ///< null where no body sleeps, or this wall moves
  std::vector<char> asleep_;               ///< of near_, in the last step
  std::vector<Resting> resting_;           ///< of these, in the order of near_
  std::array<int, kBatch> in_block_{};
  struct ClusterInBlock {
    int atom, first, last; ///< contacts first..last-1 of the block are this atom's
  };
  std::array<ClusterInBlock, contact::ContactBlock::capacity> clusters_in_block_{};
  std::array<int, contact::ContactBlock::capacity> sub_in_block_{};
  int bodies_in_block_ = 0;
  std::vector<int> hits_; ///< sub-spheres of the cluster at hand that may touch
  bool near_list_stale_ = true;
  std::vector<contact::WallTouch> touches_; ///< of the particles at hand
  std::vector<double> gaps_;                ///< of the sub-spheres of the particle at hand
  contact::PosedCore posed_;                ///< of the rounded body at hand
  std::vector<contact::Contact> hull_contacts_;
  std::unique_ptr<contact::ContactBlock> block_;
  ContactRecords* all_records_ = nullptr;
  ContactRecords* records_ = nullptr;          ///< null in steps whose contacts no output wants
  contact::WallHistory::Entries next_history_; ///< of the particle at hand
  std::array<double, 7> local_sums_{};         ///< force, torque, number of contacts on this rank
  std::array<double, 7> global_sums_{};
  long long summed_at_ = -1;

  double** youngs_ = nullptr;
  double** shear_ = nullptr;
  double** damping_ = nullptr;
  double** friction_ = nullptr;
  contact::NoFriction no_friction_; ///< what friction_ is where there is no tangential model
};

} // namespace eccentra::styles
