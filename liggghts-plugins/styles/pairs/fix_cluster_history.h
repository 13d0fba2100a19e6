// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential history of sub-contacts while atoms migrate and in restart files; any number per body.
#pragma once

#include <mpi.h>

#include "fix.h"

#include <functional>
#include <vector>

namespace eccentra::styles {

/// One sub-contact of a body with a partner, seen from the body with the lower tag.
struct Touch {
  int partner; ///< tag of the other body
  int id;      ///< contact_id of the sub-spheres
  double displacement[3];
};

/// Fix style "cluster/history", made by pair_style gran/cluster (users never type it). While a run goes on the pair
/// style holds the history in its own arrays; before atoms move between ranks or into a file it hands all of it over,
/// to both bodies of each pair, and takes it back when it next meets the pair.
/// Output: scalar f_cluster_history: sub-contacts between bodies in the last step; f_cluster_history[1]: pairs of
/// bodies with sub-spheres close to each other. A pair that two ranks share counts on both.
class FixClusterHistory : public LAMMPS_NS::Fix {
 public:
  static constexpr const char* fix_id = "cluster_history";
  static constexpr const char* style_name = "cluster/history";

  FixClusterHistory(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixClusterHistory() override;

  /// The scene's instance, or null where pair_style gran/cluster has made none.
  static FixClusterHistory* find(LAMMPS_NS::LAMMPS* lmp);
  static FixClusterHistory& require(LAMMPS_NS::LAMMPS* lmp);

  /// Called before touches(i) must be right for every local atom; the pair style fills it in. The argument tells
  /// whether the pairs stay valid afterwards (no atom moves).
  std::function<void(bool keep)> hand_over;
  std::vector<Touch>& touches(int i) { return touches_[i]; }
  /// What contact models of LIGGGHTS's own remember beside: `width` values per touch of atom i, one touch after the
  /// other.
  std::vector<double>& more(int i) { return more_[i]; }
  /// The pair style's counts on this rank: sub-contacts and pairs of bodies with sub-spheres close to each other.
  int contact_count = 0, near_pair_count = 0;

  int setmask() override;
  void post_create() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void post_run() override;
  void grow_arrays(int nmax) override;
  void copy_arrays(int i, int j, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buf) override;
  int unpack_exchange(int i, double* buf) override;
  int pack_restart(int i, double* buf) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  void write_restart(FILE* fp) override;
  void restart(char* buf) override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  double memory_usage() override;

 private:
  /// Doubles of the longest record of an atom of this rank.
  int largest_record();

  std::vector<std::vector<Touch>> touches_;
  std::vector<std::vector<double>> more_;
};

} // namespace eccentra::styles
