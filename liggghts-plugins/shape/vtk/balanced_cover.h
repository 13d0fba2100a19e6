// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres that stand out of a solid as much as they leave of it.
#pragma once

#include "shape/cluster_shape.h"

#include <vector>

namespace eccentra::shape {

/// Grows all radii by one length [units of the spheres], which is returned, so that the union has the volume `volume`;
/// that of the spheres given must be smaller.
double grow_to_volume(std::vector<Sphere>& spheres, double volume);

} // namespace eccentra::shape
