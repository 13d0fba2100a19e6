// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Load balance of the ranks of the DEM side over the coupling steps of a run.
#pragma once

#include "link/fluid_peer.h"

#include <string>

namespace eccentra::link {

/// Adds up how evenly the ranks of DEM were loaded in a run.
class LoadSums {
 public:
  /// Counts the coupling interval that ends with this coupling step.
  void add(const CouplingStep& coupling_step);
  /// One line with a line end: ranks; fullest and busiest rank over the mean. Empty before the first interval.
  std::string table() const;
  /// Of DEM.
  std::int64_t ranks() const { return ranks_; }

 private:
  int intervals_ = 0;
  std::int64_t ranks_ = 1;
  double particles_ = 0, max_particles_ = 0; ///< sums over the intervals of the mean and of the most of any rank
  double seconds_ = 0, max_seconds_ = 0;     ///< as above, of the time that a rank computed [s]
  double wall_ = 0;                          ///< [s]
};

} // namespace eccentra::link
