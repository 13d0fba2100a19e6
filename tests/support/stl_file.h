// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// STL files of a few triangles.
#pragma once

#include <mpi.h>

#include <array>
#include <fstream>
#include <string>
#include <vector>

namespace eccentra::test {

/// Corners "x y z" [m].
using StlTriangle = std::array<std::string, 3>;

inline std::vector<StlTriangle> stl_quad(const std::array<std::string, 4>& corners) {
  return {{corners[0], corners[1], corners[2]}, {corners[0], corners[2], corners[3]}};
}

/// Written by rank 0, because all ranks read it. Collective.
inline void write_stl_file(const std::string& file, const std::vector<StlTriangle>& triangles) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    std::ofstream stl(file);
    stl << "solid s\n";
    for (const StlTriangle& corners : triangles)
      stl << "facet normal 0 0 1\nouter loop\nvertex " << corners[0] << "\nvertex " << corners[1] << "\nvertex "
          << corners[2] << "\nendloop\nendfacet\n";
    stl << "endsolid s\n";
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

} // namespace eccentra::test
