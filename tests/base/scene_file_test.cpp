// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The file scene: what is an entry, and what is refused with its line.
#include "base/scene_file.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using eccentra::base::read_scene;
using eccentra::base::SceneEntry;

TEST(SceneFile, EntriesInTheirOrder) {
  const auto entries = read_scene("FoamFile { version 2.0; object scene; }\n"
                                  "/* of the\n hole */ length 0.3; // [m]\n"
                                  "shape \"disk 19\";ends\tperiodic ;\n"
                                  "small -1e-3;",
                                  "scene");
  const std::vector<SceneEntry> expected = {
      {"length", "0.3"}, {"shape", "disk 19"}, {"ends", "periodic"}, {"small", "-1e-3"}};
  EXPECT_EQ(entries, expected);
  EXPECT_TRUE(read_scene("", "scene").empty());
}

TEST(SceneFile, EverythingElseIsRefusedWithItsLine) {
  struct Case {
    const char* text;
    const char* where;
    const char* word;
  };
  for (const Case& c : {Case{"a 1;\nb 2", "line 2", "semicolon"},
                        {"a 1;\n\nb 2 3;", "line 3", "'3'"},
                        {"a { b 1; }", "line 1", "'{'"},
                        {"a (1 2);", "line 1", "'(1'"},
                        {"a $b;", "line 1", "'$b'"},
                        {"#include \"x\"", "line 1", "'#include'"},
                        {"1a 2;", "line 1", "'1a'"},
                        {"a 1;\na 2;", "line 2", "'a'"},
                        {"a \"x\n\";", "line 1", "quote"},
                        {"/* a 1;", "line 1", "*/"},
                        {"a;", "line 1", "';'"},
                        {"FoamFile {", "line 1", "closed by }"},
                        {"a", "line 1", "value"}}) {
    try {
      read_scene(c.text, "my.scene");
      ADD_FAILURE() << "accepted: " << c.text;
    } catch (const std::invalid_argument& problem) {
      const std::string said = problem.what();
      EXPECT_NE(said.find("my.scene"), std::string::npos) << said;
      EXPECT_NE(said.find(c.where), std::string::npos) << c.text << ": " << said;
      EXPECT_NE(said.find(c.word), std::string::npos) << c.text << ": " << said;
    }
  }
}

} // namespace
