// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Files that the first rank reads, so that they need not be on all machines.
#pragma once

#include <mpi.h>

#include "lammps.h"

#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace eccentra::styles {

/// The text of a file on every rank, or nothing on every rank if it cannot be read or is empty. Collective.
inline std::optional<std::string> shared_text(const LAMMPS_NS::LAMMPS& lmp, const std::string& file) {
  int rank = 0;
  MPI_Comm_rank(lmp.world, &rank);
  std::string text;
  int size = -1;
  if (rank == 0) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream all;
    if (in && all << in.rdbuf()) {
      text = all.str();
      size = static_cast<int>(text.size());
    }
  }
  MPI_Bcast(&size, 1, MPI_INT, 0, lmp.world);
  if (size < 0)
    return std::nullopt;
  text.resize(size);
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, lmp.world);
  return text;
}

} // namespace eccentra::styles
