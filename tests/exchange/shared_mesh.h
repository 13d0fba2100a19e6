// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A small periodic annulus, whole on one rank and cut in two on two, for programs of tests (shared_mesh_main.cpp) and
// of benchmarks.
#pragma once

#include "fvMesh.H"

namespace eccentra::test {

/// Null until the mesh is open.
extern Foam::fvMesh* sharedMesh;

/// Opens the mesh after MPI_Init, on all ranks; `program`: argv[0].
void openSharedMesh(const char* program);

} // namespace eccentra::test
