// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads STL files without joining or repairing anything.
#pragma once

#include "shape/surface.h"

#include <string>

namespace eccentra::shape {

/// Reads all facets of an ASCII or binary STL file by VTK; each facet has three vertices of its own. Throws
/// std::invalid_argument if the file cannot be read, is not STL, is truncated, or contains a coordinate that is not
/// finite.
Surface read_stl(const std::string& path);

/// Joins vertices that are closer than `tolerance`, in units of the diagonal of the bounding box.
Surface join_vertices(const Surface& surface, double tolerance);

} // namespace eccentra::shape
