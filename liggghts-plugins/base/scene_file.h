// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The file that gives both sides of a case their numbers: an OpenFOAM dictionary of plain entries.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace eccentra::base {

/// A name and its value as text, without the quotes around words.
using SceneEntry = std::pair<std::string, std::string>;

/// Reads the entries `name value;` of a scene in their order: each value is one word, one number or words in double
/// quotes. Comments (// and /* */) and the header FoamFile { ... } are passed over. Throws std::invalid_argument with
/// `file` and the line for anything else that OpenFOAM would read (sub-dictionaries, lists, $macros, #directives), for
/// a missing semicolon, and for a name that stands twice.
std::vector<SceneEntry> read_scene(const std::string& text, const std::string& file);

} // namespace eccentra::base
