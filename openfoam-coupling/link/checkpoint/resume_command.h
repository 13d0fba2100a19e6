// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The command line with which an interrupted run goes on, for the sentences that end a run.
#pragma once

#include <string>

namespace eccentra::link {

/// Call first in main.
void remember_command(int argc, const char* const* argv);

/// The environment's ECCENTRA_RESUME_COMMAND (set by eccentra-run), else the remembered command with -resume.
std::string resume_command();

/// As one word of a shell.
std::string shell_word(const std::string& text);

} // namespace eccentra::link
