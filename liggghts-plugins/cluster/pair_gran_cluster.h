// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// pair_style gran/cluster: contacts between clusters, and between clusters and plain spheres.
#pragma once

#include "cluster/contact_law.h"
#include "cluster/near_pairs.h"
#include "cluster/off_centre.h"
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
    int first, last;         ///< contacts in the block
    int old_first, old_last; ///< contacts of the last step
  };
  /// Contacts found among candidates, and the least (distance^2 - (sum of radii)^2) of them all [m2].
  struct Gathered {
    int count;
    double least;
  };

  // The loop over pairs (pair_gran_cluster_forces.cpp).
  int pair_contacts(int number, bool fresh, const double* offset, int old_first, int old_last);
  void may_idle(int number, const double* offset, double gap);
  void search_candidates(NearPair& p, const RelativePose& pose, const double* offset);
  RelativePose pose_of(const NearPair& p, const double* offset) const;

  // Pairs that rest (pair_gran_cluster_rest.cpp).
  void rest();
  RestingPairs::Kept evaluate_alone(int n);
  void add_resting_forces();

  // Contacts in blocks (pair_gran_cluster_blocks.cpp).
  Gathered gather(const NearPair& p, const double* offset, const int* ids, int count, int old_first, int old_last);
  template <class Block>
  Gathered gather_into(Block& block, const NearPair& p, const double* offset, const int* ids, int count, int old_first,
                       int old_last);
  template <class Block>
  void add_pair(Block& block, const NearPair& p, const double* offset, int last, int old_first, int old_last);
  void flush();
  template <class Block> void flush(Block& block);
  template <class Block> void recall_history(Block& block);
  template <DampingLaw law, class Block> void compute_block(Block& block, int padded);
  template <class Block> void share_damping(Block& block, int padded);
  void scatter(int pair);

  ClusterContactWords words_;
  FixBodies* bodies_ = nullptr;
  std::unique_ptr<NearPairs> near_;
  std::unique_ptr<RestingPairs> resting_; ///< null unless bodies may sleep
  CandidateSearch search_;
  std::vector<int> hits_;
  std::vector<int> awake_; ///< pairs that need a look; ~n where the candidates are no longer all that can touch
  PairInBlock in_block_[ContactBlock::capacity];
  PairBlock pairs_ = {};
  /// The shapes whose inertia fills all rows of pairs_, or null.
  const SurfaceSpheres *isotropic_a_ = nullptr, *isotropic_b_ = nullptr;
  int pairs_in_block_ = 0;
  ContactBlock block_ = {};
  std::unique_ptr<LargeContactBlock> large_block_; ///< made when a pair needs it
  int filled_ = 0;                                 ///< contacts in the block
  std::vector<int> block_ids_;                     ///< their contact_id
  std::vector<int> block_pair_;                    ///< and their pair in the block
  /// Materials and mass of the contacts in the block, where all of them have the same.
  struct Common {
    double mass, youngs, shear, damping, friction;
    bool operator==(const Common& c) const {
      return mass == c.mass && youngs == c.youngs && shear == c.shear && damping == c.damping && friction == c.friction;
    }
  };
  Common common_ = {};
  bool common_everywhere_ = false; ///< all rows of the block are filled with it
  bool advance_ = false;
  double** youngs_ = nullptr;
  double** shear_ = nullptr;
  double** damping_ = nullptr;
  double** friction_ = nullptr;
  int contact_count_ = 0;
  int near_count_ = 0;
};

} // namespace eccentra::cluster
