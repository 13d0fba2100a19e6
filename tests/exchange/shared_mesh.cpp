// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/shared_mesh.h"

#include "Time.H"
#include "argList.H"

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>
#include <vector>

namespace eccentra::test {

Foam::fvMesh* sharedMesh = nullptr;

} // namespace eccentra::test

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<std::string> words = {argv[0], "-case", ECCENTRA_TEST_MESH};
  if (size > 1)
    words.push_back("-parallel");
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  char** values = arguments.data();
  // Lives until the process ends: its destructor would end it with success.
  Foam::argList::noBanner();
  auto* args = new Foam::argList(count, values);
  auto* time = new Foam::Time(Foam::Time::controlDictName, *args);
  eccentra::test::sharedMesh =
      new Foam::fvMesh(Foam::IOobject(Foam::fvMesh::defaultRegion, time->timeName(), *time, Foam::IOobject::MUST_READ));
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
