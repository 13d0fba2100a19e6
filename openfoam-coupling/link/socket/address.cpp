// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads addresses of the socket link.
#include "link/socket/address.h"

#include "link/terms.h"

#include <sys/un.h>

#include <cmath>
#include <cstdlib>

namespace eccentra::link {
namespace {

constexpr long kMostPort = 65535;
/// Longest wait that still fits the library's milliseconds [s].
constexpr double kLongest = 1e6;

bool starts_with(const std::string& text, const std::string& part) {
  return text.compare(0, part.size(), part) == 0;
}

[[noreturn]] void refuse(const std::string& words, const std::string& why) {
  throw Refusal("address '" + words + "' " + why);
}

std::string unix_path(const std::string& words, std::string path, int lane) {
  if (path.empty() || path[0] == '@')
    refuse(words, "has no path: give ipc:///folder/name");
  if (lane >= 0)
    path += '.' + std::to_string(lane);
  if (path.size() >= sizeof(sockaddr_un::sun_path))
    refuse(words, "is longer than the " + std::to_string(sizeof(sockaddr_un::sun_path) - 1) +
                      " characters that a Unix socket may have: take a shorter path");
  return "ipc://" + path;
}

/// 127.0.0.0/8 in full.
bool is_loopback(const std::string& host) {
  if (host == "[::1]")
    return true;
  int numbers = 0;
  const char* at = host.c_str();
  for (; numbers < 4; ++numbers) {
    char* end = nullptr;
    if (*at < '0' || *at > '9')
      return false;
    const long part = std::strtol(at, &end, 10);
    if (part > 255 || (numbers == 0 && part != 127))
      return false;
    at = end;
    if (numbers < 3 && *at++ != '.')
      return false;
  }
  return *at == '\0';
}

std::string tcp(const std::string& words, const std::string& rest, bool keys, int lane) {
  const auto colon = rest.rfind(':');
  if (colon == std::string::npos || colon == 0)
    refuse(words, "lacks a host or a port: give tcp://127.0.0.1:PORT");
  std::string host = rest.substr(0, colon);
  const std::string port = rest.substr(colon + 1);
  char* end = nullptr;
  const long number = std::strtol(port.c_str(), &end, 10);
  if (port.empty() || port[0] < '0' || port[0] > '9' || *end || number < 1 || number > kMostPort)
    refuse(words, "has no port from 1 to " + std::to_string(kMostPort) + ": give tcp://127.0.0.1:PORT");
  if (host == "localhost")
    host = "127.0.0.1";
  if (host.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:[]*") !=
      std::string::npos)
    refuse(words, "has a host with strange characters: give a name or a number, such as tcp://10.0.0.1:5555");
  if (!is_loopback(host) && !keys)
    refuse(words,
           "can be reached from other machines, which needs keys on both sides: make them with eccentra-keys FOLDER "
           "and name the folder after the word keys, or use ipc:///path or tcp://127.0.0.1:PORT");
  return "tcp://" + host + ':' + (lane == 0 ? "*" : std::to_string(lane < 0 ? number : lane));
}

} // namespace

std::string endpoint_of(const Address& address) {
  const std::string& words = address.words;
  if (starts_with(words, "ipc://"))
    return unix_path(words, words.substr(6), address.lane);
  if (starts_with(words, "tcp://"))
    return tcp(words, words.substr(6), !address.keys.empty(), address.lane);
  if (words.find("://") != std::string::npos)
    refuse(words, "is neither ipc:///path nor tcp://host:port");
  return unix_path(words, words, address.lane);
}

bool is_of_this_machine(const Address& address) {
  const std::string endpoint = endpoint_of(address), tcp = "tcp://";
  if (!starts_with(endpoint, tcp))
    return true;
  return is_loopback(endpoint.substr(tcp.size(), endpoint.rfind(':') - tcp.size()));
}

void check(const Patience& patience) {
  for (const double seconds : {patience.silence, patience.arrival})
    if (!(seconds > 0) || seconds > kLongest)
      throw Refusal("timeout and wait must be positive numbers of seconds below a million");
}

} // namespace eccentra::link
