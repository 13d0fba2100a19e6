// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped cases as they are, each killed at random moments by SIGKILL, SIGINT and SIGTERM, and each time told to go
// on.
#include "link/background_job.h"
#include "reported/programs_of_a_run.h"
#include "reported/table_of_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <thread>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr double kWholeRun = 2500; ///< [s]
constexpr int kKillsOfEach = 4;

struct Interrupted {
  std::string name;
  std::vector<std::string> begin, go_on; ///< commands
};

/// Kills the run in `folder`, wherever its programs are.
void kill_all(const fs::path& folder, int number, const BackgroundJob& job) {
  if (number != SIGKILL) {
    job.signal(number);
    return;
  }
  for (const fs::directory_entry& process : fs::directory_iterator("/proc")) {
    const std::string id = process.path().filename();
    std::error_code gone;
    if (id.find_first_not_of("0123456789") != std::string::npos ||
        fs::read_symlink(process.path() / "cwd", gone) != folder)
      continue;
    const std::string command = contents(process.path() / "comm");
    if (command == "annulusFoam\n" || command == "eccentra-dem\n")
      kill(std::stoi(id), SIGKILL);
  }
}

/// The files that a run leaves, beside the clock's, must be those of `whole`.
void expect_same(const fs::path& whole, const fs::path& parts) {
  int compared = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(whole)) {
    const fs::path file = fs::relative(entry.path(), whole);
    const std::string name = file.filename(), extension = file.extension(), top = *file.begin();
    const bool field =
        top.find_first_not_of("0123456789.") == std::string::npos && file.parent_path().filename() != "uniform";
    if (!entry.is_regular_file() || !(field || extension == ".vtk" || extension == ".vtp"))
      continue;
    EXPECT_EQ(contents(whole / file) == contents(parts / file), true) << file;
    ++compared;
  }
  EXPECT_GT(compared, 3);
  EXPECT_EQ(physics_of_table(parts / "postProcessing/eccentra/coupling.csv"),
            physics_of_table(whole / "postProcessing/eccentra/coupling.csv"));
}

std::mt19937& random_numbers() {
  static std::mt19937 random(std::random_device{}());
  return random;
}

/// The straight run, then one that is killed; `folders`: of both, where their programs run.
void interrupt(const Interrupted& whole, const Interrupted& parts, const fs::path& of_whole, const fs::path& of_parts) {
  const auto begun = std::chrono::steady_clock::now();
  {
    fs::create_directories(whole.name);
    BackgroundJob job(whole.name, whole.begin, "log");
    ASSERT_EQ(job.wait(kWholeRun), 0) << job.text();
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  std::uniform_real_distribution<double> moment(0.05 * seconds, 0.4 * seconds);
  fs::create_directories(parts.name);
  const int numbers[] = {SIGKILL, SIGINT, SIGKILL, SIGTERM};
  for (int kill = 0; kill < kKillsOfEach; ++kill) {
    BackgroundJob job(parts.name, fs::exists(of_parts) ? parts.go_on : parts.begin, "log");
    const double after = moment(random_numbers());
    const int ended = job.wait(after);
    kill_all(of_parts, numbers[kill], job);
    const int code = job.wait(kWholeRun);
    std::cout << parts.name << ": signal " << numbers[kill] << " after " << after << " s of " << seconds << ", exit "
              << code << (ended != -1 ? " (had ended)" : "") << std::endl;
    ASSERT_NE(code, -1);
  }
  BackgroundJob job(parts.name, parts.go_on, "log");
  ASSERT_EQ(job.wait(kWholeRun), 0) << job.text();
  expect_same(of_whole, of_parts);
}

bool left_out(const std::string& label) {
  const char* const only = std::getenv("ECCENTRA_KILLS_ONLY");
  return only && only != label;
}

void interrupt_case(const std::string& label, const std::string& name, std::vector<std::string> more) {
  if (left_out(label))
    return;
  if (const char* const seconds = std::getenv("ECCENTRA_KILLS_SECONDS"))
    more.insert(more.end(), {"--seconds", seconds});
  const auto begin = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return case_run(name, arguments);
  };
  const fs::path here = fs::absolute(fresh_folder(label));
  interrupt({here / "w", begin({"--output", here / "whole"}), {}},
            {here / "p", begin({"--output", here / "parts"}), case_run(name, {"--resume", here / "parts"})},
            here / "whole", here / "parts");
}

} // namespace

// In the environment: ECCENTRA_KILLS_SECONDS, of shorter runs of the cases; ECCENTRA_KILLS_ONLY, one of the names
// below.
TEST(Reported, twenty_kills_on_the_shipped_cases) {
  interrupt_case("section", "tomren-section", {});
  interrupt_case("section_socket", "tomren-section", {"--link", "socket", "--shape", "cube 8"});
  interrupt_case("injection", "tomren-injection", {});
  interrupt_case("injection_ranks", "tomren-injection", {"--ranks", "2", "--balance", "64"});
  // DEM alone.
  if (left_out("heap"))
    return;
  const fs::path here = fs::absolute(fresh_folder("heap"));
  const std::string script = contents(fs::path(required_environment("ECCENTRA_CASES")) / "heap/in.heap");
  const std::vector<std::string> arguments = {program("eccentra-dem"), "-in", "in.heap"};
  std::vector<std::string> again = arguments;
  again.emplace_back("-resume");
  for (const char* part : {"whole", "parts"}) {
    fs::create_directories(here / part);
    write_file(here / part / "in.heap", script);
  }
  interrupt({here / "whole", arguments, {}}, {here / "parts", arguments, again}, here / "whole", here / "parts");
}
