// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Chien's drag as one would write it for one purpose only: the yardstick for what composition costs.
#pragma once

#include "closures/effect.h"
#include "closures/rheology.h"

namespace eccentra::test {

/// Implicit Chien drag on spheres in a Herschel-Bulkley fluid; adds to forces, impulse and coefficient as DragEffect
/// does. Returns the sum of the forces along z.
double hand_written_drag(const closures::HalfStep& half_step, const closures::Rheology& fluid);

} // namespace eccentra::test
