// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes as surfaces for ParaView and as pictures.
#pragma once

#include "shape/cluster_shape.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Writes the surfaces of the unions, side by side if there are several, with delta_e/R_eq and the sub-sphere's
/// number at each point. The file's ending chooses the format: .vtp or .vtk. Throws std::invalid_argument if the file
/// cannot be written.
void write_surface(const std::vector<ClusterShape>& shapes, const std::string& path);

/// Draws the shapes side by side at equal scale, coloured by delta_e/R_eq, into a PNG file. Starts Xvfb, because
/// Debian's VTK draws only with an X server. Throws std::invalid_argument if this or the file fails.
void write_picture(const std::vector<ClusterShape>& shapes, const std::string& path);

} // namespace eccentra::shape
