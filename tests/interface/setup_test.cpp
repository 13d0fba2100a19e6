// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// scripts/setup on machines that lack something: one sentence each, nothing half done, nothing done twice.
#include "support/read_file.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

/// A copy of the script in a clone of its own, with commands in front of the system's that play a broken machine.
class Setup : public testing::Test {
 protected:
  void SetUp() override {
    folder = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder / "scripts");
    fs::copy_file(required_environment("ECCENTRA_SOURCE") + "/scripts/setup", folder / "scripts/setup");
    fs::copy_file(required_environment("ECCENTRA_SOURCE") + "/CMakePresets.json", folder / "CMakePresets.json");
    put_in_front("sudo", "while [ $# -gt 0 ]; do case $1 in -n) shift;; *) break;; esac; done; exec \"$@\"");
  }

  void put_in_front(const std::string& command, const std::string& script) {
    write_file(folder / "front" / command, "#!/bin/bash\n" + script + "\n");
    fs::permissions(folder / "front" / command, fs::perms::owner_all);
  }

  void headers_are_there() {
    const ProgramResult version = run_program({"dpkg-query", "-W", "-f", "${source:Version}", "libopenfoam"});
    write_file(folder / "build/openfoam-headers/version", version.output + "\n");
    for (const char* library : {"OpenFOAM", "OSspecific/POSIX", "finiteVolume", "meshTools", "transportModels",
                                "TurbulenceModels/turbulenceModels", "TurbulenceModels/incompressible",
                                "TurbulenceModels/phaseIncompressible"})
      fs::create_directories(folder / "build/openfoam-headers" / library / "lnInclude");
  }

  ProgramResult setup(std::vector<std::string> options, std::vector<std::string> environment = {}) {
    environment.push_back("PATH=" + (folder / "front").string() + ":" + required_environment("PATH"));
    options.insert(options.begin(), (folder / "scripts/setup").string());
    return run_program(options, {folder, environment, 60});
  }

  /// Fails, with exactly one line that starts as an error and holds every word.
  static void expect_one_sentence(const ProgramResult& run, const std::vector<std::string>& arguments) {
    EXPECT_EQ(run.status, 1) << run.output;
    std::string error;
    std::size_t errors = 0;
    for (std::size_t start = 0; start < run.output.size();) {
      const auto end = std::min(run.output.find('\n', start), run.output.size());
      const std::string line = run.output.substr(start, end - start);
      if (line.rfind("setup: error: ", 0) == 0) {
        error = line;
        ++errors;
      } else {
        EXPECT_EQ(line.rfind("setup: ", 0), 0U) << "noise beside the sentence: " << line;
      }
      start = end + 1;
    }
    EXPECT_EQ(errors, 1U) << run.output;
    for (const std::string& word : arguments)
      EXPECT_NE(error.find(word), std::string::npos) << "'" << word << "' is missing in: " << error;
  }

  fs::path folder;
};

TEST_F(Setup, SecondRunAsksAptForNothing) {
  headers_are_there();
  put_in_front("apt-get", "echo \"$@\" >>'" + (folder / "apt-calls").string() + "'; exit 100");
  const ProgramResult run = setup({"--packages-only"});
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_FALSE(fs::exists(folder / "apt-calls"));
  EXPECT_EQ(run.output, "");
}

TEST_F(Setup, AnotherDistribution) {
  write_file(folder / "os-release", "ID=fedora\nVERSION_ID=41\n");
  expect_one_sentence(setup({}, {"ECCENTRA_OS_RELEASE=" + (folder / "os-release").string()}),
                      {"fedora 41", "Debian 12", "Debian 13", "Ubuntu 24.04", "container"});
  expect_one_sentence(setup({}, {"ECCENTRA_OS_RELEASE=/nowhere"}), {"unknown", "Debian 12"});
}

// Ubuntu's archive has a name and a keyring of its own.
TEST_F(Setup, Ubuntu) {
  write_file(folder / "os-release", "ID=ubuntu\nVERSION_ID=\"24.04\"\n");
  put_in_front("apt-get", "case $* in *indextargets*) echo 'Ubuntu|http://archive.example/ubuntu|noble|universe'; "
                          "echo 'Debian|http://archive.example/debian|bookworm|main'; exit 0;; esac; "
                          "cp ../sources.list '" +
                              folder.string() + "/'; echo 'E: Could not resolve host'; exit 100");
  const ProgramResult run = setup({"--packages-only"}, {"ECCENTRA_OS_RELEASE=" + (folder / "os-release").string()});
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_NE(run.output.find("expected to work"), std::string::npos) << run.output;
  EXPECT_EQ(contents(folder / "sources.list"), "deb-src [signed-by=/usr/share/keyrings/ubuntu-archive-keyring.gpg] "
                                               "http://archive.example/ubuntu noble universe\n");
}

