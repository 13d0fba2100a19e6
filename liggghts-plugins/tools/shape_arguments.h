// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of clusterShape.
#pragma once

#include <string>
#include <vector>

namespace eccentra::shape {

struct ShapeArguments {
  std::vector<std::string> words; ///< cube 64 | compare ... | list | stl F
  double diameter = 0;            ///< [m]; 0: not given
  std::string clump, vtk, png;    ///< files to write
  bool json = false, property_lines = false;
  std::string partner = "plane", estimate = "mean";
  int types = 1, own_type = 1;
  double mu_r = -1;   ///< < 0: not given
  int spheres = 0;    ///< of stl; 0: not given
  double error = 0;   ///< of stl, part of the volume; 0: not given
  int resolution = 0; ///< of stl; 0: default
  double scale = 0;   ///< of stl; 0: not given
  std::string mass;   ///< of stl: solid or union
  std::string data;   ///< of advise: levels.csv; empty: geometry alone
  std::string scene;  ///< of advise; empty: all
};

/// Reads the command line. Returns true to go on, false if `exit_code` says it all (help, or a mistake already
/// explained).
bool read_arguments(int argc, char** argv, ShapeArguments& arguments, int& exit_code);

} // namespace eccentra::shape
