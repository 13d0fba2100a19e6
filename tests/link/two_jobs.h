// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of two jobs share: their arguments, where they meet, how long a fault may take to be noticed.
#pragma once

#include "link/background_job.h"
#include "link/checkpoint/durable_files.h"
#include "support/read_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::test {

/// Seconds that a fault may take to be noticed, and that starting and ending a program may take besides.
constexpr double kNotice = 5.0;
constexpr double kStart = 60.0;

/// Unix sockets have short names only.
inline std::string socket_address(const std::string& name) {
  return "ipc://" +
         (std::filesystem::temp_directory_path() / ("eccentra-" + std::to_string(getpid()) + "-" + name)).string();
}

inline std::vector<std::string> command(const std::string& program, const std::vector<std::string>& arguments,
                                        int ranks) {
  std::vector<std::string> all;
  if (ranks > 1)
    all = {"mpirun", "--oversubscribe", "--bind-to", "none", "-np", std::to_string(ranks)};
  all.push_back(std::string(std::getenv("ECCENTRA_BIN")) + '/' + program);
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

inline void replace_in(const std::string& file, const std::string& part, const std::string& by) {
  std::string text = contents(file);
  const auto at = text.find(part);
  if (at == std::string::npos)
    throw std::runtime_error("'" + part + "' is not in " + file);
  std::ofstream(file) << text.replace(at, part.size(), by);
}

} // namespace eccentra::test
