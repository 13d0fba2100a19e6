// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sums the loads of meetings.
#include "link/load_sums.h"

#include <cstdio>

namespace eccentra::link {

void LoadSums::add(const Meeting& meeting) {
  if (!(meeting.elapsed > 0))
    return;
  ++intervals_;
  ranks_ = meeting.load.ranks;
  particles_ += double(meeting.totals.particles) / double(ranks_);
  most_particles_ += double(meeting.load.most_particles);
  seconds_ += meeting.load.mean_seconds;
  most_seconds_ += meeting.load.most_seconds;
  wall_ += meeting.dem_seconds;
}

std::string LoadSums::table() const {
  if (intervals_ == 0)
    return "";
  char line[256];
  std::snprintf(
      line, sizeof line,
      "load of %lld rank(s) of DEM in %d intervals, fullest or busiest over mean: particles %.3f, computing %.3f "
      "(mean %.3f s of %.3f s)\n",
      static_cast<long long>(ranks_), intervals_, particles_ > 0 ? most_particles_ / particles_ : 1.0,
      seconds_ > 0 ? most_seconds_ / seconds_ : 1.0, seconds_, wall_);
  return line;
}

} // namespace eccentra::link
