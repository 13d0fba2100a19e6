// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How long this rank has waited for other ranks; what is left of its wall-clock time it has computed.
#pragma once

namespace eccentra::link {

/// Wall-clock seconds that this process has spent in calls of MPI that wait, since its start. Only ever grows. Counted
/// by liggghts-plugins/tools/mpi_clock.cpp, which stands in front of the MPI library in eccentra-dem and annulusFoam;
/// in other programs it stays 0.
double& waiting_seconds();

} // namespace eccentra::link
