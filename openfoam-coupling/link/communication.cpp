// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One set of counters per process.
#include "link/communication.h"

namespace eccentra::link {

Communication& communication() {
  static Communication counters;
  return counters;
}

} // namespace eccentra::link
