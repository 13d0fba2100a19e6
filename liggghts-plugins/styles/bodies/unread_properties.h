// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Material properties that a script gives and no model of it reads.
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

/// Names each fix property/global that nothing has looked up so far in a warning, once. To be called when all styles
/// of a run have been initialised.
void name_unread_properties(LAMMPS_NS::LAMMPS* lmp);

} // namespace eccentra::styles
