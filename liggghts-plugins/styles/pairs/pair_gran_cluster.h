// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// pair_style gran/cluster: contacts between clusters, and between clusters and plain spheres.
#pragma once

#include "contact/contact_law.h"
#include "contact/no_friction.h"
#include "contact/off_centre.h"
#include "styles/bodies/contact_records.h"
#include "styles/pairs/near_pairs.h"
#include "styles/pairs/resting_pairs.h"
#include "styles/pairs/waiting_pairs.h"

#include <mpi.h>

#include "pair_gran.h"

#include <memory>
#include <vector>

namespace eccentra::contact {
struct Contact;
}

namespace eccentra::styles {

class HullContacts;

/// How several contacts of the same two bodies share damping.
enum class ContactSharing { shared, parallel };

/// The choices that a user types, also kept in restart files.
struct ClusterContactKeywords {
  ContactSharing sharing = ContactSharing::shared;
  contact::DampingLaw damping = contact::DampingLaw::stock;
  bool tangential_damping = true;
  bool tangential = true; ///< a tangential spring; without it contacts are free of friction
};

/// Pair style "gran/cluster". A PairGran, because stock code casts any style that has "gran" in its name to one.
class PairGranCluster : public LAMMPS_NS::PairGran {
 public:
  explicit PairGranCluster(LAMMPS_NS::LAMMPS* lmp);
  ~PairGranCluster() override;

  const ClusterContactKeywords& arguments() const { return arguments_; }

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

  // Pairs with a rounded body (pair_gran_cluster_hulls.cpp).
  void wait_hulls(int number, const NearPair& p, const contact::Double4& to_b);
  float search_features(const NearPair& p, const double* offset, float skin);
  void evaluate_hulls();
  void evaluate_large_hull(WaitingPair& pair, const contact::Contact* contacts, int count, int real);
  template <class Block>
  void add_hull_pair(Block& block, WaitingPair& waiting, const contact::Contact* contacts, int count);
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
  template <contact::DampingLaw law, bool known_geometry, class Block> void compute_block(Block& block, int padded);
  template <class Block> void share_damping(Block& block, int padded);
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
  contact::PairBlock pairs_ = {};
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
  double** youngs_ = nullptr;
  double** shear_ = nullptr;
  double** damping_ = nullptr;
  double** friction_ = nullptr;
  contact::NoFriction no_friction_; ///< what friction_ is where there is no tangential model
  int contact_count_ = 0;
  int near_count_ = 0;
};

} // namespace eccentra::styles
