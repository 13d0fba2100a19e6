// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `cube N`: lattices of n x n x n spheres.
#include "base/refusal.h"
#include "shape/shape_family.h"
#include "shape/shape_keywords.h"

#include <cmath>

namespace eccentra::shape {
namespace {

/// Radius over spacing, on which the sphericity of the union alone depends: 0.91, 0.87 and 0.85 of Akhshik, Behzad &
/// Rajabi (2016), Table 1; larger cubes keep the last.
constexpr double kRatio8 = 0.97403, kRatio27 = 0.99674, kRatio64 = 1.02872;
/// Spheres along an edge of the largest cube.
constexpr int kMaxEdge = 16;

ClusterShape make(base::OptionReader& words, double diameter, Notes&) {
  const int count = words.count(1, "spheres"), edge = static_cast<int>(std::lround(std::cbrt(count)));
  if (edge < 1 || edge > kMaxEdge || edge * edge * edge != count)
    base::refuse("shape 'cube {}' does not exist; expected n^3: 8, 27, 64 to {}", count,
                 kMaxEdge * kMaxEdge * kMaxEdge);
  const double ratio = edge <= 2 ? kRatio8 : edge == 3 ? kRatio27 : kRatio64, middle = (edge - 1) / 2.0;
  std::vector<Sphere> spheres;
  for (int i = 0; i < edge; ++i)
    for (int j = 0; j < edge; ++j)
      for (int k = 0; k < edge; ++k)
        spheres.push_back({Eigen::Vector3d(i - middle, j - middle, k - middle), ratio});
  return sized_shape("cube " + std::to_string(count), std::move(spheres), diameter);
}

} // namespace

ShapeFamily family_cube() {
  ShapeFamily family{"cube", "cube 8|27|64|n^3", false, make};
  family.known = {{{"cube", "8"}, "cube (C8): 2 x 2 x 2 lattice"},
                  {{"cube", "27"}, "cube (C27): 3 x 3 x 3 lattice"},
                  {{"cube", "64"}, "cube (C64): 4 x 4 x 4 lattice; n^3 up to n = " + std::to_string(kMaxEdge)}};
  family.levels = {{"sphere", "1"}, {"cube", "8"}, {"cube", "27"}, {"cube", "64"}, {"cube", "125"}, {"cube", "216"}};
  return family;
}

} // namespace eccentra::shape
