// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs another program from a test: what it printed, how it ended, how long it took.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eccentra::test {

struct ProgramResult {
  int status = 0;         ///< exit status, or -1 if a signal ended it
  int signal = 0;         ///< the signal that ended it, or 0
  bool timed_out = false; ///< it was killed, with all its children, after the time allowed
  double seconds = 0;     ///< wall time
  std::string output;     ///< standard output and standard error, as they came
};

struct ProgramOptions {
  std::filesystem::path directory = ".";
  std::vector<std::string> environment; ///< "NAME=VALUE", beside the environment of the test
  double timeout = 60;                  ///< seconds
};

/// Standard input is empty. Throws std::runtime_error if no process can be started; a missing program gives status 127.
ProgramResult run_program(const std::vector<std::string>& words, const ProgramOptions& options = {});

/// An empty folder `name` in the working folder of the test.
std::filesystem::path fresh_folder(const std::string& name);

/// Writes a text file; throws std::runtime_error if that fails.
void write_file(const std::filesystem::path& path, const std::string& text);

/// A variable of the environment that ctest sets; throws std::runtime_error with its name if it is missing.
std::string required_environment(const char* name);

/// The value of LD_PRELOAD that brings libeccentra (after the sanitizer's library, in a sanitized build) into a
/// program.
std::string preload_of_eccentra();

} // namespace eccentra::test
