// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C, SIGTERM and the warning of a batch system end a coupled run at the next coupling step, with a checkpoint.
#pragma once

namespace eccentra::link {

/// From now on SIGINT, SIGTERM and SIGUSR1 are stored instead of ending the process. If the run has not ended
/// `patience` seconds after the first signal, the process ends with one sentence and a non-zero code.
void catch_stop_signals(const char* program, unsigned patience = 4);

/// The first signal received, or 0.
int stop_signal();

/// Name of a signal, such as SIGTERM.
const char* name_of_signal(int number);

} // namespace eccentra::link
