// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of LIGGGHTS was, from its log: walls, gravity, box and time step. Any script, with or without a fluid.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace eccentra::report {

using Vector = std::array<double, 3>;

/// A wall that a body may touch. SI, frame of the script.
struct Wall {
  enum class Kind { plane, cylinder };
  Kind kind = Kind::plane;
  Vector point = {0, 0, 0}; ///< of the plane, or of the cylinder's axis
  Vector axis = {0, 0, 1};  ///< unit vector: normal of the plane, axis of the cylinder
  double radius = 0;        ///< of the cylinder [m]
};

/// A triangle mesh of the script: the file, and what places it, in this order.
struct WallMesh {
  std::string id; ///< of its fix
  std::filesystem::path file;
  double scale = 1;
  Vector move = {0, 0, 0}; ///< [m], after the scale
};

/// The state at the end of the script.
struct DemRun {
  std::map<std::string, Wall> walls;              ///< by the id of their fix
  std::vector<WallMesh> meshes;                   ///< of those walls that are meshes, sorted by their ids
  std::vector<std::string> left_out;              ///< ids of meshes that are turned, which are not read
  Vector gravity = {0, 0, 0};                     ///< [m/s2]; 0 without fix gravity
  double time_step = 0;                           ///< [s]; 0 if unknown or if it has changed after a run
  std::array<double, 6> box = {0, 0, 0, 0, 0, 0}; ///< x from, to, y, z
  bool has_box = false;
};

/// Reads the commands as LIGGGHTS has executed them: each line whose variables are replaced. Lines that are not of
/// walls, gravity, box or time step are passed over.
DemRun read_dem_log(const std::string& text);

} // namespace eccentra::report
