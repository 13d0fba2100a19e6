// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Notes to whoever runs a script: on the screen and in the log, once, without the path of a source file.
#pragma once

#include "shape/note.h"

#include "comm.h"
#include "lammps.h"

#include <cstdio>
#include <string>
#include <vector>

namespace eccentra::styles {

/// Prints "WARNING: where: text" or "NOTE: where: text" for each note, on rank 0.
inline void print_notes(LAMMPS_NS::LAMMPS* lmp, const std::string& where, const shape::Notes& notes) {
  if (lmp->comm->me != 0)
    return;
  for (const shape::Note& note : notes)
    for (std::FILE* out : {lmp->screen, lmp->logfile})
      if (out)
        std::fprintf(out, "%s: %s: %s\n", note.warning ? "WARNING" : "NOTE", where.c_str(), note.text.c_str());
}

} // namespace eccentra::styles
