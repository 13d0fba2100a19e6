// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A checksum behind the last byte that LIGGGHTS reads of a restart file: a file with bodies that was damaged or cut
// short is refused before any of it is used.
#pragma once

#include <string>

namespace eccentra::styles {

/// Appends the seal to a whole file, or replaces the one that it has. Returns false if the disk does not take it.
bool seal_restart_file(const std::string& path);

/// Empty if the seal fits, or if the file has none and holds no clusters of the present format; else a clause that says
/// what is wrong with it.
std::string seal_problem(const std::string& path);

} // namespace eccentra::styles
