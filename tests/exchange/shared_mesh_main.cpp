// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/shared_mesh.h"
#include "link/start_mpi.h"

#include <gtest/gtest.h>
#include <mpi.h>

int main(int argc, char** argv) {
  eccentra::link::start_mpi(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  eccentra::test::openSharedMesh(argv[0]);
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
