// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres that stand twice, or nearly so: each would carry a contact of its own.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/note.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Leaves out spheres that repeat another within 0.1 % of its radius (of two, the larger or the earlier one stays) and
/// says so in `notes`, as it does of spheres that come within 5 %, which stay. `where` begins each note.
void merge_coincident(std::vector<Sphere>& spheres, const std::string& where, Notes& notes);

} // namespace eccentra::shape
