// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Notes about a shape for the user.
#pragma once

#include <string>
#include <vector>

namespace eccentra::shape {

/// A sentence about what was repaired, removed, or is missing.
struct Note {
  std::string text;    ///< one sentence, without a name in front
  bool warning = true; ///< false: information only
};
/// In the order in which they arose.
using Notes = std::vector<Note>;

} // namespace eccentra::shape
