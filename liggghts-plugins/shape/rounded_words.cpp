// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a form and its options to a rounded body of its size.
#include "shape/rounded_words.h"

#include "base/refusal.h"
#include "shape/rounded_moments.h"
#include "shape/shape_keywords.h"

#include <cmath>
#include <utility>

namespace eccentra::shape {
namespace {

HullReader reader_of_files = nullptr;

/// Less rounding leaves no radius for contacts: overlaps would exceed it.
constexpr double min_rounding = 0.01;

MassProperties mass_of(const Swept& swept) {
  return std::visit([&](const auto& core) { return rounded_mass(core, swept.radius); }, swept.core);
}

double sphericity_of(const Swept& swept) {
  const MassProperties p = mass_of(swept);
  return std::cbrt(36 * M_PI * p.volume * p.volume) / p.surface;
}

/// The rounding with which a form has this sphericity.
double rounding_for(const RoundedForm& form, double sphericity) {
  double low = min_rounding, high = 1;
  const double least = sphericity_of(form.body(low)), most = sphericity_of(form.body(high));
  if (sphericity < least || sphericity > most)
    base::refuse("shape {}: sphericity: '{}' is not one that it has with a rounding from {} to 1; expected a number "
                 "from {:.4f} to {:.4f}",
                 form.name, sphericity, min_rounding, least, most);
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (sphericity_of(form.body(middle)) < sphericity ? low : high) = middle;
  }
  return (low + high) / 2;
}

} // namespace

RoundedOptions read_rounded_options(base::OptionReader& reader, const std::string& name, bool of_file) {
  RoundedOptions o;
  const std::pair<const char*, double*> known[] = {{"rounding", &o.rounding},
                                                   {"sphericity", &o.sphericity},
                                                   {"contact_radius", &o.contact_radius},
                                                   {"scale", &o.scale}};
  while (reader.more()) {
    double* value = nullptr;
    for (const auto& [word, place] : known)
      if (reader.peek() == word && (place != &o.scale || of_file))
        value = place;
    if (!value)
      break;
    const std::string word = reader.keyword();
    if (*value > 0)
      base::refuse("shape {}: '{}' is not given once; expected one value: leave one of them out", name, word);
    *value = value == &o.rounding ? reader.at_least(min_rounding) : reader.positive();
    if ((value == &o.rounding || value == &o.sphericity) && *value > 1)
      base::refuse("keyword '{}': '{}' is not at most 1, which is a ball; expected a number up to 1", word, *value);
  }
  if (o.rounding > 0 && o.sphericity > 0)
    base::refuse("shape {}: 'rounding' and 'sphericity' are not both free; expected one of the two", name);
  if (o.rounding == 0 && o.sphericity == 0)
    base::refuse("shape {}: 'rounding R' is not given; expected the radius of edges and corners over half the smallest "
                 "extent, {} to 1, or 'sphericity S'",
                 name, min_rounding);
  return o;
}

ClusterShape make_rounded(const RoundedForm& form, const RoundedOptions& options, double diameter) {
  if (!std::isfinite(diameter))
    base::refuse("shape {}: diameter: '{}' is not a finite number; expected metres", form.name, diameter);
  if (diameter <= 0 && !form.own_size)
    base::refuse("shape {} has no size of its own; expected the diameter [m] of the sphere of equal volume, > 0",
                 form.name);
  const double rounding = options.rounding > 0 ? options.rounding : rounding_for(form, options.sphericity);
  Swept swept = form.body(rounding);
  if (diameter > 0) {
    const double scale = scale_to_diameter(mass_of(swept).volume, diameter);
    swept.core = scaled(swept.core, scale);
    swept.radius *= scale;
  }
  RoundedHull hull(fmt::format("{} rounding {:.6g}", form.name, rounding), swept.core, swept.radius);
  if (options.contact_radius > 0)
    hull.set_contact_radius(options.contact_radius);
  return ClusterShape(hull);
}

RoundedForm form_of_core(std::string name, const ConvexCore& core) {
  const double width = least_width(core);
  return {std::move(name),
          [core, width](double rounding) -> Swept {
            return {scaled(core, 1 - rounding), rounding * width / 2};
          },
          true};
}

void install_hull_reader(HullReader reader) {
  reader_of_files = reader;
}

HullReader hull_reader() {
  return reader_of_files;
}

} // namespace eccentra::shape
