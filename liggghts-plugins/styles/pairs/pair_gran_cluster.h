// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// pair_style gran/cluster: contacts between clusters, and between clusters and plain spheres.
#pragma once

#include "contact/contact_models.h"
#include "contact/pair_forces.h"
#include "contact/shared_contacts.h"
#include "styles/bodies/contact_materials.h"
#include "styles/bodies/contact_records.h"
#include "styles/models/stock_contact.h"
#include "styles/pairs/near_pairs.h"
#include "styles/pairs/resting_pairs.h"
#include "styles/pairs/waiting_pairs.h"

#include <mpi.h>

#include "pair_gran.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace eccentra::contact {
struct Contact;
}

namespace eccentra::styles {

class HullContacts;

/// How several contacts of the same two bodies share damping.
enum class ContactSharing { shared, parallel };

/// The choices that a user types.
struct ClusterContactKeywords {
  StockModelNames names;            ///< `normal` is a row of contact_models() where in_blocks
  bool in_blocks = true;            ///< else through LIGGGHTS's own classes
  std::vector<std::string> options; ///< keywords and values for those
  ContactSharing sharing = ContactSharing::shared;
  contact::DampingLaw damping = contact::DampingLaw::stock;
  bool tangential_damping = true;
  bool tangential = true; ///< a tangential spring; without it contacts are free of friction
  contact::FrictionBound friction = contact::FrictionBound::elastic;
  bool synchronised = true; ///< the tangential spring advances by what contact points slide in the middle of a step
  RollingRadius rolling_radius = RollingRadius::sub_sphere;

  contact::DampingChoice damping_choice() const { return {damping, tangential_damping}; }
};

/// Reads them. Throws std::invalid_argument with one sentence that names the word, its value and the remedy.
ClusterContactKeywords read_contact_keywords(const std::vector<std::string>& arguments);

/// Pair style "gran/cluster". A PairGran, because stock code casts any style that has "gran" in its name to one.
class PairGranCluster : public LAMMPS_NS::PairGran {
 public:
  explicit PairGranCluster(LAMMPS_NS::LAMMPS* lmp);
  ~PairGranCluster() override;

  const ClusterContactKeywords& arguments() const { return arguments_; }
  /// The models of LIGGGHTS's own, or null where contacts are evaluated in blocks.
  StockContact* stock() const { return stock_.get(); }

  void settings(int narg, char** arg) override;
  void init_style() override;
  void init_granular() override;
  bool contact_match(const std::string type, const std::string model) override;
  int64_t hashcode() override;
  double stressStrainExponent() override;
  void write_restart_settings(FILE* fp) override;
  void read_restart_settings(FILE* fp, const int major, const int minor) override;
  double memory_usage() override;
  /// Calls visit(a, b, contacts) for each pair of bodies (local or ghost indices) that touched when forces were last
  /// computed.
  template <class Visit> void for_each_touching_pair(Visit visit) const {
    if (!near_ || !near_->live())
      return;
    for (std::size_t n = 0; n < near_->pairs.size(); ++n)
      if (const int count = near_->contacts.first[n + 1] - near_->contacts.first[n]; count > 0)
        visit(near_->pairs[n].a, near_->pairs[n].b, count);
    if (resting_)
      resting_->for_each([&](const RestingPairs::Kept& kept) {
        visit(near_->pairs[kept.pair].a, near_->pairs[kept.pair].b, static_cast<int>(kept.contacts.size()));
      });
  }
  /// "contacts": number of sub-contacts of this rank (int), "near_pairs": pairs of bodies (int).
  void* extract(const char* name, int& dim) override;

 protected:
  void compute_force(int eflag, int vflag, int addflag) override;

 private:
  struct PairInBlock {
    int a, b;
    int first, last;         ///< contacts in the block
    int old_first, old_last; ///< contacts of the last step
  };

  // The loop over pairs (pair_gran_cluster_forces.cpp).
  void look_at(int number, bool fresh);
  void renew_candidates(int number, NearPair& p, const double* offset);
  int preselect(int number, const NearPair& p, const double* offset);
  inline void wait(int number, const NearPair& p, const contact::Double4& to_b, const int* ids, int count,
                   bool may_idle);
  void not_touching(const WaitingPair& pair, int number_waiting);
  void may_idle(int number, const double* offset, double gap);
  void search_candidates(NearPair& p, const contact::RelativePose& pose, const double* offset);

  /// Gap across which sub-spheres of a pair interact at most [m].
  double gap_reached(const NearPair& p) const { return (reach_ - 1) * near_->largest_reach(p); }

