// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `file NAME.clump`: spheres and, where the file states them, mass properties.
#include "shape/clump_file.h"
#include "shape/coincident_spheres.h"
#include "shape/shape_family.h"
#include "shape/shape_keywords.h"
#include "shape/union_geometry.h"

#include <cmath>

namespace eccentra::shape {
namespace {

ClusterShape make(const ShapeRequest& request, std::size_t& used, Notes& notes) {
  const std::string& path = request.word(1, "the name of a .clump file after 'file'");
  double scale = 1;
  used = 2;
  const std::size_t next = request.first + used;
  if (next < request.arguments.size() && request.arguments[next] == "scale") {
    scale = positive_number(request.word(3, "a number after 'scale'"), "scale of '" + path + "'");
    used = 4;
  }
  const std::string where = "clump file '" + path + "'";
  Clump clump = read_clump(path);
  merge_coincident(clump.spheres, where, notes);
  require_connected(clump.spheres);
  MassProperties p = clump.chosen ? *clump.chosen : measure_union(clump.spheres).properties;
  resize(clump.spheres, p, request.diameter > 0 ? scale_to_diameter(p.volume, request.diameter) : scale);
  if (request.diameter <= 0 && used == 2)
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
