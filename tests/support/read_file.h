// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what a program under test has written: the whole text of a file, or the numbers in it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace eccentra::test {

/// The text of a file; empty if there is none.
inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All words of a file that are numbers, in their order; empty if there is no such file.
inline std::vector<double> numbers_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<double> all;
  for (std::string word; in >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end == '\0')
      all.push_back(value);
  }
  return all;
}

} // namespace eccentra::test
