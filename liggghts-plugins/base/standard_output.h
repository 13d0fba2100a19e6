// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a tool prints arrives, or the tool fails: a full disk is seen when the buffer is written.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace eccentra {

/// Writes what standard output still holds. Throws std::runtime_error with one sentence if that, or a write before,
/// failed. Call it last, where its exception still ends in the tool's own error message and exit code.
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
