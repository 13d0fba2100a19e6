// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS with our styles inside another program, on the same ranks. No LIGGGHTS types, no OpenFOAM types.
#pragma once

#include "link/checkpoint/checkpoint_choice.h"

#include <optional>
#include <string>

namespace eccentra {

/// Executes a LIGGGHTS input script on all ranks of MPI_COMM_WORLD (MPI is running). Its log goes to `log`, its screen
/// output nowhere. Where the script is wrong LIGGGHTS ends the process; the sentence that it wrote to the log then
/// appears on standard error. `resumes`: with -resume, what the script goes on from.
void run_dem_script(const std::string& script, const std::string& log,
                    const std::optional<link::CheckpointChoice>& resumes);

} // namespace eccentra
