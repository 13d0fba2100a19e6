// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shape eccentricity delta_e of rounded bodies, measured as that of clusters is (eccentricity.h).
#pragma once

#include "shape/eccentricity.h"
#include "shape/rounded_hull.h"

namespace eccentra::shape {

/// Against a plane: every orientation equally likely.
EccentricityDistribution eccentricity_plane(const RoundedHull& hull);

/// Against a sphere of radius `radius` [m] that comes straight at the centre of mass, every direction equally likely.
EccentricityDistribution eccentricity_sphere(const RoundedHull& hull, double radius);

/// Against something small that touches every part of the surface equally likely.
EccentricityDistribution eccentricity_surface(const RoundedHull& hull);

/// As eccentricity_cluster over `count` meetings, where at least one of the two is a rounded body.
EccentricityDistribution rounded_eccentricity_cluster(const ClusterShape& shape, const ClusterShape& other, int count);

} // namespace eccentra::shape
