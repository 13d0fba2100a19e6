// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// An X server without a screen, for VTK as Debian builds it, which renders nowhere else.
#pragma once

#include <sys/types.h>

namespace eccentra::report {

/// Starts Xvfb on a free display, with no open network port, and sets DISPLAY to it; stops it at the end of its life.
/// Throws std::runtime_error with one sentence if Xvfb is not installed or does not start.
class OffScreenDisplay {
 public:
  OffScreenDisplay();
  ~OffScreenDisplay();
  OffScreenDisplay(const OffScreenDisplay&) = delete;
  OffScreenDisplay& operator=(const OffScreenDisplay&) = delete;

 private:
  pid_t server_ = -1;
};

} // namespace eccentra::report
