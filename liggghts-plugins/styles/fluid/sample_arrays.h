// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The per-atom arrays of samples, by quantity.
#pragma once

#include "link/flow_quantities.h"

namespace eccentra::styles {

struct SampleArray {
  link::Quantity quantity;
  const char* name;
  int columns;
};
/// An array's id is its place here.
inline constexpr SampleArray kSampleArrays[] = {{link::kVelocity, "velocity", 3},
                                                {link::kFraction, "fraction", 1},
                                                {link::kPressureGradient, "pressure gradient", 3},
                                                {link::kStressDivergence, "stress divergence", 3},
                                                {link::kVorticity, "vorticity", 3}};

} // namespace eccentra::styles
