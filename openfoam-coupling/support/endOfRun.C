// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Ends all ranks together where they have the same error.
#include "support/endOfRun.H"

#include <mpi.h>

#include <cfenv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>

namespace eccentra {
namespace {

/// An error of all ranks reaches them within this time [s].
constexpr double kTogether = 2.0;

bool mpiRuns() {
  int begun = 0, ended = 0;
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  return begun && !ended;
}

/// Waits until all ranks are here; false if they do not come.
bool allAreHere() {
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  const auto begun = std::chrono::steady_clock::now();
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done)
      return true;
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() > kTogether)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

} // namespace

// Static objects of the hosts stay as they are: whoever has not come to the end of its work has nothing to say there.
void endWithError(const std::string& line) {
  fedisableexcept(FE_ALL_EXCEPT);
  std::cout.flush();
  std::fflush(nullptr);
  const bool mpi = mpiRuns();
  int rank = 0;
  if (mpi)
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const bool together = !mpi || allAreHere();
  if (rank == 0 || !together)
    std::cerr << line << std::endl;
  if (!together)
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  if (mpi)
    MPI_Finalize();
  std::_Exit(EXIT_FAILURE);
}

} // namespace eccentra
