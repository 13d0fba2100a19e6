// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The one place of a process where the hosting solver and the plug-ins find each other.
#include "link/fluid_peer.h"

namespace eccentra::link {

FluidPeer*& hosting_solver() {
  static FluidPeer* peer = nullptr;
  return peer;
}

} // namespace eccentra::link
