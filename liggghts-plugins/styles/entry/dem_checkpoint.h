// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes checkpoints/STEP of the script's working folder, and says when one is due by the clock.
#pragma once

#include "link/checkpoint/durable_files.h"

#include <cstdint>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

/// A name for a new checkpoint at the present step. Collective.
link::CheckpointMark new_mark(LAMMPS_NS::LAMMPS* lmp);

/// Writes LIGGGHTS's restart file with all that the next step depends on, and which runs of the script it belongs to;
/// keeps the two newest. Call at the end of a step in which neighbours were listed anew. Collective; throws
/// link::Refusal on every rank.
void write_dem_checkpoint(LAMMPS_NS::LAMMPS* lmp, const link::CheckpointMark& mark, link::Notes notes = {});

/// Before a run writes anything: a run that begins (`step` -1) keeps the checkpoints of a finished run beside and
/// refuses where one was interrupted; a run that goes on from `step` keeps newer ones beside. Collective; throws
/// link::Refusal.
void make_room_for_checkpoints(LAMMPS_NS::LAMMPS* lmp, std::int64_t step);

/// Checkpoints as often as costs one per cent of the time.
class CheckpointClock {
 public:
  CheckpointClock();
  bool due() const;
  /// One was written, in so many seconds of wall-clock time.
  void written(double seconds);

 private:
  double last_;
  double cost_ = 0;
};

} // namespace eccentra::styles
