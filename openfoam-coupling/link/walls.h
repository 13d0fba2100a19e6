// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The walls of the DEM script as the fluid side compares them with the patches of its mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace eccentra::link {

/// x y z.
using Vector3 = std::array<double, 3>;

/// A plane or a circular cylinder of the script. World frame, SI.
struct PrimitiveWall {
  /// What it is; the values travel.
  enum class Form : std::uint32_t { plane = 0, cylinder = 1 };
  std::string id;             ///< of the fix
  std::string name;           ///< for the user's eyes: "fix hole (cylinder)"
  Form form = Form::plane;    ///< plane or cylinder
  Vector3 point{};            ///< of the plane, or of the cylinder's axis [m]
  Vector3 direction{};        ///< unit normal of the plane, or unit vector along the axis
  double radius = 0;          ///< of the cylinder [m]
  Vector3 velocity{};         ///< of the material at `point` [m/s]
  Vector3 angular_velocity{}; ///< [rad/s]
};

/// A mesh of triangles of the script.
struct TriangleWall {
  std::string id;                                 ///< of the mesh's fix
  std::string name;                               ///< for the user's eyes: "mesh 'pipe'"
  bool moves = false;                             ///< from place to place (fix move/mesh)
  bool velocity_known = true;                     ///< false: it moves, and has not made a step yet
  std::vector<std::array<Vector3, 3>> corners;    ///< [m]
  std::vector<std::array<Vector3, 3>> velocities; ///< of the corners [m/s]; empty where the mesh is at rest
};

/// All walls of the DEM side.
struct WallDescription {
  std::vector<PrimitiveWall> primitives; ///< of the script
  std::vector<TriangleWall> meshes;      ///< meshes of triangles
};

} // namespace eccentra::link
