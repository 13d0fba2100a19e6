// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of a run without its wall-clock times.
#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace eccentra::test {

/// Rows of coupling.csv without the columns that end in _seconds.
inline std::string physics_of_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line, all, word;
  std::set<int> clocks;
  for (bool heading = true; std::getline(in, line); heading = false) {
    std::istringstream arguments(line);
    for (int column = 0; std::getline(arguments, word, ','); ++column) {
      if (heading && word.size() > 8 && word.substr(word.size() - 8) == "_seconds")
        clocks.insert(column);
      if (clocks.count(column) == 0)
        all += word + ' ';
    }
    all += '\n';
  }
  return all;
}

} // namespace eccentra::test