  // Pairs with a rounded body (pair_gran_cluster_hulls.cpp).
  void wait_hulls(int number, const NearPair& p, const contact::Double4& to_b);
  float search_features(const NearPair& p, const double* offset, float skin);
  bool add_boxes(int number, const NearPair& p, const contact::Double4& to_b);
  void evaluate_hulls();
  void take_manifolds();
  void judge_sunk_cores(const NearPair& near, double depth);
  void add_hull_contacts(WaitingPair& pair, const contact::Contact* contacts, int count);
  void make_room_in_block(int contacts);
  void evaluate_large_hull(WaitingPair& pair, const contact::Contact* contacts, int count, int real);
  template <class Block>
  void add_hull_pair(Block& block, WaitingPair& waiting, const contact::Contact* contacts, int count);
  void add_box_pair(WaitingPair& waiting);
  template <class Block> void finish_hull_block(Block& block);
  void add_corrections();

  // Pairs that rest (pair_gran_cluster_rest.cpp).
  void rest();
  RestingPairs::Kept evaluate_alone(int n);
  void add_resting_forces();

  // Contacts in blocks (pair_gran_cluster_blocks.cpp).
  void evaluate_waiting();
  void evaluate_large();
  template <class Block> void evaluate_waiting(Block& block);
  template <class Block> void find_contacts(Block& block);
  template <class Block> void find_contacts_of_spheres(Block& block);
  template <bool known_geometry, class Block> void finish_block(Block& block);
  template <class Block> void add_pair(Block& block, const WaitingPair& waiting, int first);
  template <class Block> void fill_materials(Block& block, const WaitingPair& waiting, int first, int number);
  void fill_inertia(const WaitingPair& waiting, int number);
  template <class Block> void recall_history(Block& block);
  template <bool known_geometry, class Block> void compute_block(Block& block, int padded);

  // Contacts through LIGGGHTS's own classes (pair_gran_cluster_stock.cpp).
  template <class Block> void compute_stock(Block& block);
  template <class Block> void fill_stock(const Block& block, int m, StockSubContact& contact);
  template <class Block> void share_stock(Block& block);
  void move_history_on();
  template <class Block> void write_down(const Block& block);
  template <class Forces> void scatter(int pair, const Forces& forces);

  ClusterContactKeywords arguments_;
  FixClusterBodies* bodies_ = nullptr;
  std::unique_ptr<NearPairs> near_;
  std::unique_ptr<HullContacts> hulls_;   ///< null unless a shape is a rounded body
  std::unique_ptr<RestingPairs> resting_; ///< null unless bodies may sleep
  contact::CandidateSearch search_;
  std::vector<int> hits_;
  std::vector<int> awake_; ///< pairs that need a look; ~n where the candidates are no longer all that can touch
  WaitingPairs waiting_;
  PairInBlock in_block_[contact::ContactBlock::capacity];
  contact::ImpactRows pairs_ = {}; ///< one row per pair in the block
  contact::PairForces sums_ = {};  ///< likewise
  contact::DampingShares shares_;
  int pairs_in_block_ = 0;
  contact::ContactBlock block_ = {};
  std::unique_ptr<contact::LargeContactBlock> large_block_; ///< made when a pair needs it
  int filled_ = 0;                                          ///< contacts in the block
  bool single_contacts_ = false; ///< each pair in it has one, between the centres of two spheres
  std::vector<int> block_ids_;   ///< their contact_id
  std::vector<int> block_pair_;  ///< and their pair in the block
  /// The kinds of A and B with whose masses and materials all rows of block_ and pairs_ are filled, if they are ...
  int kind_a_ = 0, kind_b_ = 0;
  bool one_kind_ = false;
  bool one_inertia_ = false; ///< ... and with their inertia, which orientation does not change
  bool advance_ = false;
  ContactRecords* all_records_ = nullptr;
  ContactRecords* records_ = nullptr; ///< null in steps whose contacts no output wants
  std::string typed_;                 ///< all of the pair_style line, for restart files
  const contact::ContactModel* model_ = nullptr;
  std::unique_ptr<StockContact> stock_;
  std::vector<StockSubContact> stock_contacts_; ///< of the block
  double reach_ = 1;                            ///< sub-spheres interact up to this multiple of the sum of their radii
  std::vector<double> block_more_;              ///< ContactList::more of the contacts in the block
  /// Where ContactList::more was in this step before it grew.
  std::vector<std::vector<double>> outgrown_;
  /// Torques that contacts of LIGGGHTS's models put on B beyond the opposite of what is on A, per pair in the block.
  std::vector<Eigen::Vector3d> excess_torques_;
  ContactMaterials materials_;
  int contact_count_ = 0;
  int near_count_ = 0;
};

} // namespace eccentra::styles
