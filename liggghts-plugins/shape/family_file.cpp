// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `file NAME.clump`: spheres and, where the file states them, mass properties.
#include "shape/clump_file.h"
#include "shape/coincident_spheres.h"
#include "shape/shape_family.h"
#include "shape/shape_keywords.h"
#include "shape/union_geometry.h"

namespace eccentra::shape {
namespace {

ClusterShape make(base::OptionReader& words, double diameter, Notes& notes) {
  const std::string path = words.value("the name of a .clump file");
  double scale = 0; // not given
  if (words.more() && words.peek() == "scale") {
    words.keyword();
    scale = words.positive();
  }
  const std::string where = "clump file '" + path + "'";
  Clump clump = read_clump(path);
  merge_coincident(clump.spheres, where, notes);
  require_connected(clump.spheres);
  MassProperties p = clump.chosen ? *clump.chosen : measure_union(clump.spheres).properties;
  resize(clump.spheres, p, diameter > 0 ? scale_to_diameter(p.volume, diameter) : scale > 0 ? scale : 1);
  if (diameter <= 0 && scale == 0)
    note_size(clump.spheres, where, notes);
  return ClusterShape(path, std::move(clump.spheres), p);
}

} // namespace

ShapeFamily family_file() {
  ShapeFamily family{"file", "file NAME.clump [scale S]", true, make};
  family.extensions = ".clump";
  family.options = {{"scale", "multiply the lengths of a file, e.g. 1e-3 for millimetres"}};
  return family;
}

} // namespace eccentra::shape
