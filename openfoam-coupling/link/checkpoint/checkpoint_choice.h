// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the checkpoint from which a run goes on: the newest that is complete on both sides.
#pragma once

#include "link/checkpoint/durable_files.h"

#include <functional>
#include <string>
#include <vector>

namespace eccentra::link {

/// Folder of the DEM side's checkpoints, in the script's working folder; each in a folder named by its step.
extern const char* const kCheckpoints;
/// The DEM side's restart file in it.
extern const char* const kDemFile;
/// The part of the fluid of step N is the folder `kFluidPrefix`N; the file with the suffix `kFluidRecord` marks a
/// complete one.
extern const char* const kFluidPrefix;
extern const char* const kFluidRecord;

/// The checkpoint from which both sides go on.
struct CheckpointChoice {
  CheckpointMark mark;                  ///< step -1: none is complete
  std::string restart_file = "none";    ///< for read_restart
  Notes notes;                          ///< of the DEM side's manifest
  std::vector<std::string> passed_over; ///< one sentence per newer one that is not complete

  /// True if there are checkpoints and none of them is complete.
  bool none_is_whole() const { return mark.step < 0 && !passed_over.empty(); }
};

/// The DEM side's file of this checkpoint, or "none".
std::string restart_file_of(const CheckpointMark& mark);

/// Arguments for LIGGGHTS's command line that set the variables `resumes` (0 or 1) and `checkpoint` (a file).
std::vector<std::string> script_variables(const CheckpointChoice& choice);

/// Examines the checkpoints of the DEM side from the newest on. `fluid_part` receives the manifest and returns whether
/// the part of the fluid is complete, too, and if not, the reason.
CheckpointChoice newest_checkpoint(const std::function<bool(const Manifest&, std::string&)>& fluid_part);

/// For link socket: the part of the fluid counts as complete if its record is on another machine. Otherwise it is
/// checked at the place that the fluid side has stated.
bool fluid_record_is_whole(const Manifest& dem, std::string& why);

} // namespace eccentra::link
