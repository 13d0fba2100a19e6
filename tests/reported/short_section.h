// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A short section of cases/tomren-section, changed on one side alone, and what its programs say.
#pragma once

#include "reported/programs_of_a_run.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <string>
#include <utility>
#include <vector>

namespace eccentra::test {

namespace fs = std::filesystem;

inline std::vector<std::string> with_ranks(int ranks, std::vector<std::string> arguments) {
  if (ranks > 1) {
    const std::vector<std::string> launch = {
        "mpirun", "--oversubscribe",    "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
        "-np",    std::to_string(ranks)};
    arguments.insert(arguments.begin(), launch.begin(), launch.end());
  }
  return arguments;
}

inline std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

struct Change {
  std::string what, file, part, by;
};

/// The section, 0.06 m long, with 20 cuttings and a run of two fluid steps.
class Section {
 public:
  explicit Section(const std::string& name, const std::vector<Change>& changes = {}) : folder_(fresh_folder(name)) {
    const fs::path source = fs::path(required_environment("ECCENTRA_CASES")) / "tomren-section";
    for (const char* part : {"0", "constant", "system", "in.cuttings"})
      fs::copy(source / part, folder_ / part, fs::copy_options::recursive);
    fs::create_directories(folder_ / "postProcessing/eccentra");
    replace_in(folder_ / "system/annulusMeshDict", "length          0.3", "length          0.06");
    replace_in(folder_ / "system/annulusMeshDict", "(8 32 20)", "(6 24 4)");
    replace_in(folder_ / "constant/couplingProperties", "steps 100", "steps 2");
    replace_in(folder_ / "in.cuttings", "length       index 0.3", "length       index 0.06");
    replace_in(folder_ / "in.cuttings", "count        index 1212", "count        index 20");
    replace_in(folder_ / "in.cuttings", "seconds      index 3.0", "seconds      index 0.01");
    for (const Change& change : changes)
      if (!change.file.empty())
        replace_in(folder_ / change.file, change.part, change.by);
  }

  const fs::path& folder() const { return folder_; }

  void mesh(int ranks = 1) {
    const ProgramResult made = run_program({program("annulusMesh")}, {folder_, {}, 60});
    ASSERT_EQ(made.status, 0) << made.output;
    if (ranks == 1)
      return;
    const std::string n = std::to_string(ranks);
    write_file(folder_ / "system/decomposeParDict",
               "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
               "numberOfSubdomains " +
                   n + "; method simple; simpleCoeffs { n (1 1 " + n + "); delta 0.001; }\n");
    const ProgramResult parts = run_program({"decomposePar"}, {folder_, {}, 60});
    ASSERT_EQ(parts.status, 0) << parts.output;
  }

  ProgramResult solve(int ranks = 1, std::vector<std::string> environment = {}) const {
    std::vector<std::string> arguments = {program("annulusFoam")};
    if (ranks > 1)
      arguments.emplace_back("-parallel");
    return run_program(with_ranks(ranks, arguments), {folder_, std::move(environment), 150});
  }

  ProgramResult run(int ranks = 1) {
    mesh(ranks);
    return solve(ranks);
  }

  /// Over a Unix socket: what both sides print.
  std::pair<ProgramResult, ProgramResult> run_apart(int ranks, const std::string& address) {
    use_socket(address);
    mesh(ranks);
    auto fluid = std::async(std::launch::async, [&] { return solve(ranks); });
    // An error of the script comes early: the fluid side shall be there.
    const fs::path socket = address.substr(address.find("//") + 2);
    while (!fs::exists(socket) && fluid.wait_for(std::chrono::milliseconds(20)) == std::future_status::timeout)
      continue;
    const ProgramResult dem = particles(ranks);
    return {fluid.get(), dem};
  }

  void use_socket(const std::string& address) {
    replace_in(folder_ / "in.cuttings", "link solver every", "link socket " + address + " wait 60 every");
    replace_in(folder_ / "constant/couplingProperties", "link            solver;",
               "link            socket;\naddress         \"" + address + "\";\nwait            60;");
  }

  ProgramResult particles(int ranks) const {
    return run_program(with_ranks(ranks, {program("eccentra-dem"), "-in", "in.cuttings", "-log", "log.liggghts"}),
                       {folder_, {}, 150});
  }

 private:
  fs::path folder_;
};

inline std::string socket_path(const std::string& name) {
  return "ipc://" + (fs::temp_directory_path() / ("ecc-geo-" + std::to_string(getpid()) + "-" + name)).string();
}

inline void expect_refused(const ProgramResult& result, const std::vector<std::string>& parts,
                           const std::string& what) {
  EXPECT_NE(result.status, 0) << what << "\n" << result.output;
  for (const std::string& part : parts)
    EXPECT_TRUE(holds(result.output, part)) << what << ": '" << part << "' is not in\n" << result.output;
}

/// Files of the section that tests change, and a line of the script.
inline constexpr const char* kScript = "in.cuttings";
inline constexpr const char* kMesh = "system/annulusMeshDict";
inline constexpr const char* kU = "0/U";
inline constexpr const char* kRun = "run             ${steps}";

} // namespace eccentra::test
