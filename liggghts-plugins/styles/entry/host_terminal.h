// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The terminal of a solver that hosts LIGGGHTS and keeps LIGGGHTS's own screen from it.
#pragma once

#include <cstdio>

namespace eccentra::styles {

/// Standard output where a solver hosts LIGGGHTS, else null: for what a user must see. Rank 0 writes.
std::FILE* host_terminal();

} // namespace eccentra::styles
