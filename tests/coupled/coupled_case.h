// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A coupled case in a box, written, meshed and run with the programs that a user runs.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace eccentra::test {

/// A box of hexahedra with one patch pair per direction, and a fluid in it.
struct BoxCase {
  double size[3] = {0.06, 0.06, 0.06}; ///< from the origin [m]
  int cells[3] = {6, 6, 6};
  bool periodic[3] = {true, true, true}; ///< else walls
  double step = 2e-3;                    ///< of the fluid [s]
  double viscosity = 0.01;               ///< Newtonian [Pa s]
  std::string turbulence;                ///< RAS model with its usual wall functions; empty: laminar
  std::string rheology;                  ///< entries of transportProperties in place of the Newtonian ones
  double density = 1000;
  std::string time_scheme = "backward";
  int correctors = 2;
  double tolerance = 1e-10; ///< of the linear solvers
  std::string drive;        ///< contents of flowProperties
  std::string control;      ///< further lines of controlDict
  std::string coupling;     ///< further lines of couplingProperties
  std::string script;       ///< DEM script
  std::string bodies;       ///< file `bodies` beside it, for create_bodies
};

struct Outcome {
  int status = -1;  ///< exit code
  std::string text; ///< all that was printed
  std::string folder;
  std::vector<std::map<std::string, double>> rows; ///< of coupling.csv

  double last(const std::string& column) const { return rows.back().at(column); }
};

/// The beginning of every script of these tests: the box, the material, spheres of diameter 6.35 mm.
std::string script_head(const BoxCase& box, double time_step, const std::string& wall_arguments = "");

/// Runs the case in folder `name` below the present one. Throws std::runtime_error if the mesh cannot be made.
Outcome run(const BoxCase& box, const std::string& name, int ranks = 1);

} // namespace eccentra::test
