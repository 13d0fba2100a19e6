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
/// and meshes.
std::string random_states(LAMMPS_NS::LAMMPS* lmp);

/// Sets the seeds from which insertions measure their regions at set-up. Call before the set-up of a run.
void restore_insertion_seeds(LAMMPS_NS::LAMMPS* lmp, const std::string& states);

/// Sets the generators back. Call after the set-up of a run, which uses some of them.
void restore_random_states(LAMMPS_NS::LAMMPS* lmp, const std::string& states);

} // namespace eccentra::styles
