// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The names of all drag laws, for tests that walk their table.
#pragma once

#include "closures/drag_table.h"

#include <sstream>
#include <string>
#include <vector>

namespace eccentra::test {

inline std::vector<std::string> drag_laws() {
  std::istringstream names(closures::drag_law_names());
  std::vector<std::string> laws;
  for (std::string name; std::getline(names, name, '|');)
    laws.push_back(name);
  return laws;
}

} // namespace eccentra::test
