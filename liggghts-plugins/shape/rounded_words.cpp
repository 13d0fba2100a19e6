// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From arguments to rounded bodies: outer extents, rounding or sphericity, size.
#include "shape/rounded_words.h"

#include "shape/rounded_moments.h"
#include "shape/shape_keywords.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>

namespace eccentra::shape {
namespace {

using Eigen::Vector3d;

HullReader hull_reader = nullptr;

/// Less rounding leaves no radius for contacts: overlaps would exceed it.
constexpr double min_rounding = 0.01;

/// A core and a ball; of a family of bodies, one for each rounding.
struct Swept {
  RoundedHull::Core core;
  double radius;
};
using Family = std::function<Swept(double rounding)>;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Family box_family(const Vector3d& edges) {
  const Vector3d half = edges / 2;
  return [half](double rounding) -> Swept {
    const double r = rounding * half.minCoeff();
    const Vector3d core = half - Vector3d::Constant(r);
    return {box_core(core.cwiseMax(0)), r};
  };
}

Family disk_family(double aspect) {
  return [aspect](double rounding) -> Swept {
    const double r = rounding * std::min(aspect, 1.);
    const double half_height = std::max(0., aspect - r);
    if (r == 1) // a rod with round ends, or a ball
      return {box_core({0, 0, half_height}), r};
    return {DiskCore{1 - r, half_height}, r};
  };
}

/// The core is the hull on a smaller scale, so that the least width of the rounded body is that of the hull.
Family hull_family(const ConvexCore& hull) {
  const double width = least_width(hull);
  return [hull, width](double rounding) -> Swept { return {scaled(hull, 1 - rounding), rounding * width / 2}; };
}

double sphericity_of(const Swept& swept) {
  const MassProperties p = std::visit([&](const auto& c) { return rounded_mass(c, swept.radius); }, swept.core);
  return std::cbrt(36 * M_PI * p.volume * p.volume) / p.surface;
}

/// The rounding with which a family has this sphericity.
double rounding_for(const Family& family, double sphericity, const std::string& what) {
  double low = min_rounding, high = 1;
  const double least = sphericity_of(family(low)), most = sphericity_of(family(high));
  if (sphericity < least || sphericity > most)
    throw std::invalid_argument("sphericity of " + what + " is '" + number(sphericity) + "': with a rounding from " +
                                number(min_rounding) + " to 1 it can be " + number(least) + " to " + number(most));
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (sphericity_of(family(middle)) < sphericity ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// What may follow the body's own arguments, in any order.
struct Options {
  double rounding = 0, sphericity = 0, contact_radius = 0, scale = 0;
};

Options read_options(const std::vector<std::string>& arguments, std::size_t& at, const std::string& what,
                     bool of_file) {
  Options o;
  for (;;) {
    double* value = nullptr;
    const std::string word = at < arguments.size() ? arguments[at] : "";
    if (word == "rounding")
      value = &o.rounding;
    else if (word == "sphericity")
      value = &o.sphericity;
    else if (word == "contact_radius")
      value = &o.contact_radius;
    else if (word == "scale" && of_file)
      value = &o.scale;
    else
      break;
    if (*value > 0)
      throw std::invalid_argument(word + " of " + what + " is given twice: give it once");
    *value = positive_number(word_at(arguments, at + 1, "a number after '" + word + "'"), word + " of " + what);
    at += 2;
  }
  if ((o.rounding > 0) == (o.sphericity > 0))
    throw std::invalid_argument(
        what + (o.rounding > 0 ? " has both a rounding and a sphericity: give one of the two"
                               : " has no rounding: write `rounding R` (0.01 to 1, radius of edges and corners over "
                                 "half the smallest extent) or `sphericity S` after it"));
  if (o.rounding > 0 && (o.rounding < min_rounding || o.rounding > 1))
    throw std::invalid_argument("rounding of " + what + " is '" + number(o.rounding) +
                                "': give a number from 0.01 to 1");
  if (o.sphericity > 1)
    throw std::invalid_argument("sphericity of " + what + " is '" + number(o.sphericity) +
                                "': give a number up to 1, that of a sphere");
  return o;
}

} // namespace

bool is_rounded_word(const std::string& word) {
  return word == "smooth" || word == "hull";
}

void install_hull_reader(HullReader reader) {
  hull_reader = reader;
}

RoundedShape make_rounded(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                          double diameter) {
  if (!std::isfinite(diameter))
    throw std::invalid_argument("the diameter of a shape must be a finite number");
  std::size_t at = first;
  std::string name = word_at(arguments, at++, "smooth or hull"), remark;
  const bool of_file = name == "hull";
  bool has_size = of_file;
  Family family;
  std::string path;
  if (of_file) {
    path = word_at(arguments, at++, "the name of an STL file after 'hull'");
    name += " " + path;
  } else if (name == "smooth") {
    const std::string kind = word_at(arguments, at++, "cube, box or disk after 'smooth'");
    name += " " + kind;
    if (kind == "cube") {
      family = box_family(Vector3d::Constant(2));
    } else if (kind == "box") {
      Vector3d edges;
      for (int k = 0; k < 3; ++k) {
        const std::string& word = word_at(arguments, at++, "the three edges after 'smooth box'");
        edges[k] = positive_number(word, "edge of shape smooth box");
        name += " " + word;
      }
      family = box_family(edges);
      has_size = true;
    } else if (kind == "disk") {
      const std::string& word = word_at(arguments, at++, "'aspect H' after 'smooth disk'");
      if (word != "aspect")
        throw std::invalid_argument("after 'smooth disk' comes '" + word +
                                    "': write `aspect H`, thickness over diameter");
      const std::string& aspect = word_at(arguments, at++, "a number after 'aspect'");
      family = disk_family(positive_number(aspect, "aspect of shape smooth disk"));
      name += " aspect " + aspect;
    } else {
      throw std::invalid_argument("there is no shape 'smooth " + kind +
                                  "': write smooth cube, smooth box A B C or smooth disk aspect H");
    }
  } else {
    throw std::invalid_argument("shape '" + name + "' is no rounded body: those begin with smooth or hull");
  }
  const Options options = read_options(arguments, at, "shape " + name, of_file);
  if (of_file) {
    if (!hull_reader)
      throw std::invalid_argument("shape hull '" + path +
                                  "' is not read here: this program has no reader of STL files");
    HullOfFile file = hull_reader(path, options.scale > 0 ? options.scale : 1);
    family = hull_family(file.core);
    remark = std::move(file.remark);
  }
  if (diameter <= 0 && !has_size)
    throw std::invalid_argument("shape " + name +
                                " has no size of its own: give the diameter [m] of the sphere of equal volume, > 0");
  const double rounding =
      options.rounding > 0 ? options.rounding : rounding_for(family, options.sphericity, "shape " + name);
  Swept swept = family(rounding);
  if (diameter > 0) {
    const double volume = std::visit([&](const auto& c) { return rounded_mass(c, swept.radius).volume; }, swept.core);
    const double scale = diameter / std::cbrt(6 * volume / M_PI);
    swept.core = scaled(swept.core, scale);
    swept.radius *= scale;
  }
  RoundedShape shape{RoundedHull(name + " rounding " + number(rounding), swept.core, swept.radius), remark};
  if (options.contact_radius > 0)
    shape.hull.set_contact_radius(options.contact_radius);
  used = at - first;
  return shape;
}

} // namespace eccentra::shape
