// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `hull NAME.stl ...`: rounded convex hulls of files.
#include "base/refusal.h"
#include "shape/rounded_words.h"
#include "shape/shape_family.h"

namespace eccentra::shape {
namespace {

ClusterShape make(base::OptionReader& words, double diameter, Notes& notes) {
  const std::string path = words.value("the name of an STL file"), name = "hull " + path;
  const RoundedOptions options = read_rounded_options(words, name, true);
  if (!hull_reader())
    base::refuse("shape {}: STL files are not read here, because this program has no reader of them; expected "
                 "eccentra-dem, liggghts with libeccentra, or clusterShape",
                 name);
  const HullOfFile file = hull_reader()(path, options.scale > 0 ? options.scale : 1);
  if (!file.remark.empty())
    notes.push_back({file.remark});
  return make_rounded(form_of_core(name, file.core), options, diameter);
}

} // namespace

ShapeFamily family_hull() {
  ShapeFamily family{"hull", "hull NAME.stl rounding R | sphericity S [contact_radius C] [scale L]", true, make};
  family.options = {{"scale", "multiply the lengths of a file, e.g. 1e-3 for millimetres"}};
  return family;
}

} // namespace eccentra::shape
