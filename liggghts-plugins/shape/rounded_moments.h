// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Volume, surface, centre and inertia of a convex core swept by a ball, in closed form.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/rounded_core.h"

namespace eccentra::shape {

/// Steiner's formulas, and their counterparts for the first and second moments: the body is the core, a prism on each
/// face, a wedge of a cylinder on each edge and a sector of a ball on each vertex. Sums over the wedges' arcs on the
/// unit sphere give the moments of the sectors. Exact to round-off. Frame of the core; lengths in m.
MassProperties rounded_mass(const ConvexCore& core, double radius);

/// The same for a disk, by slices across its axis, whose integrals are elementary.
MassProperties rounded_mass(const DiskCore& core, double radius);

} // namespace eccentra::shape
