// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the files of an earlier run when a later one begins in the same folder.
#pragma once

#include <cstdint>
#include <string>

namespace eccentra::link {

/// Gives a file or folder the first free name PATH.before-1, PATH.before-2, ... and returns it. Throws Refusal.
std::string keep_beside(const std::string& path);

/// Whose part of a checkpoint.
enum class Side { dem, fluid };

/// Call before a run writes anything. `folder` contains the folder of checkpoints. A run that begins (`step` -1)
/// renames the checkpoints of a finished run. It throws Refusal if the earlier run was interrupted, unless it was
/// `asked_to_resume` and there is no checkpoint. A run that goes on from `step` renames newer checkpoints, with the
/// table of the run. The DEM side acts first and moves both parts, the fluid side only its own. Returns one sentence if
/// anything was moved, else an empty string.
std::string make_room_for_checkpoints(const std::string& folder, Side side, std::int64_t step, bool asked_to_resume);

/// Marks the run in `folder` as finished, so that the next run may rename its files. Throws Refusal.
void mark_finished(const std::string& folder);

} // namespace eccentra::link
