// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walls of a run as surfaces.
#pragma once

#include "report/case_data.h"

#include <array>
#include <string>
#include <vector>

namespace eccentra::report {

/// A wall by the id of its fix.
struct WallSurface {
  std::string name;
  vtkSmartPointer<vtkPolyData> surface;
};

/// Triangles of a mesh of the script, scaled and moved. Throws std::runtime_error where its file is not there.
vtkSmartPointer<vtkPolyData> mesh_of_wall(const Case& data, const WallMesh& mesh);

/// All walls: planes as far as `box` (x from, to, y, z) reaches, cylinders between the ends of the box, and meshes.
/// A plane outside of the box is left out.
std::vector<WallSurface> wall_surfaces(const Case& data, const std::array<double, 6>& box);

} // namespace eccentra::report
