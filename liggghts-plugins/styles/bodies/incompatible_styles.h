// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refuses stock styles and commands that would treat a cluster as its bounding sphere, as the table of stock styles
// says.
#pragma once

#include "styles/bodies/stock_styles.h"

namespace LAMMPS_NS {
class LAMMPS;
} // namespace LAMMPS_NS

namespace eccentra::styles {

class FixClusterBodies;

/// The bodies' fix where the script declares clusters, else null: then nothing is checked or refused.
FixClusterBodies* bodies_in_script(LAMMPS_NS::LAMMPS* lmp);

/// Stops all ranks with one sentence if the script uses a style that would be wrong for clusters. Collective.
void refuse_incompatible_styles(LAMMPS_NS::LAMMPS* lmp, FixClusterBodies& bodies);

/// The first refused fix or compute that reaches local atom i through a group other than `all`; empty if there is none.
std::string refusal_of_body(LAMMPS_NS::LAMMPS* lmp, int i);

} // namespace eccentra::styles
