// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Command scene: the numbers of a case, from the file that the mesh and the boundary conditions read, too.
#include "base/scene_file.h"
#include "styles/entry/shared_text.h"
#include "styles/entry/style_registry.h"

#include "error.h"
#include "input.h"
#include "lammps.h"

#include <optional>
#include <stdexcept>
#include <string>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;

std::string text_of(LAMMPS* lmp, const std::string& file) {
  if (const std::optional<std::string> text = shared_text(*lmp, file))
    return *text;
  throw std::invalid_argument("scene: file '" + file +
                              "' cannot be read; expected a dictionary of entries such as 'length 0.3;'");
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
