// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The granular walls of a script, ours and stock's, as the fluid side compares them with its mesh.
#pragma once

#include "link/walls.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

/// Planes, cylinders and triangle meshes of all fixes wall/gran and wall/gran/cluster. Collective; complete on rank 0,
/// the others have the primitive walls and the names of the meshes. `running`: moving meshes have their velocity
/// (before the first step they have none).
link::WallDescription walls_of_script(LAMMPS_NS::LAMMPS* lmp, bool running);

/// True if a mesh of these walls moves.
bool any_moves(const link::WallDescription& walls);

} // namespace eccentra::styles
