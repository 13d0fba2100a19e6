// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which checkpoint a run goes on from: the newest that is whole on both sides.
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
/// The fluid's half of step N is the folder `kFluidPrefix`N; `kFluidRecord` behind that names the record of a whole
/// one.
extern const char* const kFluidPrefix;
extern const char* const kFluidRecord;

struct CheckpointChoice {
  CheckpointMark mark;                  ///< step -1: none is whole
  std::string restart_file = "none";    ///< for read_restart
  Notes notes;                          ///< of the DEM side's manifest
  std::vector<std::string> passed_over; ///< one sentence per newer one that is not whole

  /// There are checkpoints, and none of them is whole.
  bool none_is_whole() const { return mark.step < 0 && !passed_over.empty(); }
};

/// The DEM side's file of this checkpoint, or "none".
std::string restart_file_of(const CheckpointMark& mark);

/// The arguments that tell a script, for LIGGGHTS's command line: variables `resumes` (0 or 1) and `checkpoint` (a
/// file).
std::vector<std::string> script_variables(const CheckpointChoice& choice);

/// Looks at the DEM side's checkpoints from the newest on. `fluid_part`, which gets the manifest, says whether the
/// fluid's half is whole, too, and if not, why.
CheckpointChoice newest_checkpoint(const std::function<bool(const Manifest&, std::string&)>& fluid_part);

/// For a DEM side of its own: the fluid's half counts as whole if its record is on another machine, and is looked up
/// where the fluid side said that it is otherwise.
bool fluid_record_is_whole(const Manifest& dem, std::string& why);

} // namespace eccentra::link
