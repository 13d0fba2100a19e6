// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sphere lists in text files: lines "x y z r", '#' starts a comment (LIGGGHTS's own clump format).
#pragma once

#include "shape/cluster_shape.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace eccentra::shape {

/// Reads a sphere list. Throws std::invalid_argument that names file and line.
std::vector<Sphere> read_clump(const std::string& path);

/// Writes the spheres of a shape (body frame, metres) with all digits and its mass properties as comments.
void write_clump(std::ostream& out, const ClusterShape& shape);

} // namespace eccentra::shape
