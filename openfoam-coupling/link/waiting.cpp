// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One counter per process.
#include "link/waiting.h"

namespace eccentra::link {

double& waiting_seconds() {
  static double seconds = 0;
  return seconds;
}

} // namespace eccentra::link
