// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What whoever named a shape may not expect.
#pragma once

#include <string>
#include <vector>

namespace eccentra::shape {

/// A sentence: what was repaired, left out, or is missing.
struct Note {
  std::string text;
  bool warning = true; ///< false: nothing out of the ordinary
};
using Notes = std::vector<Note>;

} // namespace eccentra::shape
