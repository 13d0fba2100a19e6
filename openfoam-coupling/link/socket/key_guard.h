// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Authentication of the keys of a ZeroMQ socket (RFC 27/ZAP).
#pragma once

#include <memory>
#include <string>

namespace zmq {
class context_t;
}

namespace eccentra::link {

/// Admits only the owner of one public key to the sockets of a context. Answers in a thread of its own, so that a peer
/// can connect while this side computes. Must be constructed before the sockets bind and destroyed before the context.
class KeyGuard {
 public:
  /// Allows this public key (Z85) and no other.
  KeyGuard(zmq::context_t& context, const std::string& allowed_public);
  KeyGuard(const KeyGuard&) = delete;
  KeyGuard& operator=(const KeyGuard&) = delete;
  ~KeyGuard();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace eccentra::link
