// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A triangulated surface of a rounded body.
#pragma once

#include "shape/rounded_hull.h"
#include "shape/surface.h"

namespace eccentra::shape {

/// 8 n^2 triangles with the body's own mirror planes, body frame, scaled so that they enclose the body's volume [m].
Surface surface_of(const RoundedHull& body, int n);

} // namespace eccentra::shape
