// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tells ZeroMQ whose key may join (its authentication protocol, RFC 27/ZAP).
#pragma once

#include <memory>
#include <string>

namespace zmq {
class context_t;
}

namespace eccentra::link {

/// Admits the owner of one public key to the sockets of a context, and nobody else. Answers in a thread of its own, so
/// that a side that computes can still be joined. Must be there before the sockets bind, and go before the context.
class KeyGuard {
 public:
  KeyGuard(zmq::context_t& context, const std::string& allowed_public);
  KeyGuard(const KeyGuard&) = delete;
  KeyGuard& operator=(const KeyGuard&) = delete;
  ~KeyGuard();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace eccentra::link
