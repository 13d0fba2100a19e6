// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The state of all bodies, for comparisons digit by digit.
#pragma once

#include "styles/bodies/fix_cluster_bodies.h"
#include "support/liggghts_session.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <vector>

namespace eccentra::test {

using BodyRow = std::array<double, 13>;

/// Position, velocity, quaternion and angular velocity by tag, the same on every rank; zero where a body is gone.
inline std::vector<BodyRow> body_rows(LiggghtsSession& session, int tags, MPI_Comm ranks = MPI_COMM_WORLD) {
  std::vector<BodyRow> all(tags, BodyRow{});
  styles::FixClusterBodies& bodies = styles::FixClusterBodies::require(&session.lammps());
  for (int tag = 1; tag <= tags; ++tag) {
    const int i = session.local(tag);
    if (i < 0)
      continue;
    double* next = all[tag - 1].data();
    next = std::copy_n(session.atom().x[i], 3, next);
    next = std::copy_n(session.atom().v[i], 3, next);
    next = std::copy_n(bodies.quaternion(i), 4, next);
    std::copy_n(session.atom().omega[i], 3, next);
  }
  MPI_Allreduce(MPI_IN_PLACE, all[0].data(), tags * 13, MPI_DOUBLE, MPI_SUM, ranks);
  return all;
}

} // namespace eccentra::test
