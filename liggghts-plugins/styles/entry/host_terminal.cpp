// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Knows whether a solver hosts LIGGGHTS.
#include "styles/entry/host_terminal.h"

#include "link/fluid_peer.h"

namespace eccentra::styles {

std::FILE* host_terminal() {
  return link::hosting_solver() ? stdout : nullptr;
}

} // namespace eccentra::styles
