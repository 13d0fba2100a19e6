// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/shared_mesh.h"

#include "Time.H"
#include "argList.H"

#include <mpi.h>

#include <string>
#include <vector>

namespace eccentra::test {

Foam::fvMesh* sharedMesh = nullptr;

void openSharedMesh(const char* program) {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<std::string> words = {program, "-case", ECCENTRA_TEST_MESH};
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
  sharedMesh =
      new Foam::fvMesh(Foam::IOobject(Foam::fvMesh::defaultRegion, time->timeName(), *time, Foam::IOobject::MUST_READ));
}

} // namespace eccentra::test
