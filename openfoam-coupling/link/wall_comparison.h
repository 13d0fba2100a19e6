// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walls of a DEM script beside the patches of a mesh: the same places, the same velocities, or a sentence that says
// where not.
#pragma once

#include "link/walls.h"

#include <functional>
#include <string>
#include <vector>

namespace eccentra::link {

/// A face of the mesh. World frame, SI.
struct PatchFace {
  std::vector<Vector3> corners; ///< in order around the face [m]
  Vector3 velocity{};           ///< that the fluid has there [m/s]
};

/// A boundary of the mesh that is neither periodic nor between ranks.
struct MeshPatch {
  std::string name;             ///< as in the mesh
  bool wall = false;            ///< nothing flows through it; else an opening
  bool velocity_known = false;  ///< its boundary condition gives the velocity
  std::vector<PatchFace> faces; ///< of all ranks
};

/// What the comparison found.
struct WallVerdict {
  std::string refusal;               ///< one sentence if the two sides describe different walls
  std::string news;                  ///< sentences about walls that one side has alone, one a line
  std::vector<double> chord_heights; ///< of each patch: how far its flat faces lie from the surface they stand for [m]
};

/// `apart`: true for names of patches and ids of wall fixes that are left out. A wall of the script and a patch that
/// are both planes or both cylinders, nearly parallel, are one wall unless each has found its own.
WallVerdict compare_walls(const WallDescription& dem, const std::vector<MeshPatch>& mesh,
                          const std::function<bool(const std::string&)>& apart);

} // namespace eccentra::link
