// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The random number generators that place and shape inserted particles: LIGGGHTS's restart file keeps the state of some
// of them, and of the first rank alone.
#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

/// The states of all generators of this rank, one line each: of regions, insertions, templates, distributions, sieves
/// and meshes; and the step of the next insertion.
std::string random_states(LAMMPS_NS::LAMMPS* lmp);

/// Of these lines, those that hold on any number of ranks: when insertions come next.
std::string next_insertions(const std::string& states);

/// Sets the seeds from which insertions measure their regions at set-up, and keeps insertions that are over from
/// beginning again. Call before the set-up of a run, and before its fixes are initialised.
void restore_insertions(LAMMPS_NS::LAMMPS* lmp, const std::string& states);

/// Sets the generators back. Call after the set-up of a run, which uses some of them.
void restore_random_states(LAMMPS_NS::LAMMPS* lmp, const std::string& states);

} // namespace eccentra::styles