TEST_F(Setup, PackagesWithoutNetwork) {
  headers_are_there();
  put_in_front("dpkg-query", "/usr/bin/dpkg-query \"$@\" | grep -v '^liggghts-doc '");
  put_in_front("apt-get", "echo 'W: Failed to fetch'; echo 'E: Unable to locate package liggghts-doc'; exit 100");
  expect_one_sentence(setup({"--packages-only"}),
                      {"packages could not be installed", "Unable to locate", "network", "log"});
}

TEST_F(Setup, HeadersWithoutNetwork) {
  put_in_front(
      "apt-get",
      "case $* in *indextargets*) exec /usr/bin/apt-get \"$@\";; esac; echo 'E: Could not resolve host'; exit 100");
  expect_one_sentence(setup({"--packages-only"}), {"openfoam=", "Could not resolve host", "network"});
  EXPECT_FALSE(fs::exists(folder / "build/openfoam-headers")) << "half-made headers would be taken for whole ones";
}

TEST_F(Setup, NoDebianArchive) {
  put_in_front("apt-get", "case $* in *indextargets*) exit 0;; esac; exit 100");
  expect_one_sentence(setup({"--packages-only"}), {"Debian archive", "apt-get update"});
}

TEST_F(Setup, UnknownWords) {
  expect_one_sentence(setup({"--preset", "fast"}), {"'fast'", "release, portable or sanitize"});
  expect_one_sentence(setup({"--fast"}), {"'--fast'", "--help"});
  expect_one_sentence(setup({"--preset"}), {"--preset"});
  EXPECT_EQ(setup({"--help"}).status, 0);
}

// Hosts of one's own: what they must bring is asked for before anything is installed.
TEST_F(Setup, HostsBuiltFromSource) {
  expect_one_sentence(setup({"--openfoam"}, {"WM_PROJECT_DIR=", "FOAM_LIBBIN="}),
                      {"--openfoam", "WM_PROJECT_DIR", "etc/bashrc"});
  expect_one_sentence(setup({"--openfoam"}, {"WM_PROJECT_DIR=/nowhere", "FOAM_LIBBIN=/nowhere"}),
                      {"'/nowhere'", "api-info", "lnInclude"});
  expect_one_sentence(setup({"--liggghts", "/nowhere"}), {"'/nowhere'", "src/lammps.h"});
  expect_one_sentence(setup({"--liggghts"}), {"--liggghts", "folder"});
}

// Its folder has lists of its own models beside the header that includes them: ours must be read, with the models of
// this library.
TEST_F(Setup, ListsOfModelsOfALiggghtsBuiltFromSource) {
  const fs::path source = folder / "liggghts/src";
  fs::create_directories(source);
  for (const auto& header : fs::directory_iterator(required_environment("ECCENTRA_LIGGGHTS_HEADERS")))
    if (header.path().extension() == ".h" && header.path().filename().string().rfind("style_", 0) != 0)
      fs::copy_file(header.path(), source / header.path().filename());
  for (const char* kind : {"surface", "normal", "tangential", "cohesion", "rolling"})
    write_file(source / ("style_" + std::string(kind) + "_model.h"), "#error a list of LIGGGHTS's own\n");
  fs::create_symlink(required_environment("ECCENTRA_LIGGGHTS_LIBRARY"), source / "liblmp_auto.so");
  fs::create_symlink(required_environment("ECCENTRA_LIGGGHTS_PROGRAM"), source / "lmp_auto");
  const ProgramResult made =
      run_program({"cmake", "-G", "Ninja", "-S", required_environment("ECCENTRA_SOURCE"), "-B", (folder / "b").string(),
                   "-DECCENTRA_LIGGGHTS_DIR=" + (folder / "liggghts").string(), "-DECCENTRA_OPENFOAM=OFF",
                   "-DECCENTRA_TESTS=OFF", "-DECCENTRA_UNITS=OFF", "-DECCENTRA_PRECOMPILE=OFF"},
                  {folder, {}, 120});
  ASSERT_EQ(made.status, 0) << made.output;
  const ProgramResult compiled = run_program(
      {"python3", "-c",
       "import json, subprocess, sys\n"
       "line = next(e for e in json.load(open('b/compile_commands.json')) if "
       "e['file'].endswith('/hertz_history_shape.cpp'))\n"
       "sys.exit(subprocess.call(line['command'] + ' -fsyntax-only', shell=True, cwd=line['directory']))\n"},
      {folder, {}, 120});
  EXPECT_EQ(compiled.status, 0) << compiled.output;
}

TEST_F(Setup, HeadersOfAnotherVersionAreRefused) {
  fs::create_directories(folder / "headers/TurbulenceModels/phaseIncompressible/lnInclude");
  write_file(folder / "headers/version", "1906.191111-1\n");
  const ProgramResult run =
      run_program({"cmake", "-S", required_environment("ECCENTRA_SOURCE"), "-B", (folder / "b").string(),
                   "-DECCENTRA_FOAM_HEADERS=" + (folder / "headers").string()},
                  {folder, {}, 60});
  EXPECT_NE(run.status, 0) << run.output;
  EXPECT_NE(run.output.find("'1906.191111-1'"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("run scripts/setup"), std::string::npos) << run.output;
}

} // namespace
