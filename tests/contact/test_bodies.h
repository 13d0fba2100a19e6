// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Polyhedra for the tests of rounded bodies.
#pragma once

#include "shape/convex_hull.h"
#include "shape/rounded_hull.h"

namespace small_dem {
using eccentra::shape::RoundedHull;

constexpr double diameter = 6.35e-3;

inline RoundedHull wedge() {
  const double c = 2.2e-3;
  return {"wedge",
          eccentra::shape::convex_hull({{-c, -c, -c},
                                        {c, -c, -c},
                                        {0.3 * c, 1.2 * c, -c},
                                        {-c, -c, c},
                                        {c, -c, 0.7 * c},
                                        {0.3 * c, 1.2 * c, 0.35 * 0.7 * c + 0.2285 * c}}),
          0.3e-3};
}
inline RoundedHull octahedron() {
  const double c = 2.6e-3;
  return {"octahedron",
          eccentra::shape::convex_hull({{c, 0, 0}, {-c, 0, 0}, {0, c, 0}, {0, -c, 0}, {0, 0, c}, {0, 0, -c}}), 0.4e-3};
}

} // namespace small_dem
