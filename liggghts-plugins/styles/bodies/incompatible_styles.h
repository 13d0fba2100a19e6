// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock styles that would silently treat a cluster as its bounding sphere are refused.
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

class FixClusterBodies;

/// Stops all ranks with one sentence if the script declares clusters and uses a style that would be wrong for them.
void refuse_incompatible_styles(LAMMPS_NS::LAMMPS* lmp, const FixClusterBodies& bodies);

} // namespace eccentra::styles
