// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sums the loads of coupling steps.
#include "link/load_sums.h"

#include <cstdio>

namespace eccentra::link {

void LoadSums::add(const CouplingStep& coupling_step) {
  if (!(coupling_step.elapsed > 0))
    return;
  ++intervals_;
  ranks_ = coupling_step.load.ranks;
  particles_ += double(coupling_step.totals.particles) / double(ranks_);
  max_particles_ += double(coupling_step.load.max_particles);
  seconds_ += coupling_step.load.mean_seconds;
  max_seconds_ += coupling_step.load.max_seconds;
  wall_ += coupling_step.dem_seconds;
}

std::string LoadSums::table() const {
  if (intervals_ == 0)
    return "";
  char line[256];
  std::snprintf(
      line, sizeof line,
      "load of %lld rank(s) of DEM in %d intervals, fullest or busiest over mean: particles %.3f, computing %.3f "
      "(mean %.3f s of %.3f s)\n",
      static_cast<long long>(ranks_), intervals_, particles_ > 0 ? max_particles_ / particles_ : 1.0,
      seconds_ > 0 ? max_seconds_ / seconds_ : 1.0, seconds_, wall_);
  return line;
}

} // namespace eccentra::link
