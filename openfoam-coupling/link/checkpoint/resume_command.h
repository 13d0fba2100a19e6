// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The command line that continues an interrupted run, for the messages at its end.
#pragma once

#include <string>

namespace eccentra::link {

/// Stores the command line. Call first in main.
void remember_command(int argc, const char* const* argv);

/// The value of ECCENTRA_RESUME_COMMAND (set by eccentra-run), else the stored command with -resume.
std::string resume_command();

/// `text` quoted as one word of a shell.
std::string shell_word(const std::string& text);

} // namespace eccentra::link
