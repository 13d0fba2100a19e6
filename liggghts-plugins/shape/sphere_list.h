// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rows "x y z r" of a text file, as LIGGGHTS, Yade, CLUMP, DEM-Engine, ParaView and spreadsheets write them.
#pragma once

#include "shape/cluster_shape.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Contents of a text file of spheres.
struct SphereList {
  std::vector<Sphere> spheres;   ///< in the order of the file, in its unit
  std::vector<std::string> keys; ///< lines that begin with "#:", without these two characters
};

/// Reads rows of four numbers, separated by blanks, tabs, commas or semicolons (then with decimal commas, too). A
/// header line, also one behind '#', may name the columns; a line with one number before all rows is the count of
/// spheres; '#' starts a comment and '&' at the end continues a line. `where` is the name of the file for the
/// sentences. Throws std::invalid_argument with one sentence that names file, line, value and remedy.
SphereList parse_spheres(const std::string& text, const std::string& where);

} // namespace eccentra::shape
