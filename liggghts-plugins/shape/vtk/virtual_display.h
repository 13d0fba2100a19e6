// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// An invisible X server for the time in which a picture is drawn.
#pragma once

#include <sys/types.h>

#include <string>

namespace eccentra::shape {

/// Starts Xvfb on a free display and points DISPLAY at it; the destructor ends it and restores DISPLAY. If Xvfb is
/// not installed, a DISPLAY that is set is used. Without either the constructor throws std::invalid_argument.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  pid_t server_ = -1;
  bool had_display_ = false;
  std::string display_before_;
};

} // namespace eccentra::shape
