// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What must be true of every body when a run starts, whatever the script did to atoms before.
#pragma once

#include <string>

namespace LAMMPS_NS {
class Atom;
class LAMMPS;
} // namespace LAMMPS_NS

namespace eccentra::styles {

class FixClusterBodies;

/// Checks the bodies that were inserted within a run: one integrator, no refused style. Stops this rank's run with one
/// sentence, and so all of them.
void check_new_bodies(LAMMPS_NS::LAMMPS* lmp, FixClusterBodies& bodies);

/// How sentences name the body that is local atom i.
std::string body_name(const LAMMPS_NS::Atom& atom, const FixClusterBodies& bodies, int i);

/// Stops all ranks with the sentence of the body of lowest tag; a rank without a problem gives the largest int.
/// Collective.
void stop_at_lowest(LAMMPS_NS::LAMMPS* lmp, int tag, std::string sentence);

} // namespace eccentra::styles
