// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The script of cases/heap with an end that tests compare.
#pragma once

#include "reported/programs_of_a_run.h"

namespace eccentra::test {

namespace fs = std::filesystem;

inline std::string heap_script(const std::string& head, int steps) {
  std::string text = contents(fs::path(required_environment("ECCENTRA_CASES")) / "heap/in.heap");
  const std::string last = "run             50000";
  EXPECT_TRUE(holds(text, last));
  text.replace(
      text.find(last), last.size(),
      "run " + std::to_string(steps) +
          "\ndump end all custom 1 end.bodies id x y z vx vy vz omegax omegay omegaz\n"
          "dump_modify end sort id format \"%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\nrun 0\n");
  const std::string word = "resumable ";
  EXPECT_TRUE(holds(text, word));
  return text.replace(text.find(word), word.size(), head + '\n' + "resumable every 1000 ");
}

} // namespace eccentra::test
