// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How libeccentra enters LIGGGHTS: by the launcher, by preloading, and not at all into another version.
#include "support/granular_script.h"
#include "support/program_output.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <elf.h>

#include <cstring>
#include <regex>

namespace {

using namespace eccentra::test;

const std::string minimal_script =
    granular_box("0 1 0 1 0 1", "p p p") + granular_material({}, "0.01") + sphere_contacts() + R"(timestep 1e-5
create_atoms 1 single 0.5 0.5 0.9 units box
set group all diameter 0.01 density 2500
fix integrate all nve/sphere
run 10
)";

std::string launcher() {
  return program("eccentra-dem");
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++found;
  return found;
}

TEST(Launcher, HelpNamesStylesAndVersions) {
  const ProgramResult help = run_program({launcher(), "-h"});
  EXPECT_EQ(help.status, 0);
  EXPECT_TRUE(std::regex_search(help.output, std::regex(R"(eccentra-dem \d+\.\d+\.\d+ for LIGGGHTS-PUBLIC 3\.8\.0)")))
      << help.output;
  EXPECT_EQ(run_program({launcher(), "--version"}).output, help.output);
}

TEST(Launcher, EveryListedFixIsKnownToLiggghts) {
  const ProgramResult help = run_program({launcher(), "-h"});
  const std::regex fix_line(R"(\n  fix +(\S+))");
  int fixes = 0;
  for (std::sregex_iterator match(help.output.begin(), help.output.end(), fix_line), end; match != end; ++match) {
    ++fixes;
    const std::string style = match->str(1);
    const auto folder = fresh_folder("listed");
    write_file(folder / "in.x", minimal_script + "fix probe all " + style + "\nrun 1\n");
    const ProgramResult run = run_program({launcher(), "-in", "in.x", "-log", "none"}, {folder, {}, 20});
    EXPECT_EQ(run.output.find("Invalid fix style"), std::string::npos) << style << "\n" << run.output;
    EXPECT_EQ(run.signal, 0) << style << "\n" << run.output;
  }
  RecordProperty("fixes", fixes);
  // What LIGGGHTS says of a style that nobody knows: without it the loop above could not fail.
  const auto folder = fresh_folder("unlisted");
  write_file(folder / "in.x", minimal_script + "fix probe all no/such/style\nrun 1\n");
  const ProgramResult run = run_program({launcher(), "-in", "in.x", "-log", "none"}, {folder, {}, 20});
  EXPECT_NE(run.output.find("Invalid fix style"), std::string::npos) << run.output;
}

/// Open MPI 4: programs without a launcher share a session folder, which the first to end removes while others make it.
TEST(Launcher, AloneSharesNoFolderOfMpi) {
  const auto folder = fresh_folder("alone");
  write_file(folder / "in.x", minimal_script + "shell ls -R . > seen.txt\nshell env > environment.txt\n");
  const ProgramResult run =
      run_program({launcher(), "-in", "in.x", "-log", "none"}, {folder, {"TMPDIR=" + folder.string()}, 30});
  EXPECT_EQ(run.status, 0) << run.output;
  const std::string seen = contents(folder / "seen.txt");
  EXPECT_NE(seen.find("in.x"), std::string::npos) << seen;
  EXPECT_EQ(seen.find("jf.0/1:"), std::string::npos) << seen; // those of Open MPI 5 have a number of their own
  const std::string environment = contents(folder / "environment.txt");
  EXPECT_NE(environment.find("TMPDIR="), std::string::npos) << environment;
  EXPECT_EQ(environment.find("create_session_dirs"), std::string::npos) << environment;
}

TEST(Preload, StockProgramRunsWithTheLibrary) {
  const auto folder = fresh_folder("preload");
  write_file(folder / "in.x", minimal_script);
  const std::string preload = "LD_PRELOAD=" + preload_of_eccentra();
  const ProgramResult run = run_program({"liggghts", "-in", "in.x", "-log", "none"}, {folder, {preload}, 30});
  EXPECT_EQ(run.status, 0) << run.output;
  // And it is the library that answers: a fix of ours is known to the stock program only when it is loaded.
  write_file(folder / "in.y", minimal_script + "fix probe all timestep/limit every 10\nrun 1\n");
  const ProgramResult with = run_program({"liggghts", "-in", "in.y", "-log", "none"}, {folder, {preload}, 30});
  const ProgramResult without = run_program({"liggghts", "-in", "in.y", "-log", "none"}, {folder, {}, 30});
  EXPECT_EQ(with.output.find("Invalid fix style"), std::string::npos) << with.output;
  EXPECT_NE(without.output.find("Invalid fix style"), std::string::npos) << without.output;
}

