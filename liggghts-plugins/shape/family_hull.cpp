// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `hull NAME.stl ...`: rounded convex hulls of files.
#include "shape/rounded_words.h"
#include "shape/shape_family.h"

namespace eccentra::shape {
namespace {

ClusterShape make(const ShapeRequest& request, std::size_t& used, Notes& notes) {
  const RoundedShape shape = make_rounded(request.arguments, request.first, used, request.diameter);
  if (!shape.remark.empty())
    notes.push_back({shape.remark});
  return ClusterShape(shape.hull);
}

} // namespace

ShapeFamily family_hull() {
  return {"hull", "hull NAME.stl rounding R | sphericity S [scale S]", true, make};
}

} // namespace eccentra::shape
