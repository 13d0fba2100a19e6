// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Signal handlers: only what is allowed in them.
#include "link/stop_signal.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace eccentra::link {
namespace {

volatile std::sig_atomic_t g_received = 0;
unsigned g_timeout = 0;
char g_late[512];

void remember(int number) {
  if (g_received != 0)
    return;
  g_received = number;
  alarm(g_timeout);
}

void too_late(int) {
  (void)!write(STDERR_FILENO, g_late, std::strlen(g_late));
  _exit(EXIT_FAILURE);
}

} // namespace

void catch_stop_signals(const char* program, unsigned patience) {
  g_timeout = patience;
  std::strncpy(g_late, program, sizeof g_late / 4);
  std::strncat(g_late,
               ": error: a signal asked this run to stop but no coupling step came in time to write a "
               "checkpoint: start again with -resume from the last complete one, or signal earlier\n",
               sizeof g_late / 2);
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGUSR1})
    sigaction(number, &action, nullptr);
  // A file that may not grow further is told to whoever writes it.
  std::signal(SIGXFSZ, SIG_IGN);
  action.sa_handler = too_late;
  sigaction(SIGALRM, &action, nullptr);
}

int stop_signal() {
  return g_received;
}

const char* name_of_signal(int number) {
  switch (number) {
  case SIGINT:
    return "SIGINT";
  case SIGTERM:
    return "SIGTERM";
  case SIGUSR1:
    return "SIGUSR1";
  default:
    return "a signal";
  }
}

} // namespace eccentra::link
