// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements run_program.h with fork, exec and poll.
#include "support/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace eccentra::test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A build with sanitizers is slower: tests/CMakeLists.txt says how much longer a program may take.
double timeout_factor() {
  const char* factor = std::getenv("ECCENTRA_TIMEOUT_FACTOR");
  return factor != nullptr ? std::strtod(factor, nullptr) : 1.0;
}

[[noreturn]] void become(const std::vector<std::string>& words, const ProgramOptions& options, int output) {
  constexpr int not_found = 127; // as shells do
  setpgid(0, 0);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0 ||
      dup2(output, STDERR_FILENO) < 0 || chdir(options.directory.c_str()) != 0)
    _exit(not_found);
  for (const std::string& setting : options.environment) {
    const auto equals = setting.find('=');
    setenv(setting.substr(0, equals).c_str(), setting.substr(equals + 1).c_str(), 1);
  }
  std::vector<char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(not_found);
}

} // namespace

ProgramResult run_program(const std::vector<std::string>& words, const ProgramOptions& options) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe for " + words.at(0));
  const double allowed = options.timeout * timeout_factor();
  const auto start = Clock::now();
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error("no process for " + words.at(0));
  if (child == 0)
    become(words, options, ends[1]);
  close(ends[1]);

  ProgramResult result;
  std::array<char, 4096> buffer{};
  int wait_status = 0;
  bool ended = false;
  bool open_end = true;
  while (open_end || !ended) {
    constexpr int tick = 50; // milliseconds between looks at the clock
    pollfd waited = {ends[0], POLLIN, 0};
    if (open_end && poll(&waited, 1, tick) > 0) {
      const ssize_t count = read(ends[0], buffer.data(), buffer.size());
      if (count > 0)
        result.output.append(buffer.data(), static_cast<std::size_t>(count));
      else if (count == 0)
        open_end = false;
    }
    if (!ended && waitpid(child, &wait_status, open_end ? WNOHANG : 0) == child)
      ended = true;
    // A daemon left behind may hold the pipe open: stop listening once the program itself has ended and is silent.
    if (ended && open_end) {
      waited.revents = 0;
      if (poll(&waited, 1, tick) == 0)
        open_end = false;
    }
    if (!result.timed_out && seconds_since(start) > allowed) {
      result.timed_out = true;
      kill(-child, SIGKILL);
    }
  }
  close(ends[0]);
  kill(-child, SIGKILL); // whatever it left behind in its group
  result.seconds = seconds_since(start);
  if (WIFSIGNALED(wait_status)) {
    result.status = -1;
    result.signal = WTERMSIG(wait_status);
  } else {
    result.status = WEXITSTATUS(wait_status);
  }
  return result;
}

std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::current_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream stream(path);
  stream << text;
  stream.close();
  if (!stream)
    throw std::runtime_error("cannot write " + path.string());
}

std::string required_environment(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr)
    throw std::runtime_error(std::string("the environment lacks ") + name + ": run the tests with ctest");
  return value;
}

std::string preload_of_eccentra() {
  const char* sanitizer = std::getenv("ECCENTRA_SANITIZER_LIBRARY");
  const std::string before = sanitizer != nullptr && *sanitizer != '\0' ? std::string(sanitizer) + ":" : std::string();
  return before + required_environment("ECCENTRA_LIB") + "/libeccentra.so";
}

} // namespace eccentra::test
