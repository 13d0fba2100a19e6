// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Time that this rank has waited for other ranks; the rest of its wall-clock time is computing.
#pragma once

namespace eccentra::link {

/// Wall-clock seconds that this process has spent in calls of MPI that wait, since its start; never decreases. Counted
/// by liggghts-plugins/tools/mpi_clock.cpp, which is loaded before the MPI library in eccentra-dem and annulusFoam. In
/// other programs it is 0.
double& waiting_seconds();

} // namespace eccentra::link
