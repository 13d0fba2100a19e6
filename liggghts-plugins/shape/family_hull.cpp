// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `hull NAME.stl ...`: rounded convex hulls of files.
#include "base/refusal.h"
#include "shape/rounded_words.h"
#include "shape/shape_family.h"

namespace eccentra::shape {
namespace {

ClusterShape make(const ShapeRequest& request, std::size_t& used, Notes& notes) {
  base::OptionReader reader(
      {request.arguments.begin() + static_cast<std::ptrdiff_t>(request.first), request.arguments.end()});
  reader.keyword();
  const std::string path = reader.value("the name of an STL file"), name = "hull " + path;
  const RoundedOptions options = read_rounded_options(reader, name, true);
  used = reader.at();
  if (!hull_reader())
    base::refuse("shape {}: STL files are not read here, because this program has no reader of them; expected "
                 "eccentra-dem, liggghts with libeccentra, or clusterShape",
                 name);
  const HullOfFile file = hull_reader()(path, options.scale > 0 ? options.scale : 1);
  if (!file.remark.empty())
    notes.push_back({file.remark});
  return make_rounded(form_of_core(name, file.core), options, request.diameter);
}

} // namespace

ShapeFamily family_hull() {
  ShapeFamily family{"hull", "hull NAME.stl rounding R | sphericity S [contact_radius C] [scale L]", true, make};
  family.options = {{"scale", "multiply the lengths of a file, e.g. 1e-3 for millimetres"}};
  return family;
}

} // namespace eccentra::shape
