// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: walls for clusters and plain spheres, with the wall's velocity taken at the contact point.
#pragma once

#include "contact/contact_core.h"
#include "contact/contact_models.h"
#include "contact/contact_stiffness.h"
#include "contact/manifold.h"
#include "contact/shared_contacts.h"
#include "contact/surface_spheres.h"
#include "contact/wall_contact.h"
#include "contact/wall_history.h"
#include "styles/bodies/contact_materials.h"
#include "styles/bodies/contact_records.h"
#include "styles/models/stock_contact.h"
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

  /// Visits the contacts that there are now, as visit(touch, contact::ContactStiffness), for whoever wants to know (fix
  /// timestep/limit). Forces and history stay.
  template <class Visit> void for_each_stiffness(Visit visit) {
    if (near_list_stale_)
      rebuild_near_list();
    touches_.clear();
    for (const int i : near_) {
      find_touches(i);
      const int count = static_cast<int>(touches_.size());
      if (count > 0) {
        contact::LargeContactBlock& block = large_block(count);
        for (int m = 0; m < count; ++m)
          fill(block, m, touches_[m]);
        begin_groups();
        add_group(i, 0, count);
        if (stock_)
          stock_stiffness(block, touches_.data(), count);
        else
          stiffness(block, count);
        for (int m = 0; m < count; ++m)
          if (touches_[m].weight > 0)
            visit(touches_[m], contact::stiffness_of(block, m, stock_ ? stock_->exponent() : model_->exponent));
      }
      touches_.clear();
    }
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
  void scatter_clusters(const contact::PlainWall& wall);
  /// Contacts first..last-1 of the block are those of atom i; so share their damping.
  void begin_groups() { groups_ = 0; }
  void add_group(int i, int first, int last);
  /// Stiffness and damping of contacts 0..n-1, which are those of the groups.
  template <class Block> void stiffness(Block& block, int n);
  template <class Block> void evaluate(Block& block, int n, bool advance);
  template <class Block> void share_groups(Block& block, int n);
  /// The same of contacts through LIGGGHTS's own classes.
  StockSubContact stock_contact(const contact::WallTouch& touch);
  template <class Block> void stock_stiffness(Block& block, const contact::WallTouch* touches, int n);
  template <class Block> void stock_evaluate(Block& block, const contact::WallTouch* touches, int n, bool advance);
  template <class Block> void fill(Block& block, int m, const contact::WallTouch& touch);
  template <class Block> void set_curvature(Block& block, int m, const contact::WallTouch& touch) const;
  template <class Block> void scatter(const Block& block, int m, const contact::WallTouch& touch);
  template <class Block> void add_forces(Block& block, std::size_t first, std::size_t last);
  contact::LargeContactBlock& large_block(int count);
  /// Torque [N m] of the rolling model on atom i from place m of the block, evaluated.
  template <class Block>
  Eigen::Vector3d rolling_torque(const Block& block, int m, int i, int wall_type, const Eigen::Vector3d& wall_spin,
                                 contact::WallHistoryEntry& entry);
  bool rolls(int i) const { return arguments_.rolling && (arguments_.rolling->for_clusters() || is_plain_sphere(i)); }
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
  struct Group {
    int atom, first, last; ///< contacts first..last-1 of the block are this atom's
  };
  std::array<Group, contact::ContactBlock::capacity> group_{};
  int groups_ = 0;
  std::vector<int> group_of_; ///< of the contacts in the block
  contact::ImpactRows impacts_ = {};
  contact::DampingShares shares_;
  std::array<int, contact::ContactBlock::capacity> sub_in_block_{};
  std::vector<int> hits_; ///< sub-spheres of the cluster at hand that may touch
  bool near_list_stale_ = true;
  std::vector<contact::WallTouch> touches_; ///< of the particles at hand
  std::vector<double> gaps_;                ///< of the sub-spheres of the particle at hand
  contact::PosedCore posed_;                ///< of the rounded body at hand
  std::vector<contact::Contact> hull_contacts_;
  std::unique_ptr<contact::ContactBlock> block_;
  std::unique_ptr<contact::LargeContactBlock> large_block_; ///< made when an atom needs it
  ContactRecords* all_records_ = nullptr;
  ContactRecords* records_ = nullptr;           ///< null in steps whose contacts no output wants
  contact::WallHistory::Entries next_history_;  ///< of the particle at hand
  std::vector<StockSubContact> stock_contacts_; ///< of the block
  std::vector<double> no_history_;              ///< for contacts that only tell their stiffness
  std::array<double, 7> local_sums_{};          ///< force, torque, number of contacts on this rank
  std::array<double, 7> global_sums_{};
  long long summed_at_ = -1;

  const contact::ContactModel* model_ = nullptr;
  std::unique_ptr<StockContact>
      stock_;        ///< the models of LIGGGHTS's own, or null where contacts are evaluated in blocks
  double reach_ = 1; ///< sub-spheres interact up to this multiple of their radii
  ContactMaterials materials_;
};

} // namespace eccentra::styles
