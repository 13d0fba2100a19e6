// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of clusterShape.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace eccentra::shape {

struct ShapeArguments {
  std::vector<std::string> words; ///< cube 64 | compare ... | list | stl F
  double diameter = 0;            ///< [m]; 0: not given
  std::string clump, vtk, png;    ///< files to write; empty: not given
  bool json = false, property_lines = false;
  std::string partner = "plane", estimate = "mean";
  int types = 1, own_type = 1;
  double mu_r = -1;                                         ///< < 0: not given
  std::vector<std::pair<std::string, std::string>> options; ///< of the families of shapes that have them: name, value
  std::string data;                                         ///< of advise: levels.csv; empty: geometry alone
  std::string scene;                                        ///< of advise; empty: all
};

/// Reads the command line. Returns true to go on, false if `exit_code` says it all (help, or a mistake already
/// explained).
bool read_arguments(int argc, char** argv, ShapeArguments& arguments, int& exit_code);

} // namespace eccentra::shape
