// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Starts MPI around GoogleTest for programs that run on several ranks or run LIGGGHTS.
#include "link/start_mpi.h"

#include <gtest/gtest.h>
#include <mpi.h>

int main(int argc, char** argv) {
  eccentra::link::start_mpi(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  int failed = RUN_ALL_TESTS();
  // Every rank fails if one does.
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
