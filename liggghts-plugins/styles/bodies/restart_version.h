// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mark of cluster data in restart files, which tells what a library of another version wrote.
#pragma once

#include <string>

namespace eccentra::styles {

/// Raise it with every change of what clusters, their contacts or their walls keep in restart files.
constexpr int restart_format = 4;
/// Stands at the head of each of these records: letters in the upper bytes, the format in the lowest.
constexpr int restart_letters = 0x45434c00, restart_mark = restart_letters | restart_format;

/// Empty if a record with this head can be read, else one sentence that says why not.
inline std::string restart_problem(int mark, const std::string& who) {
  if (mark == restart_mark)
    return {};
  const bool numbered = (mark & ~0xff) == restart_letters;
  return who + ": the restart file was written by another version of Eccentra (data format " +
         (numbered ? std::to_string(mark & 0xff) : "without a number") + ", this version reads " +
         std::to_string(restart_format) + "): go on with the version that wrote it, or start the run anew";
}

/// The sentence for a record that can be read but not be true.
inline std::string damaged_restart(const std::string& who) {
  return who +
         ": the restart file is damaged; expected the file as write_restart left it; read an earlier one, or start "
         "the run anew";
}

} // namespace eccentra::styles