TEST(Preload, WorksUnderMpirun) {
  const auto folder = fresh_folder("preload-mpirun");
  write_file(folder / "in.x", minimal_script);
  const ProgramResult run =
      run_program({"mpirun", "--oversubscribe", "--bind-to", "none", "-np", "2", "-x",
                   "LD_PRELOAD=" + preload_of_eccentra(), "liggghts", "-in", "in.x", "-log", "none"},
                  {folder, {}, 60});
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_NE(run.output.find("Loop time"), std::string::npos) << run.output;
}

/// libeccentra_other_version.so: the same entry code, told at build time that it was built against 9.9.9.
TEST(VersionGuard, RefusesAnotherLiggghtsWithOneSentence) {
  const auto folder = fresh_folder("guard");
  write_file(folder / "in.x", minimal_script);
  std::string preload = preload_of_eccentra();
  preload.replace(preload.rfind('/') + 1, std::string::npos, "libeccentra_other_version.so");
  const ProgramResult run =
      run_program({"liggghts", "-in", "in.x", "-log", "none"}, {folder, {"LD_PRELOAD=" + preload}, 30});
  EXPECT_NE(run.status, 0) << run.output;
  EXPECT_EQ(run.signal, 0) << run.output;
  EXPECT_EQ(count(run.output, "ERROR"), 1) << run.output;
  EXPECT_EQ(count(run.output, "built against LIGGGHTS-PUBLIC 9.9.9"), 1) << run.output;
  EXPECT_NE(run.output.find("scripts/setup"), std::string::npos) << "the sentence names the remedy\n" << run.output;
  EXPECT_EQ(run.output.find("Loop time"), std::string::npos) << "it must not run\n" << run.output;
}

/// The library with its calls bound inside itself, as -Bsymbolic does.
std::string bound_to_itself(std::string library) {
  const auto at = [&library](auto kind, std::size_t offset) {
    std::memcpy(&kind, &library.at(offset), sizeof kind);
    return kind;
  };
  const auto header = at(Elf64_Ehdr{}, 0);
  for (int part = 0; part < header.e_phnum; ++part) {
    const auto program = at(Elf64_Phdr{}, header.e_phoff + part * sizeof(Elf64_Phdr));
    if (program.p_type != PT_DYNAMIC)
      continue;
    for (auto offset = program.p_offset; offset < program.p_offset + program.p_filesz; offset += sizeof(Elf64_Dyn)) {
      auto entry = at(Elf64_Dyn{}, offset);
      if (entry.d_tag != DT_FLAGS)
        continue;
      entry.d_un.d_val |= DF_SYMBOLIC;
      std::memcpy(&library.at(offset), &entry, sizeof entry);
      return library;
    }
  }
  throw std::runtime_error("the library has no DT_FLAGS");
}

// There our definitions are never reached: every check of ours would be passed over in silence.
TEST(Preload, ALibraryThatCallsItselfIsRefused) {
  const auto folder = fresh_folder("symbolic");
  write_file(folder / "in.x", minimal_script);
  const std::string linked = run_program({"ldd", launcher()}).output;
  std::smatch path;
  ASSERT_TRUE(std::regex_search(linked, path, std::regex(R"((libliggghts\S*) => (\S+))"))) << linked;
  write_file(folder / path.str(1), bound_to_itself(contents(path.str(2))));
  for (const std::vector<std::string>& program : {std::vector<std::string>{"liggghts"}, {launcher()}}) {
    std::vector<std::string> command = program;
    command.insert(command.end(), {"-in", "in.x", "-log", "none"});
    const ProgramResult run = run_program(
        command, {folder, {"LD_LIBRARY_PATH=" + folder.string(), "LD_PRELOAD=" + preload_of_eccentra()}, 30});
    EXPECT_NE(run.status, 0) << run.output;
    EXPECT_EQ(count(run.output, "-Bsymbolic-functions"), 1) << run.output;
    EXPECT_NE(run.output.find("scripts/setup --liggghts"), std::string::npos) << run.output;
    EXPECT_EQ(run.output.find("Loop time"), std::string::npos) << "it must not run\n" << run.output;
  }
}

} // namespace
