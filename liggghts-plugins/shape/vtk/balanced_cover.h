// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Grows spheres until their union has the volume of a solid.
#pragma once

#include "shape/cluster_shape.h"

#include <vector>

namespace eccentra::shape {

/// Increases all radii by one length [unit of the spheres], which is returned, so that the union has the volume
/// `volume`. The volume of the given spheres must be smaller.
double grow_to_volume(std::vector<Sphere>& spheres, double volume);

} // namespace eccentra::shape
