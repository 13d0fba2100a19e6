// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes `smooth ...`: rounded cubes, boxes and disks.
#include "base/refusal.h"
#include "shape/rounded_words.h"
#include "shape/shape_family.h"

#include <algorithm>

namespace eccentra::shape {
namespace {

using Eigen::Vector3d;

RoundedForm box_form(const std::string& name, const Vector3d& edges, bool own_size) {
  const Vector3d half = edges / 2;
  return {name,
          [half](double rounding) -> Swept {
            const double r = rounding * half.minCoeff();
            const Vector3d core = half - Vector3d::Constant(r);
            return {box_core(core.cwiseMax(0)), r};
          },
          own_size};
}

RoundedForm cube(base::OptionReader&) {
  return box_form("smooth cube", Vector3d::Constant(2), false);
}

/// Outer edges [m], or their proportions.
RoundedForm box(base::OptionReader& reader) {
  std::string name = "smooth box";
  Vector3d edges;
  for (int k = 0; k < 3; ++k) {
    const std::string word = reader.more() ? reader.peek() : "";
    edges[k] = reader.positive("an edge of the box");
    name += " " + word;
  }
  return box_form(name, edges, true);
}

/// `aspect H`, thickness over diameter.
RoundedForm disk(base::OptionReader& reader) {
  if (!reader.more() || reader.peek() != "aspect")
    base::refuse("shape smooth disk: '{}' is not 'aspect'; expected aspect H, thickness over diameter",
                 reader.more() ? reader.peek() : "");
  reader.keyword();
  const std::string word = reader.more() ? reader.peek() : "";
  const double aspect = reader.positive("thickness over diameter");
  return {"smooth disk aspect " + word,
          [aspect](double rounding) -> Swept {
            const double r = rounding * std::min(aspect, 1.), half_height = std::max(0., aspect - r);
            if (r == 1) // a rod with round ends, or a ball
              return {box_core({0, 0, half_height}), r};
            return {DiskCore{1 - r, half_height}, r};
          },
          false};
}

constexpr struct {
  const char* name;
  RoundedForm (*form)(base::OptionReader& reader);
} forms[] = {{"cube", cube}, {"box", box}, {"disk", disk}};

ClusterShape make(base::OptionReader& words, double diameter, Notes&) {
  const std::string& kind = words.value("cube, box or disk");
  for (const auto& known : forms)
    if (kind == known.name) {
      const RoundedForm form = known.form(words);
      return make_rounded(form, read_rounded_options(words, form.name, false), diameter);
    }
  base::refuse("keyword 'smooth': '{}' is unknown; expected cube, box or disk", kind);
}

} // namespace

ShapeFamily family_smooth() {
  return {"smooth", "smooth cube | box A B C | disk aspect H, then rounding R | sphericity S [contact_radius C]", true,
          make};
}

} // namespace eccentra::shape
