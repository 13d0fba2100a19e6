// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Xvfb as a child process that says on a pipe which display it serves.
#include "shape/vtk/virtual_display.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr int start_timeout = 15000; ///< [ms]

/// Becomes Xvfb, which writes its display number to `pipe_end`. Returns only if that fails.
void become_server(int pipe_end) {
  // If we are killed, the server shall not stay.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const std::string number = std::to_string(pipe_end);
  // -noreset: without it the server starts anew when its last window closes, and refuses the window that comes next.
  execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-noreset", "-screen", "0", "64x64x24", "-nolisten", "tcp",
         static_cast<char*>(nullptr));
}

/// Display number that the server reports, empty if it ended or took too long.
std::string read_display(int pipe_end) {
  std::string text;
  pollfd ready{pipe_end, POLLIN, 0};
  while (poll(&ready, 1, start_timeout) > 0) {
    char c = 0;
    if (read(pipe_end, &c, 1) <= 0)
      return {};
    if (c == '\n')
      return text;
    text += c;
  }
  return {};
}

} // namespace

VirtualDisplay::VirtualDisplay() {
  if (const char* display = std::getenv("DISPLAY")) {
    had_display_ = true;
    display_before_ = display;
  }
  int ends[2];
  if (pipe(ends) != 0)
    throw std::invalid_argument("cannot open a pipe to Xvfb: too many open files");
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  server_ = fork();
  if (server_ == 0) {
    become_server(ends[1]);
    _exit(127);
  }
  close(ends[1]);
  const std::string number = server_ > 0 ? read_display(ends[0]) : std::string();
  close(ends[0]);
  if (!number.empty()) {
    setenv("DISPLAY", (":" + number).c_str(), 1);
    return;
  }
  if (server_ > 0) {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
    server_ = -1;
  }
  if (!had_display_)
    throw std::invalid_argument("a picture needs the program Xvfb, which did not start: install the package xvfb");
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ <= 0)
    return;
  kill(server_, SIGTERM);
  while (waitpid(server_, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (had_display_)
    setenv("DISPLAY", display_before_.c_str(), 1);
  else
    unsetenv("DISPLAY");
}

} // namespace eccentra::shape
