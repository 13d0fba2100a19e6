// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of fix particletemplate/cluster.
#include "base/option_reader.h"
#include "base/refusal.h"
#include "shape/shape_family.h"
#include "styles/bodies/fix_particletemplate_cluster.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace eccentra::styles {

namespace {

/// Keywords of stock templates that are passed on, with the number of values of each.
struct StockKeyword {
  const char* name;
  int values;
};
constexpr StockKeyword kStockKeywords[] = {{"atom_type", 1}, {"volume_limit", 1}, {"additional_group", 1}};

/// Keywords of stock templates that mean nothing for a cluster, and what to write instead.
struct OtherKeyword {
  const char* name;
  const char* remedy;
};
constexpr OtherKeyword kOtherKeywords[] = {
    {"radius", "write `diameter VALUE`, that of the sphere of equal volume"},
    {"relative", "sizes are lengths in m: leave it out"},
    {"region", "stock insertion never looks at a template's region: give the region to fix insert/*"},
    {"region_variable", "stock insertion never looks at a template's region: give the region to fix insert/*"},
    {"nspheres", "the shape counts its spheres itself: leave it out"},
    {"ntry", "mass and inertia are exact and need no tries: leave it out"},
    {"spheres", "write `shape file NAME.clump`"},
    {"spheres_different_types", "a body has one material: write `shape file NAME.clump` and atom_type"},
    {"scale", "write `shape file NAME.clump scale VALUE`, or a diameter"},
    {"bonded", "the spheres of a cluster are rigidly joined: leave it out"},
    {"type", "shapes are numbered by themselves: leave it out, or write atom_type for the material"},
    {"mass", "the mass is density times the volume of the shape: write `density constant VALUE`"},
    {"inertia_tensor", "inertia follows from the shape: leave it out"},
    {"use_volume", "mass, volume and density belong together: leave it out"},
    {"use_density", "mass, volume and density belong together: leave it out"},
    {"fflag", "all directions of motion are free: hold bodies with fix freeze, or leave it out"},
    {"tflag", "all directions of rotation are free: leave it out"},
};

template <class Keyword, std::size_t count>
const Keyword* find(const Keyword (&keywords)[count], const std::string& word) {
  const Keyword* found =
      std::find_if(std::begin(keywords), std::end(keywords), [&](const Keyword& known) { return word == known.name; });
  return found == std::end(keywords) ? nullptr : found;
}

/// Of a family of shapes, such as `scale`: it may follow `shape`, though stock has a keyword of the same name.
bool is_option_of_shapes(const std::string& word) {
  for (const shape::ShapeFamily& family : shape::shape_families())
    for (const shape::ShapeOption& option : family.options)
      if (word == option.name)
        return true;
  return false;
}

bool ends_shape(const std::string& word) {
  if (word == "shape" || word == "diameter" || word == "orientation" || word == "density")
    return true;
  return !is_option_of_shapes(word) && (find(kStockKeywords, word) || find(kOtherKeywords, word));
}

DensityDistribution read_density(base::OptionReader& reader) {
  using Kind = DensityDistribution::Kind;
  const std::string expected = "constant VALUE, uniform LEAST MOST or gaussian MEAN DEVIATION, in kg/m3, or lognormal "
                               "MEDIAN DEVIATION, whose deviation is that of the logarithm",
                    kind = reader.value(expected);
  if (kind == "constant")
    return {Kind::constant, reader.positive("the density [kg/m3]"), 0};
  if (kind == "uniform") {
    const double least = reader.positive("the least density [kg/m3]");
    const double most = reader.positive("the greatest density [kg/m3]");
    if (most < least)
      base::refuse("density uniform '{}' is less than '{}'; expected the least density first", most, least);
    return {Kind::uniform, (least + most) / 2, (most - least) / 2};
  }
  if (kind == "gaussian") {
    const double mean = reader.positive("the mean density [kg/m3]");
    const double deviation = reader.positive("the deviation [kg/m3]");
    if (mean <= DensityDistribution::kCut * deviation)
      base::refuse("density gaussian '{}' is more than a third of the mean: densities are drawn within "
                   "three deviations of the mean and must stay above 0; expected a smaller deviation",
                   deviation);
    return {Kind::gaussian, mean, deviation};
  }
  if (kind != "lognormal")
    base::refuse("keyword 'density': '{}' is not a distribution; expected {}", kind, expected);
  const double median = reader.positive("the median density [kg/m3]");
  const double deviation = reader.positive("the deviation of the logarithm");
  if (deviation > 1)
    base::refuse("density lognormal '{}' is above 1, which spreads densities over a factor of 400; expected "
                 "the deviation of the logarithm, such as 0.05",
                 deviation);
  constexpr double lightest = 20; // stock templates expect the mean of the logarithm here, such as 7.8
  if (median < lightest)
    base::refuse("density lognormal '{}' is below 20 kg/m3; expected the median density, not its logarithm", median);
  return {Kind::lognormal, median, deviation};
}

constexpr int kUsualClasses = 8, kMostClasses = 64;

int read_classes(base::OptionReader& reader) {
  if (!reader.more() || reader.peek() != "classes")
    return kUsualClasses;
  reader.keyword();
  const std::string expected = "a whole number from 1 to " + std::to_string(kMostClasses);
  const double classes = reader.number(expected);
  if (!(classes >= 1 && classes <= kMostClasses) || classes != std::floor(classes))
    base::refuse("keyword 'classes': '{}' is not {}", classes, expected);
  return static_cast<int>(classes);
}

std::vector<shape::SizeClass> read_sizes(base::OptionReader& reader, const std::string& kind) {
  shape::SizeBasis basis = shape::SizeBasis::number;
  if (reader.more() && (reader.peek() == "number" || reader.peek() == "mass"))
    basis = reader.choice({"number", "mass"}) == "mass" ? shape::SizeBasis::mass : shape::SizeBasis::number;
  const auto [of_first, of_second] =
      kind == "uniform"    ? std::pair("the least diameter [m]", "the greatest diameter [m]")
      : kind == "gaussian" ? std::pair("the mean diameter [m]", "the deviation [m]")
                           : std::pair("the median diameter [m]", "the deviation of the logarithm");
  const double first = reader.positive(of_first), second = reader.positive(of_second);
  const int classes = read_classes(reader);
  try {
    return kind == "uniform"    ? shape::uniform_sizes(basis, first, second, classes)
           : kind == "gaussian" ? shape::gaussian_sizes(basis, first, second, classes)
                                : shape::lognormal_sizes(basis, first, second, classes);
  } catch (const std::invalid_argument& problem) {
    base::refuse("diameter {}: {}", kind, problem.what());
  }
}

} // namespace

