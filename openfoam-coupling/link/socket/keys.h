// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of the socket link (CURVE: Curve25519, as ZeroMQ has it): they authenticate the
// two sides and encrypt the connection.
#pragma once

#include <string>

namespace eccentra::link {

/// Keys as ZeroMQ writes them: 40 characters of Z85.
struct Keys {
  /// Both keys of this side, and the public one of the other.
  std::string own_public, own_secret, peer_public;
};

/// Writes dem.public, dem.secret, fluid.public and fluid.secret into `folder`, which is made if it does not exist;
/// only their owner can read the secrets. Throws Refusal if any of them exists already or cannot be written.
void make_keys(const std::string& folder);

/// The keys of one side: `own`.secret, `own`.public and `peer`.public of `folder`. Throws Refusal if one is missing,
/// is not a key, or is a secret that others may read.
Keys read_keys(const std::string& folder, const std::string& own, const std::string& peer);

} // namespace eccentra::link
