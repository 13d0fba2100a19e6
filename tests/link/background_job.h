// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A program beside the test: started, signalled, waited for.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace eccentra::test {

/// Ends with the test at the latest.
class BackgroundJob {
 public:
  /// Runs `arguments` in `folder`; what it prints goes to `log` there.
  BackgroundJob(const std::string& folder, const std::vector<std::string>& words, const std::string& log)
      : log_(folder + '/' + log) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
      arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ != 0)
      return;
    const int out = open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (chdir(folder.c_str()) == 0 && out >= 0 && dup2(out, 1) >= 0 && dup2(out, 2) >= 0)
      execvp(arguments[0], arguments.data());
    _exit(127);
  }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;
  ~BackgroundJob() {
    if (!running_)
      return;
    signal(SIGKILL);
    waitpid(process_, nullptr, 0);
  }

  void signal(int number) const { kill(process_, number); }
  pid_t id() const { return process_; }

  /// Exit code, 128 + signal, or -1 if it still runs after `seconds`.
  int wait(double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (running_ && std::chrono::steady_clock::now() < end) {
      int status = 0;
      if (waitpid(process_, &status, WNOHANG) == process_) {
        running_ = false;
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    }
    return code_;
  }

  /// No file that it writes may grow beyond this: a disk that is full.
  void limit_files(rlim_t bytes) const {
    const rlimit limit = {bytes, bytes};
    prlimit(process_, RLIMIT_FSIZE, &limit, nullptr);
  }

  /// The exit code so far, as wait() has it.
  int code() const { return code_; }

  /// One of its child processes, or -1.
  int child(int number = 0) const {
    const std::string id = std::to_string(process_);
    std::ifstream in("/proc/" + id + "/task/" + id + "/children");
    for (int process = -1; in >> process; --number)
      if (number == 0)
        return process;
    return -1;
  }

  std::string text() const {
    std::ifstream in(log_);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// True once it has printed `part`.
  bool says(const std::string& part, double seconds) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (text().find(part) == std::string::npos) {
      if (std::chrono::steady_clock::now() > end)
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
  }

 private:
  std::string log_;
  pid_t process_ = -1;
  bool running_ = true;
  int code_ = -1;
};

} // namespace eccentra::test
