// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Malformed input ends with one clear sentence, soon, and without a crash. The cases are data: bad_input/*.yaml and
// bad_input/openfoam/*.yaml.
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr double time_allowed = 20; // seconds, with a machine that is busy; an answer takes less than one

/// A program with its input that works, which every bad case changes in one place.
struct Base {
  std::vector<std::string> arguments;       ///< the command; the first word is looked up in our bin folder
  std::map<std::string, std::string> files; ///< input files by name
  std::string copy;                         ///< folder of the source tree whose files come first
  double timeout = time_allowed;
};

struct Change {
  std::string file;
  std::string from; ///< text that occurs in the file; empty: the new text goes to the end
  std::string to;
};

struct Case {
  std::string name;
  Base base;
  std::vector<Change> changes;
  std::vector<std::string> says; ///< arguments that the sentence must hold: file or keyword, value, remedy
};

Base parse_base(const YAML::Node& node) {
  Base base;
  base.arguments = node["run"].as<std::vector<std::string>>();
  for (const auto& file : node["files"])
    base.files[file.first.as<std::string>()] = file.second.as<std::string>();
  if (node["copy"]) {
    base.copy = node["copy"].as<std::string>();
    const fs::path folder = fs::path(required_environment("ECCENTRA_SOURCE")) / base.copy;
    for (const auto& item : fs::recursive_directory_iterator(folder)) {
      std::ifstream stream(item.path());
      if (item.is_regular_file())
        base.files.emplace(fs::relative(item.path(), folder), std::string{std::istreambuf_iterator<char>(stream), {}});
    }
  }
  if (node["timeout"])
    base.timeout = node["timeout"].as<double>();
  return base;
}

Case parse_case(const YAML::Node& node, const std::map<std::string, Base>& bases) {
  Case bad;
  bad.name = node["name"].as<std::string>();
  bad.base = bases.at(node["base"].as<std::string>());
  bad.says = node["says"].as<std::vector<std::string>>();
  if (node["run"])
    bad.base.arguments = node["run"].as<std::vector<std::string>>();
  for (const auto& file : node["files"])
    bad.base.files[file.first.as<std::string>()] = file.second.as<std::string>();
  const std::string first_file = bad.base.files.empty() ? "" : bad.base.files.begin()->first;
  const auto add = [&](const YAML::Node& change) {
    bad.changes.push_back({change["file"] ? change["file"].as<std::string>() : first_file,
                           change["from"] ? change["from"].as<std::string>() : "", change["to"].as<std::string>()});
  };
  if (node["change"])
    add(node["change"]);
  for (const auto& change : node["changes"])
    add(change);
  return bad;
}

ProgramResult execute(const Base& base, const fs::path& folder) {
  for (const auto& [name, text] : base.files)
    write_file(folder / name, text);
  std::vector<std::string> arguments = base.arguments;
  for (std::string& word : arguments) {
    const fs::path ours = fs::path(required_environment("ECCENTRA_BIN")) / word;
    if (word.find('/') == std::string::npos && fs::is_regular_file(ours))
      word = ours;
  }
  const std::string path = required_environment("ECCENTRA_BIN") + ":" + required_environment("PATH");
  return run_program(arguments, {folder, {"PATH=" + path}, base.timeout});
}

/// The sentences in which a program says that it stops: "ERROR: ..." (LIGGGHTS), "tool: error: ..." and the like
/// (ours), and the text under "--> FOAM FATAL" (OpenFOAM), up to its blank line.
std::vector<std::string> sentences(const std::string& output) {
  std::vector<std::string> found;
  std::istringstream lines(output);
  std::string line;
  const std::regex said(R"(^(\[\d+\] )?((ERROR( on proc \d+)?|[A-Za-z-]+: error): ))");
  for (std::string before; std::getline(lines, line); before = line) {
    if (line.rfind("Run with --help", 0) == 0) {
      found.push_back(before); // as CLI11 refuses arguments
    } else if (std::regex_search(line, said)) {
      found.push_back(line);
    } else if (line.find("--> FOAM FATAL") != std::string::npos) {
      std::string text;
      while (std::getline(lines, line) && !(line.empty() && !text.empty()) &&
             line.find("FOAM exiting") == std::string::npos)
        text += line + " ";
      found.push_back(text);
    }
  }
  return found;
}

class BaseTest : public testing::Test {
 public:
  explicit BaseTest(Base base) : base_(std::move(base)) {}
  void TestBody() override {
    // Otherwise every change of it would "fail as it should".
    const ProgramResult run =
        execute(base_, fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name()));
    EXPECT_EQ(run.status, 0) << run.output;
    EXPECT_FALSE(run.timed_out);
  }

 private:
  Base base_;
};

class CaseTest : public testing::Test {
 public:
  explicit CaseTest(Case bad) : bad_(std::move(bad)) {}
  void TestBody() override {
    for (const Change& change : bad_.changes) {
      std::string& text = bad_.base.files.at(change.file);
      if (change.from.empty()) {
        text += change.to + "\n";
        continue;
      }
      const auto at = text.find(change.from);
      ASSERT_NE(at, std::string::npos) << "'" << change.from << "' does not occur in " << change.file;
      text.replace(at, change.from.size(), change.to);
    }
    const ProgramResult run =
        execute(bad_.base, fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name()));
    EXPECT_FALSE(run.timed_out) << "no answer within " << bad_.base.timeout << " s\n" << run.output;
    EXPECT_NE(run.status, 0) << "accepted in silence\n" << run.output;
    EXPECT_EQ(run.signal, 0) << "crashed\n" << run.output;
    for (const char* crash : {"Segmentation fault", "terminate called", "Sanitizer", "runtime error:", "Signal code:"})
      EXPECT_EQ(run.output.find(crash), std::string::npos) << run.output;
    const auto said = sentences(run.output);
    ASSERT_EQ(said.size(), 1U) << run.output;
    for (const std::string& word : bad_.says)
      EXPECT_NE(said[0].find(word), std::string::npos) << "'" << word << "' is missing in: " << said[0];
  }

 private:
  Case bad_;
};

void register_file(const fs::path& path) {
  const YAML::Node root = YAML::LoadFile(path);
  const std::string suite = path.stem();
  std::map<std::string, Base> bases;
  for (const auto& node : root["bases"]) {
    const auto name = node.first.as<std::string>();
    const Base base = parse_base(node.second);
    bases[name] = base;
    testing::RegisterTest(suite.c_str(), ("works_" + name).c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [base]() -> testing::Test* { return new BaseTest(base); });
  }
  for (const auto& node : root["cases"]) {
    const Case bad = parse_case(node, bases);
    testing::RegisterTest(suite.c_str(), bad.name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [bad]() -> testing::Test* { return new CaseTest(bad); });
  }
}

} // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  try {
    std::vector<fs::path> files;
    std::istringstream folders(required_environment("ECCENTRA_BAD_INPUT"));
    for (std::string folder; std::getline(folders, folder, ':');)
      for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".yaml")
          files.push_back(entry.path());
    if (files.empty())
      throw std::runtime_error("no *.yaml in the folders of ECCENTRA_BAD_INPUT");
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      register_file(file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bad_input: error: the data files cannot be read: %s\n", error.what());
    return 1;
  }
  return RUN_ALL_TESTS();
}
