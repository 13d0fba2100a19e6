// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every keyword that is on or off takes on, off, yes, no and none, and refuses any other word with its name. No file
// but the option reader compares a word with them.
#include "support/granular_script.h"
#include "support/program_output.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

const std::vector<std::string> kOn = {"on", "yes"}, kOff = {"off", "no", "none"},
                               kBoth = {"on", "yes", "off", "no", "none"};

/// A line of a script with W where the switch is.
struct Switch {
  std::string keyword;
  std::string line;
  std::string undo;                       ///< what takes the line back
  std::vector<std::string> words = kBoth; ///< those that this line may have
};

std::vector<Switch> switches() {
  const std::string wall = "fix s all wall/gran/cluster model hertz tangential history ";
  const std::string plane = " primitive type 1 zplane 0.0";
  const std::string force = "fix s all fluid/force rheology newtonian 0.1 density 1000 drag schiller_naumann ";
  const std::string couple = "fix s all fluid/couple link solver every 10 ";
  const std::string pair = "pair_style gran model hertz tangential history rolling_friction ";
  const std::string clusters = "pair_style gran/cluster model hertz tangential history ";
  std::vector<Switch> all = {
      {"enforce", "fix s all timestep/limit safety 0.3 every 100 enforce W", "unfix s"},
      {"tangential_damping", wall + "tangential_damping W" + plane, "unfix s"},
      {"torsionTorque", wall + "rolling_friction cdt torsionTorque W" + plane, "unfix s"},
      {"torsionTorque", wall + "rolling_friction shape torsionTorque W" + plane, "unfix s"},
      {"torsionTorque", wall + "rolling_friction epsd torsionTorque W" + plane, "unfix s"},
      {"rockingDamping", wall + "rolling_friction eccentric rockingDamping W" + plane, "unfix s"},
      {"torsionTorque", pair + "shape torsionTorque W", ""},
      {"rockingDamping", pair + "eccentric shape cube 8 rockingDamping W", ""},
      // Keywords of stock that ask for nothing.
      {"heating_tracking", wall + "heating_tracking W" + plane, "unfix s", kOff},
      {"store_force", wall + "store_force W" + plane, "unfix s", kOff},
      {"computeElasticPotential", clusters + "computeElasticPotential W", "", kOff},
      {"limitForce", wall + "limitForce W" + plane, "unfix s"},
      // What is on with link solver is refused because it belongs to link socket.
      {"overlap", couple + "overlap W", "unfix s", kOff},
      {"lanes", couple + "lanes W", "unfix s", kOn},
      {"checkpoint", couple + "checkpoint W", "unfix s"}};
  for (const char* effect : {"void_reynolds", "buoyancy", "pressure_gradient", "viscous_stress"})
    all.push_back({effect, force + effect + " W", "unfix s"});
  return all;
}

const std::string kHead = granular_box("0 0.05 0 0.05 -0.001 0.05", "p p f") +
                          granular_material({5e6, 0.9, 0.5, 0.25}, "0.002") +
                          "pair_style gran model hertz tangential history\n";

std::string line_of(const Switch& row, const std::string& word) {
  return std::regex_replace(row.line, std::regex("\\bW\\b"), word) + "\n";
}

ProgramResult run_script(const std::string& text) {
  write_file("./in.switches", kHead + text);
  return run_program({program("eccentra-dem"), "-in", "in.switches", "-log", "none"});
}

TEST(Switches, EachTakesAllWords) {
  std::string script;
  int lines = 0;
  for (const Switch& row : switches())
    for (const std::string& word : row.words) {
      script += line_of(row, word) + row.undo + "\n";
      ++lines;
    }
  const ProgramResult result = run_script(script + "print \"all taken\"\n");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("\nall taken"), std::string::npos) << result.output;
  EXPECT_GT(lines, 60);
}

TEST(Switches, EachRefusesAnotherWordWithItsName) {
  for (const Switch& row : switches()) {
    const ProgramResult result = run_script(line_of(row, "maybe"));
    EXPECT_NE(result.status, 0) << row.line;
    EXPECT_NE(result.output.find("'" + row.keyword + "'"), std::string::npos) << row.line << '\n' << result.output;
    EXPECT_NE(result.output.find("'maybe'"), std::string::npos) << row.line << '\n' << result.output;
  }
}

/// Files that compare words with on or off although they read no switch of ours.
const std::set<std::string> kOthers = {
    "base/option_reader.cpp",
    "styles/entry/script_replay.cpp",             // a keyword of stock's run
    "styles/bodies/fix_insert.cpp",               // keywords of stock, which stock reads, too
    "styles/pairs/body_commands.cpp",             // the same
    "styles/pairs/contact_keywords_of_pairs.cpp", // models by name
    "styles/walls/wall_arguments.cpp",            // models by name
    "styles/fluid/fix_fluid_couple.cpp",          // checkpoint: auto, off or a number
    "styles/rolling/fix_sphere_orientation.cpp",  // writes a command of stock
};

TEST(Switches, NoFileReadsOneByItself) {
  const fs::path tree = fs::path(required_environment("ECCENTRA_SOURCE")) / "liggghts-plugins";
  const std::regex comparison(R"re((==|!=|strcmp\(.*)[^;]*"(on|yes|no)"|"(on|yes|no)"\s*(==|!=))re");
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(tree)) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h")
      continue;
    ++files;
    const std::string name = fs::relative(entry.path(), tree).string();
    if (kOthers.count(name))
      continue;
    std::istringstream text(contents(entry.path()));
    for (std::string line; std::getline(text, line);)
      EXPECT_FALSE(std::regex_search(line, comparison)) << name << ": OptionReader::on_off() reads switches: " << line;
  }
  EXPECT_GT(files, 100);
}

} // namespace
