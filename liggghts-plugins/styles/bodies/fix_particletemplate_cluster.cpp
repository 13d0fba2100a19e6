// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of fix particletemplate/cluster and fills what stock fix insert/* places.
#include "styles/bodies/fix_particletemplate_cluster.h"

#include "base/option_reader.h"
#include "shape/shape_keywords.h"
#include "styles/bodies/cluster_to_insert.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/printed_notes.h"
#include "styles/entry/shared_text.h"
#include "styles/entry/style_registry.h"

#include "error.h"
#include "lammps.h"
#include "math_extra_liggghts.h"
#include "memory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;
using namespace LMP_PROBABILITY_NS;

namespace {

constexpr const char* style = "particletemplate/cluster";

Fix* create_template(LAMMPS* lmp, int narg, char** arg) {
  return new FixParticletemplateCluster(lmp, TemplateArguments(lmp, narg, arg));
}

const RegisterStyle registered({"fix", style, "a cluster of spheres for fix insert/*: one body, one atom",
                                &create_template});

[[noreturn]] void fail(LAMMPS* lmp, const char* id, const std::string& sentence) {
  lmp->error->all(FLERR, ("fix " + std::string(id) + " " + style + ": " + sentence).c_str());
  std::abort(); // not reached: error->all ends the run
}

/// Keywords of stock templates that we pass on, with the number of arguments each takes.
struct StockKeyword {
  const char* name;
  int arguments;
};
constexpr StockKeyword stock_keywords[] = {{"atom_type", 2}, {"volume_limit", 2}, {"additional_group", 2}};

/// Keywords of stock's templates that mean nothing for a cluster, and what to write instead.
struct OtherKeyword {
  const char* name;
  const char* remedy;
};
constexpr OtherKeyword other_keywords[] = {
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

bool is_keyword(const std::string& word) {
  for (const StockKeyword& keyword : stock_keywords)
    if (word == keyword.name)
      return true;
  for (const char* of_shapes : {"scale", "spheres", "mass"}) // of `shape file` and `shape stl`, too
    if (word == of_shapes)
      return false;
  for (const OtherKeyword& keyword : other_keywords)
    if (word == keyword.name)
      return true;
  return word == "shape" || word == "diameter" || word == "orientation" || word == "density";
}

bool is_number(const char* word, double& value) {
  const std::optional<double> read = base::finite_number(word);
  value = read.value_or(0);
  return read.has_value();
}

} // namespace

namespace {

constexpr double kCut = 3; // deviations of a bell
constexpr int kUsualClasses = 8, kMostClasses = 64;

} // namespace

double DensityDistribution::mean() const {
  if (kind != Kind::lognormal)
    return middle;
  const auto within = [](double deviations) { return std::erf(deviations / std::sqrt(2.0)); };
  return middle * std::exp(0.5 * width * width) * (within(kCut - width) + within(kCut + width)) / (2 * within(kCut));
}

double DensityDistribution::draw(RanPark& random) const {
  if (kind == Kind::uniform)
    return middle + width * (2 * random.uniform() - 1);
  double deviation = 0;
  if (kind != Kind::constant)
    do
      deviation = random.gaussian();
    while (std::fabs(deviation) > kCut);
  return kind == Kind::lognormal ? middle * std::exp(width * deviation) : middle + width * deviation;
}

/// Reads the arguments after `density`, which stands at `at`; returns the place of the next keyword.
int TemplateArguments::read_density(int narg, char** arg, int at, const Refuse& refuse) {
  const std::string expected = "expected constant VALUE, uniform LEAST MOST or gaussian MEAN DEVIATION, in kg/m3, or "
                               "lognormal MEDIAN DEVIATION, "
                               "whose deviation is that of the logarithm";
  const std::string kind = at + 1 < narg ? arg[at + 1] : "";
  if (kind != "constant" && kind != "uniform" && kind != "gaussian" && kind != "lognormal")
    refuse("density '" + kind + "' is not a distribution; " + expected);
  const int count = kind == "constant" ? 1 : 2;
  double value[2] = {0, 0};
  for (int k = 0; k < count; ++k) {
    const char* word = at + 2 + k < narg ? arg[at + 2 + k] : "";
    if (!is_number(word, value[k]) || !(value[k] > 0))
      refuse("density " + kind + " '" + word + "' is not a number greater than 0; " + expected);
  }
  density.middle = value[0];
  if (kind == "uniform") {
    if (value[1] < value[0])
      refuse("density uniform '" + std::string(arg[at + 3]) + "' is less than '" + arg[at + 2] +
             "'; expected the least density first");
    density = {DensityDistribution::Kind::uniform, (value[0] + value[1]) / 2, (value[1] - value[0]) / 2};
  } else if (kind == "gaussian") {
    if (value[0] <= 3 * value[1])
      refuse("density gaussian '" + std::string(arg[at + 3]) +
             "' is more than a third of the mean: densities are drawn within three deviations of the mean and must "
             "stay above 0; expected a smaller deviation");
    density = {DensityDistribution::Kind::gaussian, value[0], value[1]};
  } else if (kind == "lognormal") {
    if (value[1] > 1)
      refuse(
          "density lognormal '" + std::string(arg[at + 3]) +
          "' is above 1, which spreads densities over a factor of 400; expected the deviation of the logarithm, such "
          "as 0.05");
    constexpr double lightest = 20; // stock templates expect the mean of the logarithm here, such as 7.8
    if (value[0] < lightest)
      refuse("density lognormal '" + std::string(arg[at + 2]) +
             "' is below 20 kg/m3; expected the median density, not its logarithm");
    density = {DensityDistribution::Kind::lognormal, value[0], value[1]};
  }
  char mean[32];
  std::snprintf(mean, sizeof mean, "%.17g", density.mean());
  for (const char* word : {"density", "constant", static_cast<const char*>(mean)})
    stock.push_back(own_.emplace_back(word).data());
  return at + 2 + count;
}

/// Reads the arguments after `diameter`, which stands at `at`; returns the place of the next keyword.
int TemplateArguments::read_diameter(LAMMPS& lmp, int narg, char** arg, int at, const Refuse& refuse) {
  const auto word = [&](int place) { return std::string(place < narg ? arg[place] : ""); };
  const auto length = [&](const std::string& text, const std::string& what) {
    double value = 0;
    if (!is_number(text.c_str(), value) || !(value > 0))
      refuse(what + " '" + text + "' is not a length greater than 0 m");
    return value;
  };
  const std::string kind = word(at + 1);
  if (kind == "sieve") {
    const std::string file = word(at + 2);
    const std::optional<std::string> text = file.empty() ? std::nullopt : shared_text(lmp, file);
    if (!text)
      refuse("diameter sieve '" + file +
             "' is not a file that can be read; expected rows of an aperture in m and the part of the mass that passes "
             "it in %");
    try {
      sizes = shape::sieve_sizes(*text, "diameter sieve '" + file + "'");
    } catch (const std::invalid_argument& problem) {
      refuse(problem.what());
    }
    diameter = sizes.front().diameter;
    return at + 3;
  }
  if (kind != "uniform" && kind != "gaussian" && kind != "lognormal") {
    const int value = kind == "constant" ? at + 2 : at + 1; // as stock writes a radius
    if (value >= narg)
      refuse("keyword 'diameter' needs a value");
    diameter = length(word(value), "diameter");
    return value + 1;
  }
  int next = at + 2;
  shape::SizeBasis basis = shape::SizeBasis::number;
  if (word(next) == "number" || word(next) == "mass")
    basis = word(next++) == "mass" ? shape::SizeBasis::mass : shape::SizeBasis::number;
  const double first = length(word(next), "diameter " + kind), second = length(word(next + 1), "diameter " + kind);
  next += 2;
  int classes = kUsualClasses;
  if (word(next) == "classes") {
    double value = 0;
    const std::string text = word(next + 1);
    if (!is_number(text.c_str(), value) || !(value >= 1 && value <= kMostClasses) || value != std::floor(value))
      refuse("diameter " + kind + " classes '" + text + "' is not a whole number from 1 to " +
             std::to_string(kMostClasses));
    classes = static_cast<int>(value);
    next += 2;
  }
  try {
    sizes = kind == "uniform"    ? shape::uniform_sizes(basis, first, second, classes)
            : kind == "gaussian" ? shape::gaussian_sizes(basis, first, second, classes)
                                 : shape::lognormal_sizes(basis, first, second, classes);
  } catch (const std::invalid_argument& problem) {
    refuse("diameter " + kind + ": " + problem.what());
  }
  diameter = sizes.front().diameter;
  return next;
}

TemplateArguments::TemplateArguments(LAMMPS* lmp, int narg, char** arg) {
  const char* id = arg[0];
  const Refuse refuse = [lmp, id](const std::string& sentence) { fail(lmp, id, sentence); };
  if (narg < 4)
    refuse("needs a seed, a density and a shape: ... SEED atom_type 1 density constant 2619 shape cube 64 "
           "diameter 6.35e-3");
  stock.assign(arg, arg + 4);
  bool have_density = false;
  for (int i = 4; i < narg;) {
    const std::string word = arg[i];
    int taken = 0;
    for (const StockKeyword& keyword : stock_keywords)
      if (word == keyword.name)
        taken = keyword.arguments;
    for (const OtherKeyword& keyword : other_keywords)
      if (word == keyword.name)
        refuse("keyword '" + word + "' of stock's templates is not one of clusters; " + keyword.remedy);
    if (taken > 0) {
      if (i + taken > narg)
        refuse("keyword '" + word + "' needs " + std::to_string(taken - 1) + " value(s)");
      stock.insert(stock.end(), arg + i, arg + i + taken);
      i += taken;
    } else if (word == "density") {
      if (have_density)
        refuse("'density' stands twice");
      have_density = true;
      i = read_density(narg, arg, i, refuse);
    } else if (word == "shape") {
      if (!shape_keywords.empty())
        refuse("'shape' stands twice");
      for (++i; i < narg && !is_keyword(arg[i]); ++i)
        shape_keywords.emplace_back(arg[i]);
      if (shape_keywords.empty())
        refuse("nothing follows 'shape': give a shape, such as cube 64 or file NAME.clump");
    } else if (word == "diameter") {
      i = read_diameter(*lmp, narg, arg, i, refuse);
    } else if (word == "orientation") {
      const std::string value = i + 1 < narg ? arg[i + 1] : "";
      if (value != "random" && value != "given")
        refuse("orientation '" + value +
               "' is unknown: write random or given, or leave it out for what `orientation` of the fix insert/* says");
      orientation = value == "random" ? TemplateOrientation::random : TemplateOrientation::given;
      i += 2;
    } else {
      refuse("unknown keyword '" + word +
             "': known are atom_type, density, volume_limit, additional_group, shape, diameter and orientation");
    }
  }
  if (!have_density)
    refuse("no density: write `density constant VALUE`, that of the solid in kg/m3");
  if (shape_keywords.empty())
    refuse("no shape: write for example `shape cube 64`");
}

namespace {

/// A misspelt diameter stands among the words of the shape, which then has none: what the shape does not read, or
/// nothing.
std::string word_after_shape(const TemplateArguments& arguments) {
  if (arguments.diameter > 0)
    return {};
  std::size_t used = 0;
  try {
    shape::Notes notes;
    shape::make_shape(arguments.shape_keywords, 0, used, 1., notes);
  } catch (const std::invalid_argument&) {
    return {};
  }
  return used < arguments.shape_keywords.size() ? arguments.shape_keywords[used] : "";
}

} // namespace

FixParticletemplateCluster::FixParticletemplateCluster(LAMMPS* lmp, const TemplateArguments& arguments)
    : FixTemplateSphere(lmp, static_cast<int>(arguments.stock.size()), const_cast<char**>(arguments.stock.data())),
      density_(arguments.density), orientation_(arguments.orientation) {
  try {
    shape::Notes notes;
    make_sizes(arguments, notes);
    print_notes(lmp, "fix " + std::string(id) + " " + style, notes);
  } catch (const std::invalid_argument& problem) {
    if (const std::string word = word_after_shape(arguments); !word.empty())
      fail(lmp, id, "unknown word '" + word + "' after the shape: diameter and orientation may follow");
    fail(lmp, id, problem.what());
  }
  double least = HUGE_VAL, part = 0;
  volume_expect = 0;
  for (const Size& size : sizes_) {
    largest_ = std::max(largest_, size.bounding_radius);
    least = std::min(least, size.bounding_radius);
    volume_expect += (size.below - part) * size.volume;
    part = size.below;
  }
  mass_expect = density_.mean() * volume_expect;
  // Stock asks for the range alone.
  pdf_radius = new PDF(error);
  if (least < largest_)
    pdf_radius->set_params<RANDOM_UNIFORM>(least, largest_);
  else
    pdf_radius->set_params<RANDOM_CONSTANT>(largest_);
  // FixTemplateSphere made a sphere for insertion one by one; ours is a cluster.
  delete pti;
  pti = new ClusterToInsert(lmp, nullptr);
}

void FixParticletemplateCluster::make_sizes(const TemplateArguments& arguments, shape::Notes& notes) {
  std::vector<shape::SizeClass> classes = arguments.sizes;
  if (classes.empty())
    classes.push_back({1, arguments.diameter});
  double below = 0;
  std::string list;
  for (const shape::SizeClass& one : classes) {
    std::size_t used = 0;
    shape::Notes of_this;
    shape::ClusterShape shape = shape::make_shape(arguments.shape_keywords, 0, used, one.diameter, of_this);
    if (used != arguments.shape_keywords.size())
      fail(lmp, id,
           "unknown word '" + arguments.shape_keywords[used] + "' after the shape '" + shape.name() +
               "': diameter and orientation may follow");
    for (const shape::Note& note : of_this) // bodies of another size mostly have the same ones
      if (std::none_of(notes.begin(), notes.end(), [&](const shape::Note& known) { return known.text == note.text; }))
        notes.push_back(note);
    below += one.number;
    char text[64];
    std::snprintf(text, sizeof text, "%s%.4g (%.3g %%)", list.empty() ? "" : ", ", one.diameter, 100 * one.number);
    list += text;
    const double volume = shape.volume(), bounding_radius = shape.bounding_radius();
    sizes_.push_back({std::make_unique<shape::ClusterShape>(std::move(shape)), below, volume, bounding_radius, -1});
  }
  sizes_.back().below = 1;
  if (classes.size() > 1)
    notes.push_back({"diameters [m] and their part of the number: " + list, false});
}

const FixParticletemplateCluster::Size& FixParticletemplateCluster::size_of(RanPark& random) const {
  if (sizes_.size() == 1)
    return sizes_.front();
  const double part = random.uniform();
  return *std::find_if(sizes_.begin(), sizes_.end() - 1, [part](const Size& size) { return part < size.below; });
}

FixParticletemplateCluster::~FixParticletemplateCluster() {
  delete pti;
  if (pti_list)
    delete_ptilist();
}

void FixParticletemplateCluster::post_create() {
  for (Size& size : sizes_) {
    size.shape_id = FixClusterBodies::require(lmp).shapes().add(std::move(*size.shape));
    size.shape.reset();
  }
}

void FixParticletemplateCluster::fill(ParticleToInsert& particle) {
  auto& cluster = static_cast<ClusterToInsert&>(particle);
  const Size& size = size_of(*random_insertion);
  cluster.shape_id = size.shape_id;
  cluster.atom_type = atom_type;
  cluster.radius_ins[0] = cluster.r_bound_ins = size.bounding_radius;
  cluster.density_ins = density_.draw(*random_insertion);
  cluster.volume_ins = size.volume;
  cluster.mass_ins = cluster.density_ins * size.volume;
  for (int k = 0; k < 3; ++k)
    cluster.x_ins[0][k] = cluster.v_ins[k] = cluster.omega_ins[k] = 0;
  constexpr double upright[4] = {1, 0, 0, 0};
  std::copy(upright, upright + 4, cluster.own_orientation);
  cluster.orientations = nullptr;
  const InsertionOrientation insertion = FixClusterBodies::require(lmp).insertion().orientation;
  if (orientation_ == TemplateOrientation::given ||
      (orientation_ == TemplateOrientation::as_inserted && insertion == InsertionOrientation::fixed))
    return;
  cluster.orientations = random_insertion;
  if (orientation_ == TemplateOrientation::random || insertion == InsertionOrientation::not_written)
    MathExtraLiggghts::random_unit_quat(random_insertion, cluster.own_orientation);
}

void FixParticletemplateCluster::randomize_single() {
  fill(*pti);
  pti->groupbit = groupbit;
}

void FixParticletemplateCluster::init_ptilist(int count, bool, FixPropertyAtom* release) {
  if (pti_list)
    error->one(FLERR, "internal error: the insertion list of a template was made twice");
  n_pti_max = count;
  // smalloc, because FixTemplateSphere::delete_ptilist frees with sfree; the array holds pointers.
  // NOLINTNEXTLINE(bugprone-sizeof-expression)
  pti_list = static_cast<ParticleToInsert**>(memory->smalloc(count * sizeof(ParticleToInsert*), "pti_list"));
  for (int i = 0; i < count; ++i)
    pti_list[i] = new ClusterToInsert(lmp, release);
}

// Stock calls this once per round of insertion, before it asks for overlaps.
void FixParticletemplateCluster::randomize_ptilist(int count, int distribution_groupbit, int distribution_order) {
  FixClusterBodies::require(lmp).insertion().begin();
  for (int i = 0; i < count; ++i) {
    fill(*pti_list[i]);
    pti_list[i]->groupbit = groupbit | distribution_groupbit;
    pti_list[i]->distorder = distribution_order;
  }
}

void FixParticletemplateCluster::direct_set_ptlist(int, const void*, int, int) {
  error->one(FLERR, "fix insert/stream/predefined and the like place spheres one by one and cannot place clusters: use "
                    "insert/pack, insert/rate/region or insert/stream");
}

} // namespace eccentra::styles
