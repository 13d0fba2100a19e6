// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Starts the programs of a run and the cases' own `run`, and waits for what they write.
#pragma once

#include "support/program_output.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace eccentra::test {

namespace fs = std::filesystem;

constexpr double kLong = 100; ///< [s], on a busy machine

inline std::vector<std::string> annulus_foam(const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {program("annulusFoam")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

inline ProgramResult start(const fs::path& folder, const std::vector<std::string>& arguments) {
  ProgramOptions options;
  options.directory = folder;
  options.timeout = kLong;
  return run_program(arguments, options);
}

template <class Condition> bool wait_until(const Condition& condition, double seconds = kLong) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

inline std::size_t rows_of(const fs::path& folder) {
  const std::string text = contents(folder / "postProcessing/eccentra/coupling.csv");
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

inline std::vector<std::string> case_run(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {required_environment("ECCENTRA_CASES") + '/' + name + "/run", "--bin",
                                        required_environment("ECCENTRA_BIN")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Some seconds of a case.
inline std::vector<std::string> short_section(const std::string& output, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"--output", output, "--seconds", "0.2",    "--run-in", "5", "--report", "1",
                                        "--length", "0.06", "--cells",   "6 24 4", "--count",  "60"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

inline void replace_in(const fs::path& file, const std::string& part, const std::string& by) {
  std::string text = contents(file);
  const std::size_t at = text.find(part);
  ASSERT_NE(at, std::string::npos) << "'" << part << "' is not in " << file;
  write_file(file, text.replace(at, part.size(), by));
}

} // namespace eccentra::test
