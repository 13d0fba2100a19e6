// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C, SIGTERM and a batch system's warning end a coupled run in order: at the next coupling step, with a
// checkpoint.
#pragma once

namespace eccentra::link {

/// From now on SIGINT, SIGTERM and SIGUSR1 are remembered instead of ending the process. If the run has not ended
/// `patience` seconds after the first one, the process ends with one sentence and a non-zero code.
void catch_stop_signals(const char* program, unsigned patience = 4);

/// The first signal that has come, or 0.
int stop_signal();

/// SIGTERM and its like, by name.
const char* name_of_signal(int number);

} // namespace eccentra::link