void TemplateArguments::read_diameter(base::OptionReader& reader) {
  const std::string length = "the diameter [m]";
  if (reader.at_number()) {
    diameter = reader.positive(length);
    return;
  }
  const std::string expected = "a diameter in m, or constant, uniform, gaussian, lognormal or sieve with its values",
                    kind = reader.value(expected);
  if (kind == "constant") // as stock writes a radius
    diameter = reader.positive(length);
  else if (kind == "sieve")
    sieve = reader.value("a file with rows of an aperture in m and the part of the mass that passes it in %");
  else if (kind == "uniform" || kind == "gaussian" || kind == "lognormal")
    set_sizes(read_sizes(reader, kind));
  else
    base::refuse("keyword 'diameter': '{}' is neither a length nor a distribution; expected {}", kind, expected);
}

void TemplateArguments::set_sizes(std::vector<shape::SizeClass> classes) {
  sizes = std::move(classes);
  diameter = sizes.front().diameter;
}

void TemplateArguments::read_sieve(const std::optional<std::string>& text) {
  if (!text)
    base::refuse("diameter sieve '{}' is not a file that can be read; expected rows of an aperture in m and the part "
                 "of the mass that passes it in %",
                 sieve);
  set_sizes(shape::sieve_sizes(*text, "diameter sieve '" + sieve + "'"));
}

TemplateArguments::TemplateArguments(const std::vector<std::string>& arguments) {
  constexpr int kFirst = 4; // after the id, the group, the style and the seed
  if (arguments.size() < kFirst)
    base::refuse("needs a seed, a density and a shape; expected ... SEED atom_type 1 density constant 2619 shape cube "
                 "64 diameter 6.35e-3");
  stock.assign(arguments.begin(), arguments.begin() + kFirst);
  base::OptionReader reader({arguments.begin() + kFirst, arguments.end()});
  bool have_density = false;
  while (reader.more()) {
    const std::string keyword = reader.keyword();
    if (const StockKeyword* passed_on = find(kStockKeywords, keyword)) {
      stock.push_back(keyword);
      for (int k = 0; k < passed_on->values; ++k)
        stock.push_back(reader.value("its value"));
    } else if (const OtherKeyword* other = find(kOtherKeywords, keyword)) {
      base::refuse("keyword '{}' of stock's templates is not one of clusters; {}", keyword, other->remedy);
    } else if (keyword == "density") {
      if (have_density)
        base::refuse("'density' stands twice; expected it once");
      have_density = true;
      density = read_density(reader);
      stock.insert(stock.end(), {"density", "constant", fmt::format("{}", density.mean())});
    } else if (keyword == "shape") {
      if (!shape_keywords.empty())
        base::refuse("'shape' stands twice; expected it once");
      while (reader.more() && !ends_shape(reader.peek()))
        shape_keywords.push_back(reader.keyword());
      if (shape_keywords.empty())
        base::refuse("nothing follows 'shape'; expected a shape, such as cube 64 or file NAME.clump");
    } else if (keyword == "diameter") {
      if (diameter > 0 || !sieve.empty())
        base::refuse("'diameter' stands twice; expected it once");
      read_diameter(reader);
    } else if (keyword == "orientation") {
      orientation =
          reader.choice({"random", "given"}) == "random" ? TemplateOrientation::random : TemplateOrientation::given;
    } else {
      reader.unknown("atom_type, density, volume_limit, additional_group, shape, diameter, orientation");
    }
  }
  if (!have_density)
    base::refuse("no density is given; expected `density constant VALUE`, that of the solid in kg/m3");
  if (shape_keywords.empty())
    base::refuse("no shape is given; expected one, for example `shape cube 64`");
}

} // namespace eccentra::styles
