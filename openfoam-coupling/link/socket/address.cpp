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

[[noreturn]] void refuse(const std::string& arguments, const std::string& why) {
  throw Refusal("address '" + arguments + "' " + why);
}

std::string unix_path(const std::string& arguments, std::string path, int connection) {
  if (path.empty() || path[0] == '@')
    refuse(arguments, "has no path: give ipc:///folder/name");
  if (connection >= 0)
    path += '.' + std::to_string(connection);
  if (path.size() >= sizeof(sockaddr_un::sun_path))
    refuse(arguments, "is longer than the " + std::to_string(sizeof(sockaddr_un::sun_path) - 1) +
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

std::string tcp(const std::string& arguments, const std::string& rest, bool keys, int connection) {
  const auto colon = rest.rfind(':');
  if (colon == std::string::npos || colon == 0)
    refuse(arguments, "lacks a host or a port: give tcp://127.0.0.1:PORT");
  std::string host = rest.substr(0, colon);
  const std::string port = rest.substr(colon + 1);
  char* end = nullptr;
  const long number = std::strtol(port.c_str(), &end, 10);
  if (port.empty() || port[0] < '0' || port[0] > '9' || *end || number < 1 || number > kMostPort)
    refuse(arguments, "has no port from 1 to " + std::to_string(kMostPort) + ": give tcp://127.0.0.1:PORT");
  if (host == "localhost")
    host = "127.0.0.1";
  if (host.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:[]*") !=
      std::string::npos)
    refuse(arguments, "has a host with strange characters: give a name or a number, such as tcp://10.0.0.1:5555");
  if (!is_loopback(host) && !keys)
    refuse(arguments,
           "can be reached from other machines, which needs keys on both sides: make them with eccentra-keys FOLDER "
           "and name the folder after the word keys, or use ipc:///path or tcp://127.0.0.1:PORT");
  return "tcp://" + host + ':' + (connection == 0 ? "*" : std::to_string(connection < 0 ? number : connection));
}

} // namespace

std::string endpoint_of(const Address& address) {
  const std::string& arguments = address.arguments;
  if (starts_with(arguments, "ipc://"))
    return unix_path(arguments, arguments.substr(6), address.connection);
  if (starts_with(arguments, "tcp://"))
    return tcp(arguments, arguments.substr(6), !address.keys.empty(), address.connection);
  if (arguments.find("://") != std::string::npos)
    refuse(arguments, "is neither ipc:///path nor tcp://host:port");
  return unix_path(arguments, arguments, address.connection);
}

bool is_of_this_machine(const Address& address) {
  const std::string endpoint = endpoint_of(address), tcp = "tcp://";
  if (!starts_with(endpoint, tcp))
    return true;
  return is_loopback(endpoint.substr(tcp.size(), endpoint.rfind(':') - tcp.size()));
}

void check(const Timeout& patience) {
  for (const double seconds : {patience.silence, patience.arrival})
    if (!(seconds > 0) || seconds > kLongest)
      throw Refusal("timeout and wait must be positive numbers of seconds below a million");
}

} // namespace eccentra::link
