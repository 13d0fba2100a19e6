// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The hull of a solid, compared with the solid.
#include "shape/vtk/hull_of_stl.h"

#include "shape/convex_hull.h"
#include "shape/rounded_moments.h"
#include "shape/vtk/solid.h"

#include <cmath>
#include <cstdio>

namespace eccentra::shape {
namespace {

/// A hull that has more volume than its solid by this part: the solid has a hollow, however small.
constexpr double negligible_hollow = 1e-4;

std::string percent(double part) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * part);
  return text;
}

} // namespace

HullOfFile hull_of_stl(const std::string& path, double scale) {
  const Solid solid(path, scale);
  const ConvexCore whole = convex_hull(solid.vertices());
  HullOfFile file;
  const double volume = rounded_mass(whole, 0).volume, hollow = 1 - solid.properties().volume / volume;
  if (hollow > negligible_hollow)
    file.remark = "STL file '" + path + "' is not convex: " + percent(hollow) + " of its convex hull is empty";
  if (whole.vertices.size() <= max_hull_vertices) {
    file.core = whole;
    return file;
  }
  ThinnedHull thinned = thinned_hull(solid.vertices());
  if (!file.remark.empty())
    file.remark += "; ";
  file.remark += "the hull of STL file '" + path + "' has " + std::to_string(whole.vertices.size()) +
                 " vertices, of which " + std::to_string(thinned.core.vertices.size()) + " are kept: it loses " +
                 percent(1 - rounded_mass(thinned.core, 0).volume / volume) + " of its volume";
  file.core = std::move(thinned.core);
  return file;
}

void install_hull_words() {
  install_hull_reader(hull_of_stl);
}

} // namespace eccentra::shape
