// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the two sides of a socket link meet.
#pragma once

#include <string>

namespace eccentra::link {

/// How long the link waits [s].
struct Patience {
  double silence = 5.0; ///< until a peer that does not answer any more counts as lost
  double arrival = 5.0; ///< until a peer that has not come yet counts as missing
};

/// The endpoint that `words` names: ipc:///path, a plain path, or tcp://host:port with a host of this machine. Throws
/// Refusal with one sentence for anything else; addresses that other machines reach need keys, which are not there.
std::string endpoint_of(const std::string& words);

/// Throws Refusal unless both times are positive and finite.
void check(const Patience& patience);

} // namespace eccentra::link
