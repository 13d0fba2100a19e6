// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `smooth ...`: rounded cubes, boxes and disks.
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

ShapeFamily family_smooth() {
  return {"smooth", "smooth cube | box A B C | disk aspect H, then rounding R | sphericity S", true, make};
}

} // namespace eccentra::shape
