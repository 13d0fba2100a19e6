// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements off_screen_display.h.
#include "report/off_screen_display.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace eccentra::report {

OffScreenDisplay::OffScreenDisplay() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0)
    throw std::runtime_error("pictures need Xvfb, and no pipe to it could be made");
  server_ = fork();
  if (server_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM); // it must not outlive us, however we end
    close(ends[0]);
    const int nothing = open("/dev/null", O_RDWR);
    if (nothing < 0 || dup2(nothing, STDOUT_FILENO) < 0 || dup2(nothing, STDERR_FILENO) < 0)
      _exit(1);
    const std::string descriptor = std::to_string(ends[1]);
    execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1600x1200x24", "-nolisten", "tcp",
           nullptr);
    _exit(1);
  }
  close(ends[1]);
  std::string number;
  constexpr int patience = 20000; // milliseconds
  pollfd waited = {ends[0], POLLIN, 0};
  char character = 0;
  while (server_ > 0 && poll(&waited, 1, patience) > 0 && read(ends[0], &character, 1) == 1 && character != '\n')
    number += character;
  close(ends[0]);
  if (number.empty())
    throw std::runtime_error(
        "pictures need Xvfb, which did not start: install the Debian package xvfb (scripts/setup does)");
  setenv("DISPLAY", (":" + number).c_str(), 1);
}

OffScreenDisplay::~OffScreenDisplay() {
  if (server_ > 0) {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
}

} // namespace eccentra::report
