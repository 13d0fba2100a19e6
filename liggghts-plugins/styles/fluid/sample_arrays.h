// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The per-atom arrays of samples, by quantity.
#pragma once

#include "link/flow_quantities.h"

namespace eccentra::fluid {

struct SampleArray {
  Quantity quantity;
  const char* name;
  int columns;
};
/// An array's id is its place here.
inline constexpr SampleArray kSampleArrays[] = {{kVelocity, "velocity", 3},
                                                {kFraction, "fraction", 1},
                                                {kPressureGradient, "pressure gradient", 3},
                                                {kStressDivergence, "stress divergence", 3},
                                                {kVorticity, "vorticity", 3}};

} // namespace eccentra::fluid
