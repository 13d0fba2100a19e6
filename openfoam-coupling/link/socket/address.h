// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The address of a socket link.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace eccentra::link {

/// Timeouts of the link [s].
struct Timeout {
  double silence = 5.0; ///< without an answer until a peer counts as lost
  double arrival = 5.0; ///< until a peer that has not connected counts as missing
};

/// Address and keys.
struct Address {
  std::string arguments; ///< ipc:///path, a plain path, or tcp://host:port
  std::string keys;      ///< folder of the keys (link/keys.h); empty: none
  /// Of a rank connection beside that address (link/rank connections.h): of a Unix socket the end of its path, else its
  /// port in place of the other (0: one that the system chooses). Negative: the address itself.
  int connection = -1;

  /// From `arguments` and `keys`. Words alone are an address.
  Address(std::string w, std::string k = "") : arguments(std::move(w)), keys(std::move(k)) {}
  Address(const char* w) : arguments(w) {}
  /// Of rank connection `number` beside the main address.
  Address(const Address& beside, std::uint32_t number)
      : arguments(beside.arguments), keys(beside.keys), connection(static_cast<int>(number)) {}
};

/// The endpoint that the arguments name. Throws Refusal with one sentence for anything else, and for an address that
/// other machines reach if there are no keys.
std::string endpoint_of(const Address& address);

/// True if only programs of this machine reach it (a Unix socket or loopback). For an address that endpoint_of accepts.
bool is_of_this_machine(const Address& address);

/// Throws Refusal unless both times are positive and finite.
void check(const Timeout& patience);

} // namespace eccentra::link
