// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes and reads key files.
#include "link/socket/keys.h"

#include "link/terms.h"

#include <zmq.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>

namespace eccentra::link {
namespace {

constexpr std::size_t kCharacters = 40;
constexpr std::size_t kBytes = 32;
const char* const kRemedy = ": make keys with eccentra-keys FOLDER and give both sides a copy of that folder";

void write_key(const std::string& path, const std::string& key, mode_t mode) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0)
    throw Refusal("cannot make the key file '" + path + "' (" + std::strerror(errno) +
                  "): take a folder without keys that you may write to");
  const std::string line = key + '\n';
  const bool written = ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  if (::close(file) != 0 || !written)
    throw Refusal("cannot write the key file '" + path + "': make room");
}

std::string read_key(const std::string& path) {
  std::string key;
  std::ifstream in(path);
  if (!in)
    throw Refusal("the key file '" + path + "' cannot be read" + kRemedy);
  in >> key;
  std::array<std::uint8_t, kBytes> bytes{};
  if (key.size() != kCharacters || zmq_z85_decode(bytes.data(), key.c_str()) == nullptr)
    throw Refusal("the file '" + path + "' holds no key" + kRemedy);
  return key;
}

} // namespace

void make_keys(const std::string& folder) {
  if (folder.empty())
    throw Refusal("the name of the folder for the keys is empty; expected a folder: is a variable unset?");
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  for (const char* side : {"dem", "fluid"}) {
    std::array<char, kCharacters + 1> open_half{}, secret_half{};
    if (zmq_curve_keypair(open_half.data(), secret_half.data()) != 0)
      throw Refusal("this ZeroMQ has no CURVE: install one that was built with libsodium");
    const std::string path = folder + '/' + side;
    write_key(path + ".secret", secret_half.data(), S_IRUSR | S_IWUSR);
    write_key(path + ".public", open_half.data(), S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
  }
}

Keys read_keys(const std::string& folder, const std::string& own, const std::string& peer) {
  const std::string secret = folder + '/' + own + ".secret";
  struct stat status {};
  if (stat(secret.c_str(), &status) == 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw Refusal("others may read the key file '" + secret + "': chmod 600 it, or make new keys if they have");
  return {read_key(folder + '/' + own + ".public"), read_key(secret), read_key(folder + '/' + peer + ".public")};
}

} // namespace eccentra::link
