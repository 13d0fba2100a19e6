// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Removes repeated spheres, because each of them would have a contact of its own.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/note.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Removes spheres that repeat another within 0.1 % of the larger radius; of two, the larger or the earlier one stays.
/// `notes` receives a warning about these, and about pairs within 5 %, which stay. `where` begins each note.
void merge_coincident(std::vector<Sphere>& spheres, const std::string& where, Notes& notes);

} // namespace eccentra::shape
