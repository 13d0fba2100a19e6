// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// STL files as they are, before anything is joined or repaired.
#pragma once

#include "shape/surface.h"

#include <string>

namespace eccentra::shape {

/// Reads all facets of an ASCII or binary STL file by VTK, three vertices of its own for each. Throws
/// std::invalid_argument where the file cannot be read, is no STL file, is cut off, or holds a coordinate that is no
/// finite number.
Surface read_stl(const std::string& path);

/// Joins vertices that are closer than `tolerance`, a part of the diagonal of the bounding box.
Surface join_vertices(const Surface& surface, double tolerance);

} // namespace eccentra::shape
