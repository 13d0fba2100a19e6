// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The command `resumable`: a run that goes on from a checkpoint reads the same script again. Commands that make or
// change particles, and runs that the checkpoint has behind it, are left out; all others set up what the checkpoint
// does not keep.
#pragma once

#include "link/checkpoint/checkpoint_choice.h"

#include <cstdint>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

/// Steps of one `run` of the script.
struct RunSpan {
  std::int64_t first, last;
};

/// Call before the script is read if -resume was given; the same on all ranks. Step -1: there is no checkpoint.
void resume_from(const link::CheckpointChoice& choice);

/// -resume was given.
bool asked_to_resume();

/// The step of the checkpoint that -resume has chosen and the script has read; else -1.
std::int64_t resumed_step();

/// That checkpoint is one of DEM without a fluid.
bool resumes_alone();

/// The run that is about to begin goes on with the forces of the checkpoint. False where the checkpoint fell on the
/// last step of a run: the straight run has then computed the forces anew, in the set-up of its next run.
bool forces_carry_on();

/// The script writes checkpoints.
bool keeps_checkpoints(LAMMPS_NS::LAMMPS* lmp);

/// The runs that the script has begun, the present one included.
std::vector<RunSpan> runs_so_far();

/// Whether `command` is dealt with here, instead of by LIGGGHTS.
bool stands_in_for(LAMMPS_NS::LAMMPS* lmp, const char* command, int narg, char** arg);

/// What a command of LIGGGHTS needs behind it. `command` and its first arguments as they were before it.
void after(LAMMPS_NS::LAMMPS* lmp, const std::string& command, const std::vector<std::string>& arguments);

} // namespace eccentra::styles
