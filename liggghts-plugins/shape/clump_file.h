// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// .clump files: rows of spheres, and lines "#: key values" with chosen mass properties, which LIGGGHTS
// reads as comments.
#pragma once

#include "shape/cluster_shape.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace eccentra::shape {

/// Contents of a file of spheres.
struct Clump {
  std::vector<Sphere> spheres;          ///< in the unit of the file
  std::optional<MassProperties> chosen; ///< if the file contains them; in the frame and unit of the spheres
};

/// Reads a file of spheres, in any form that parse_spheres reads. Throws std::invalid_argument with a sentence that
/// names file and line.
Clump read_clump(const std::string& path);

/// Writes the spheres of a shape (body frame, metres) with all digits, and its mass properties: as a comment if they
/// are those of the union of its spheres, as "#:" lines if others were chosen.
void write_clump(std::ostream& out, const ClusterShape& shape);

} // namespace eccentra::shape
