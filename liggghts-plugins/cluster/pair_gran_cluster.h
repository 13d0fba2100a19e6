// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// pair_style gran/cluster: contacts between clusters, and between clusters and plain spheres.
#pragma once

#include "cluster/contact_law.h"
#include "cluster/near_pairs.h"
#include "cluster/resting_pairs.h"

#include <mpi.h>

#include "pair_gran.h"

#include <memory>
#include <vector>

namespace eccentra::cluster {

/// How several contacts of the same two bodies share damping.
enum class ContactSharing { shared, parallel };

/// The choices that a user types, also kept in restart files.
struct ClusterContactWords {
  ContactSharing sharing = ContactSharing::shared;
  DampingLaw damping = DampingLaw::stock;
  bool tangential_damping = true;
};

/// Pair style "gran/cluster". A PairGran, because stock code casts any style that has "gran" in its name to one.
class PairGranCluster : public LAMMPS_NS::PairGran {
 public:
  explicit PairGranCluster(LAMMPS_NS::LAMMPS* lmp);
  ~PairGranCluster() override;

  const ClusterContactWords& words() const { return words_; }

  void settings(int narg, char** arg) override;
  void init_style() override;
  void init_granular() override;
  bool contact_match(const std::string type, const std::string model) override;
  int64_t hashcode() override;
  double stressStrainExponent() override;
  void write_restart_settings(FILE* fp) override;
  void read_restart_settings(FILE* fp, const int major, const int minor) override;
  double memory_usage() override;
  /// "contacts": number of sub-contacts of this rank (int), "near_pairs": pairs of bodies (int).
  void* extract(const char* name, int& dim) override;

 protected:
  void compute_force(int eflag, int vflag, int addflag) override;

 private:
  struct PairInBlock {
    int a, b;
    int first, last;  ///< contacts in the block
    double offset[3]; ///< from A's centre to B's [m]
  };

  int pair_contacts(NearPair& p, const double* offset, double path, int old_first, int old_last);
  double quiet_until(const NearPair& p, const double* offset, double path) const;
  void search_candidates(NearPair& p, const RelativePose& pose, const double* offset, double path);
  int gather(const NearPair& p, const double* offset, const int* ids, int count, int old_first, int old_last);
  template <class Block>
  int gather_into(Block& block, const NearPair& p, const double* offset, const int* ids, int count, int old_first,
                  int old_last);
  RelativePose pose_of(const NearPair& p, const double* offset) const;
  void rest();
  RestingPairs::Kept evaluate_alone(int n);
  void add_resting_forces();
  template <class Block> void flush(Block& block);
  template <DampingLaw law, class Block> void compute_block(Block& block, int padded);
  template <class Block> void share_damping(Block& block, int padded);
  template <class Block> void weigh_off_centre(Block& block);
  template <class Block> void scatter(const Block& block, const PairInBlock& p);

  ClusterContactWords words_;
  FixBodies* bodies_ = nullptr;
  std::unique_ptr<NearPairs> near_;
  std::unique_ptr<RestingPairs> resting_; ///< null unless bodies may sleep
  CandidateSearch search_;
  std::vector<int> hits_;
  PairInBlock in_block_[ContactBlock::capacity];
  int pairs_in_block_ = 0;
  ContactBlock block_ = {};
  std::unique_ptr<LargeContactBlock> large_block_; ///< made when a pair needs it
  int filled_ = 0;                                 ///< contacts in the block
  int block_ids_[LargeContactBlock::capacity];
  bool advance_ = false;
  double** youngs_ = nullptr;
  double** shear_ = nullptr;
  double** damping_ = nullptr;
  double** friction_ = nullptr;
  int contact_count_ = 0;
  int near_count_ = 0;
};

} // namespace eccentra::cluster
