// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `disk N`: one layer of rings of spheres about the z axis.
#include "base/refusal.h"
#include "shape/shape_family.h"
#include "shape/shape_keywords.h"

#include <cmath>

namespace eccentra::shape {
namespace {

/// Radius of a sphere over that of the outermost ring: sphericities 0.68, 0.75 and 0.79 of Akhshik, Behzad & Rajabi
/// (2016), Table 1.
constexpr double kRatio7 = 0.59239, kRatio19 = 0.47127, kRatio48 = 0.4476;

struct Ring {
  int count;
  double radius; ///< in units of the outermost ring's
};

/// Cosine of index/count of a turn, exactly symmetric in the quadrants so that the shape is, too.
double cosine_of_turn(int index, int count) {
  index = ((index % count) + count) % count;
  if (2 * index > count)
    index = count - index;
  if (4 * index == count)
    return 0;
  return 4 * index > count ? -std::cos(2 * M_PI * (count - 2 * index) / (2 * count))
                           : std::cos(2 * M_PI * index / count);
}

std::vector<Sphere> rings(const std::vector<Ring>& layout, double ratio) {
  std::vector<Sphere> spheres;
  for (const Ring& ring : layout)
    for (int k = 0; k < ring.count; ++k) {
      // sin(t) = cos(t - quarter turn), in quarters of the ring's own steps
      const double c = cosine_of_turn(4 * k, 4 * ring.count), s = cosine_of_turn(4 * k - ring.count, 4 * ring.count);
      spheres.push_back({Eigen::Vector3d(ring.radius * c, ring.radius * s, 0), ratio});
    }
  return spheres;
}

std::vector<Sphere> spheres_of(int count) {
  switch (count) {
  case 7:
    return rings({{1, 0}, {6, 1}}, kRatio7);
  case 19:
    return rings({{1, 0}, {6, 0.5}, {12, 1}}, kRatio19);
  case 48:
    return rings({{8, 1 / 3.0}, {16, 2 / 3.0}, {24, 1}}, kRatio48);
  }
  base::refuse("shape 'disk {}' does not exist; expected 7, 19 or 48", count);
}

ClusterShape make(base::OptionReader& words, double diameter, Notes&) {
  const int count = words.count(1, "spheres");
  return sized_shape("disk " + std::to_string(count), spheres_of(count), diameter);
}

} // namespace

ShapeFamily family_disk() {
  ShapeFamily family{"disk", "disk 7|19|48", false, make};
  family.known = {{{"disk", "7"}, "disk (D7): centre and a ring of 6"},
                  {{"disk", "19"}, "disk (D19): centre and rings of 6 and 12"},
                  {{"disk", "48"}, "disk (D48): rings of 8, 16 and 24"}};
  family.levels = {{"sphere", "1"}, {"disk", "7"}, {"disk", "19"}, {"disk", "48"}};
  return family;
}

} // namespace eccentra::shape
