// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A run as one file for ParaView.
#pragma once

#include "report/case_data.h"

namespace eccentra::report {

/// Writes NAME.pvd into `folder`, and what it names into the folder NAME beside it: at the time in seconds of each file
/// of particles the blocks `bodies` (true surfaces), `particles` (points), `walls` (by the ids of their fixes) and
/// `fluid` (the fields that were written next to that time). What a run does not have is left out. Returns the path of
/// NAME.pvd. Throws std::runtime_error if a file cannot be written.
std::filesystem::path write_paraview(const Case& data, const std::filesystem::path& folder);

} // namespace eccentra::report
