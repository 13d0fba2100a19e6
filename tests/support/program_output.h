// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the programs of the build are, and what a text holds.
#pragma once

#include "support/run_program.h"

#include <string>

namespace eccentra::test {

/// The path of a program of the build.
inline std::string program(const std::string& name) {
  return required_environment("ECCENTRA_BIN") + "/" + name;
}

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace eccentra::test
