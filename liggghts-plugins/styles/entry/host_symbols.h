// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the host's library reaches our definitions of its functions.
#pragma once

#include <string>
#include <vector>

namespace eccentra::styles {

/// Those of the functions (mangled names) that the library which defines `inside` calls past every other library, so
/// that a definition in front of its own is never reached: a library linked with -Bsymbolic or -Bsymbolic-functions, as
/// Ubuntu's are. Linux, ELF, 64 bits. Empty where the library cannot be found or read.
std::vector<std::string> bound_inside(const void* inside, const std::vector<std::string>& functions);

} // namespace eccentra::styles
