// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Floating-point environment and MPI around two hosts.
#include "support/processGuards.H"

#include <mpi.h>

#include <cfenv>
#include <exception>

namespace eccentra {

namespace {

void trap(int exceptions) {
  std::feclearexcept(FE_ALL_EXCEPT);
  fedisableexcept(FE_ALL_EXCEPT);
  feenableexcept(exceptions);
}

} // namespace

trapping::trapping(int exceptions) : before_(fegetexcept()) {
  trap(exceptions);
}

trapping::~trapping() {
  trap(before_);
}

runningMpi::runningMpi() {
  int running = 0;
  MPI_Initialized(&running);
  if (running)
    return;
  // Libraries below MPI may trip over trapped floating-point exceptions while they start.
  std::fenv_t traps;
  std::feholdexcept(&traps);
  MPI_Init(nullptr, nullptr);
  std::feclearexcept(FE_ALL_EXCEPT);
  std::fesetenv(&traps);
  ours_ = true;
}

// OpenFOAM ends what it has not begun only with a warning.
runningMpi::~runningMpi() {
  if (ours_ && std::uncaught_exceptions() == 0)
    MPI_Finalize();
}

} // namespace eccentra
