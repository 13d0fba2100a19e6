// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The example inputs that Debian ships with LIGGGHTS print the same thermo output with libeccentra loaded and without.
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

struct Example {
  const char* folder;
  const char* script;
  int steps; ///< the longest run that is left after shortening: whole thousands (the thermo interval), enough for
             ///< contacts
  int atoms; ///< at least that many must take part, or the comparison says nothing
};

void PrintTo(const Example& example, std::ostream* stream) {
  *stream << example.folder << '/' << example.script;
}

const Example examples[] = {
    {"contactModels", "in.newModels", 3000, 1000},   {"packing", "in.packing", 3000, 50},
    {"insert_stream", "in.insert_stream", 4000, 20}, {"multisphere_stone_restitution", "in.multisphere", 6000, 50},
    {"meshGran", "in.meshGran", 4000, 50},           {"movingMeshGran", "in.movingMeshGran", 2000, 50},
    {"conveyor", "in.conveyor", 12000, 20},          {"hysteresis", "in.hysteresis", 4000, 50},
    {"hysteresis", "in.noHysteresis", 4000, 50},     {"cohesion", "in.cohesion", 4000, 50},
    {"cohesion", "in.noCohesion", 4000, 50},         {"chute_wear", "in.chute_wear", 8000, 50},
    {"heatTransfer_1", "in.heatGran", 3000, 50},     {"mesh_tet", "in.mesh_tet", 1000, 50},
};

/// Runs of at most `steps` steps, each from where the one before it ended.
std::string shortened(const std::string& script, int steps) {
  static const std::regex run(R"(^(\s*run\s+)(\S+)(\s+upto)?\s*$)");
  static const std::regex growth(R"(^(\s*variable\s+(?:growts|relaxts)\s+equal\s+)(\d+)\s*$)");
  std::istringstream lines(script);
  std::string result;
  std::string line;
  std::smatch match;
  while (std::getline(lines, line)) {
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    const auto shorter = [steps](const std::string& number) {
      return std::to_string(std::min(std::stoi(number), steps));
    };
    if ((std::regex_match(line, match, run) && std::isdigit(static_cast<unsigned char>(match.str(2)[0]))) ||
        std::regex_match(line, match, growth))
      line = match.str(1) + shorter(match.str(2));
    result += line + "\n";
  }
  return result;
}

/// The thermo table without the columns that hold times of the clock, as one row of arguments per line.
std::vector<std::vector<std::string>> thermo_table(const std::string& output) {
  const std::set<std::string> clock = {"CPU", "T/CPU", "S/CPU", "CPULeft"};
  std::vector<std::vector<std::string>> table;
  std::vector<bool> keep;
  std::istringstream lines(output);
  std::string line;
  bool inside = false;
  while (std::getline(lines, line)) {
    std::istringstream stream(line);
    std::vector<std::string> arguments{std::istream_iterator<std::string>(stream), {}};
    if (arguments.empty())
      continue;
    if (arguments[0] == "Step") {
      inside = true;
      keep.clear();
      for (const std::string& word : arguments)
        keep.push_back(clock.count(word) == 0);
    }
    if (arguments[0] == "Loop")
      inside = false;
    if (!inside || arguments.size() != keep.size())
      continue; // a message among the rows, or outside the table
    std::vector<std::string> row;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      if (keep[i])
        row.push_back(arguments[i]);
    table.push_back(row);
  }
  return table;
}

/// The functions that liggghts-plugins/styles/entry/interposed.map lists.
std::set<std::string> listed_functions() {
  std::set<std::string> names;
  std::ifstream file(required_environment("ECCENTRA_SOURCE") + "/liggghts-plugins/styles/entry/interposed.map");
  for (std::string line; std::getline(file, line) && line.find("local:") == std::string::npos;)
    if (const auto start = line.find("_Z"); start != std::string::npos && line[0] == ' ')
      names.insert(line.substr(start, line.find(';') - start));
  return names;
}

class Examples : public testing::TestWithParam<Example> {
 protected:
  ProgramResult run(const std::string& name, const std::vector<std::string>& program, const std::string& preload) {
    const Example& example = GetParam();
    const fs::path source = fs::path(required_environment("ECCENTRA_LIGGGHTS_EXAMPLES")) / example.folder;
    const fs::path folder = fresh_folder(std::string(example.folder) + "-" + example.script + "-" + name);
    fs::copy(source, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    std::ifstream stream(source / example.script);
    const std::string script{std::istreambuf_iterator<char>(stream), {}};
    write_file(folder / "in.short", shortened(script, example.steps));
    ProgramOptions options;
    options.directory = folder;
    if (!preload.empty())
      options.environment.push_back("LD_PRELOAD=" + preload);
    std::vector<std::string> arguments = program;
    arguments.insert(arguments.end(), {"-in", "in.short", "-log", "none"});
    ProgramResult result = run_program(arguments, options);
    fs::remove_all(folder / "post");
    return result;
  }
};

TEST_P(Examples, ThermoOutputIsTheSame) {
  const ProgramResult stock = run("stock", {"liggghts"}, "");
  ASSERT_EQ(stock.status, 0) << stock.output;
  const auto expected = thermo_table(stock.output);
  ASSERT_GT(expected.size(), 3U) << stock.output;
  // "Atoms" is the second column of every example; at some time enough of them must have been there.
  int most = 0;
  for (const auto& row : expected)
    if (row.size() > 1 && std::isdigit(static_cast<unsigned char>(row[1][0])))
      most = std::max(most, std::stoi(row[1]));
  EXPECT_GE(most, GetParam().atoms) << stock.output;

  const ProgramResult loaded = run("loaded", {"liggghts"}, preload_of_eccentra());
  ASSERT_EQ(loaded.status, 0) << loaded.output;
  EXPECT_EQ(thermo_table(loaded.output), expected);
}

// LIGGGHTS would call our copies of its inline functions and templates instead of its own, with other last digits.
TEST(Exports, NothingOfLiggghtsButTheFunctionsThatWeStandInFrontOf) {
  const ProgramResult symbols =
      run_program({"nm", "-D", "--defined-only", required_environment("ECCENTRA_LIB") + "/libeccentra.so"});
  ASSERT_EQ(symbols.status, 0) << symbols.output;
  std::set<std::string> exported;
  std::istringstream lines(symbols.output);
  for (std::string address, kind, name; lines >> address >> kind >> name;)
    if (std::regex_search(name, std::regex("^_Z(N|NK|TVN|Th.*_N|Th.*_NK)(9LAMMPS_NS|8LIGGGHTS)")))
      exported.insert(name);
  EXPECT_EQ(exported, listed_functions());
  EXPECT_GT(exported.size(), 10U);
}

std::string name_of(const testing::TestParamInfo<Example>& info) {
  std::string name = std::string(info.param.folder) + "_" + (info.param.script + 3);
  return std::regex_replace(name, std::regex("[^A-Za-z0-9_]"), "_");
}

INSTANTIATE_TEST_SUITE_P(Debian, Examples, testing::ValuesIn(examples), name_of);

TEST(Comparison, SeesAnotherTimeStep) {
  // The comparison itself must be able to fail: the same table with one digit changed is another table.
  const std::string table = "Step Atoms KinEng CPU\n 0 10 1.5 0.1\n 5 10 1.25 0.2\nLoop time of 1\n";
  std::string other = table;
  other.replace(other.find("1.25"), 4, "1.26");
  std::string later = table;
  later.replace(later.find("0.2\n"), 3, "0.9");
  EXPECT_NE(thermo_table(table), thermo_table(other));
  EXPECT_EQ(thermo_table(table), thermo_table(later));
}

} // namespace
