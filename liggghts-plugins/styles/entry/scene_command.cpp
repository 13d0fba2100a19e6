// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Command scene: the numbers of a case, from the file that the mesh and the boundary conditions read, too.
#include "base/scene_file.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "error.h"
#include "input.h"
#include "lammps.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;

/// The file's text on every rank, read by the first.
std::string text_of(LAMMPS* lmp, const std::string& file) {
  int rank = 0;
  MPI_Comm_rank(lmp->world, &rank);
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
  MPI_Bcast(&size, 1, MPI_INT, 0, lmp->world);
  if (size < 0)
    throw std::invalid_argument("scene: file '" + file +
                                "' cannot be read; expected a dictionary of entries such as 'length 0.3;'");
  text.resize(size);
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, lmp->world);
  return text;
}

/// Each entry becomes an index variable: one that the command line has set (-var) keeps its value.
void scene(LAMMPS* lmp, int narg, char** arg) {
  try {
    if (narg != 1)
      throw std::invalid_argument("scene: " + std::to_string(narg) + " words are not one; expected scene FILE");
    const std::string file = arg[0];
    for (const auto& [name, value] : base::read_scene(text_of(lmp, file), file)) {
      if (value.find_first_of("\"$&") != std::string::npos || value.find_first_not_of(' ') == std::string::npos)
        throw std::invalid_argument(file + ": '" + value + "' is not a value of '" + name +
                                    "' that a script can hold; expected a number or words without \" $ &");
      lmp->input->one(("variable " + name + " index \"" + value + "\"").c_str());
    }
  } catch (const std::invalid_argument& problem) {
    lmp->error->all(FLERR, problem.what());
  }
}

const RegisterCommand registered("scene", "index variables from the file that mesh and boundary conditions read",
                                 &scene);

} // namespace
} // namespace eccentra::styles
