// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing that an earlier run has written is lost to a later one.
#pragma once

#include <cstdint>
#include <string>

namespace eccentra::link {

/// Gives a file or folder the first free name PATH.before-1, PATH.before-2, ... and returns it. Throws Refusal.
std::string keep_beside(const std::string& path);

enum class Side { dem, fluid };

/// Call before a run writes anything. `folder`: that has the folder of checkpoints. A run that begins (`step` -1) keeps
/// those of a finished run beside, and throws Refusal where a run was interrupted, unless it was `asked_to_resume`
/// and found nothing to resume from. A run that goes on from `step` keeps newer ones beside, with the table of the
/// run. The DEM side comes first and moves both halves; the fluid side looks after its own. Returns one sentence if
/// anything was moved, else an empty string.
std::string make_room_for_checkpoints(const std::string& folder, Side side, std::int64_t step, bool asked_to_resume);

/// The run in `folder` has come to its end: what it wrote may be kept beside by the next one. Throws Refusal.
void mark_finished(const std::string& folder);

} // namespace eccentra::link
