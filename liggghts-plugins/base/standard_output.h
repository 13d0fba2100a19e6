// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a tool fail if its output cannot be written, for example to a full disk.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace eccentra {

/// Flushes the standard output. Throws std::runtime_error with one sentence if this or an earlier write failed. Call it
/// last, where the exception still leads to the error message and the exit code of the tool.
inline void finish_standard_output() {
  const bool failed_before = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed_before)
    return;
  throw std::runtime_error("standard output cannot be written" +
                           (errno != 0 ? " (" + std::string(std::strerror(errno)) + ")" : std::string()) +
                           ": make room, or send it elsewhere");
}

} // namespace eccentra
