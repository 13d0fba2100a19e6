// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How long and how sharply a screen looks at the effects.
#pragma once

namespace eccentra::closures {

/// Options of the keyword `screen` of fix fluid/force.
struct ScreenOptions {
  double tolerance = 0.0; ///< 0: no screen
  int steps = 1000;       ///< length of the measurement
  int recheck = 100000;   ///< steps from a verdict to the next measurement; 0: never again
};

} // namespace eccentra::closures
