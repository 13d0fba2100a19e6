// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The start of MPI in programs of ours.
#pragma once

#include <cstdlib>
#include <mpi.h>
#include <vector>

namespace eccentra::link {

/// MPI_Init. A program that no launcher has started starts no daemon of Open MPI 4 beside itself, which takes half of a
/// start's time. It writes nothing that another such program removes: all of a user have one session folder, and the
/// first to end takes it from those that begin. What the user has set holds, processes that it starts inherit nothing
/// of this; other MPI libraries and Open MPI 5, which has no such daemon, pass over it.
inline void start_mpi(int* argc, char*** argv) {
  bool launched = false;
  for (const char* name :
       {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMIX_RANK", "PMI_RANK", "PMI_ID", "PMI_FD", "SLURM_PROCID"})
    launched = launched || std::getenv(name);
  std::vector<const char*> ours;
  const auto set = [&](const char* name, const char* value) {
    if (!launched && !std::getenv(name) && setenv(name, value, 0) == 0)
      ours.push_back(name);
  };
  set("OMPI_MCA_ess_singleton_isolated", "1");
  set("OMPI_MCA_orte_create_session_dirs", "0");
  MPI_Init(argc, argv);
  for (const char* name : ours)
    unsetenv(name);
}

} // namespace eccentra::link
