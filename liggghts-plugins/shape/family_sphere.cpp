// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `sphere 1` and `sphere 6`.
#include "base/refusal.h"
#include "shape/shape_family.h"
#include "shape/shape_keywords.h"

namespace eccentra::shape {
namespace {

/// Radius over the centres' distance from the middle: sphericity 0.98 of Akhshik, Behzad & Rajabi (2016), Table 1.
constexpr double kRatio = 2.604;

ClusterShape make(base::OptionReader& words, double diameter, Notes&) {
  const int count = words.count(1, "spheres");
  std::vector<Sphere> spheres;
  if (count == 1)
    spheres.push_back({Eigen::Vector3d::Zero(), 1});
  else if (count == 6)
    for (int axis = 0; axis < 3; ++axis)
      for (double side : {-1.0, 1.0})
        spheres.push_back({side * Eigen::Vector3d::Unit(axis), kRatio});
  else
    base::refuse("shape 'sphere {}' does not exist; expected 1 or 6", count);
  return sized_shape("sphere " + std::to_string(count), std::move(spheres), diameter);
}

} // namespace

ShapeFamily family_sphere() {
  ShapeFamily family{"sphere", "sphere 1|6", false, make};
  family.known = {{{"sphere", "1"}, "smooth sphere (S1)"},
                  {{"sphere", "6"}, "non-smooth sphere (S6): six spheres on an octahedron"}};
  return family;
}

} // namespace eccentra::shape
