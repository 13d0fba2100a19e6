// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What must be true of every body when a run starts, whatever the script did to atoms before.
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

class FixClusterBodies;

/// Checks the bodies that were inserted within a run: one integrator, no refused style. Stops this rank's run with one
/// sentence, and so all of them.
void check_new_bodies(LAMMPS_NS::LAMMPS* lmp, FixClusterBodies& bodies);

} // namespace eccentra::styles
