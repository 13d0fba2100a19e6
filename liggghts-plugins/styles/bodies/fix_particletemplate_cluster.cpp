// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the shapes of fix particletemplate/cluster and fills what stock fix insert/* places.
#include "styles/bodies/fix_particletemplate_cluster.h"

#include "base/refusal.h"
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
#include <stdexcept>
#include <utility>

namespace eccentra::styles {

using namespace LAMMPS_NS;
using namespace LMP_PROBABILITY_NS;

namespace {

constexpr const char* style = "particletemplate/cluster";

/// What follows the words of the shape where nothing may: a misspelt keyword, or nothing.
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

std::vector<TemplateSize> make_sizes(const TemplateArguments& arguments, shape::Notes& notes) {
  std::vector<shape::SizeClass> classes = arguments.sizes;
  if (classes.empty())
    classes.push_back({1, arguments.diameter});
  std::vector<TemplateSize> sizes;
  double below = 0;
  std::string list;
  for (const shape::SizeClass& one : classes) {
    std::size_t used = 0;
    shape::Notes of_this;
    shape::ClusterShape shape = shape::make_shape(arguments.shape_keywords, 0, used, one.diameter, of_this);
    if (used != arguments.shape_keywords.size())
      base::refuse("unknown word '{}' after the shape '{}'; expected diameter, orientation or another keyword",
                   arguments.shape_keywords[used], shape.name());
    for (const shape::Note& note : of_this) // bodies of another size mostly have the same ones
      if (std::none_of(notes.begin(), notes.end(), [&](const shape::Note& known) { return known.text == note.text; }))
        notes.push_back(note);
    below += one.number;
    list += fmt::format("{}{:.4g} ({:.3g} %)", list.empty() ? "" : ", ", one.diameter, 100 * one.number);
    const double volume = shape.volume(), bounding_radius = shape.bounding_radius();
    sizes.push_back({std::make_unique<shape::ClusterShape>(std::move(shape)), below, volume, bounding_radius, -1});
  }
  sizes.back().below = 1;
  if (classes.size() > 1)
    notes.push_back({"diameters [m] and their part of the number: " + list, false});
  return sizes;
}

std::vector<TemplateSize> sizes_of(const TemplateArguments& arguments, shape::Notes& notes) {
  try {
    return make_sizes(arguments, notes);
  } catch (const std::invalid_argument&) {
    if (const std::string word = word_after_shape(arguments); !word.empty())
      base::refuse("unknown word '{}' after the shape; expected diameter, orientation or another keyword", word);
    throw;
  }
}

Fix* create_template(LAMMPS* lmp, int narg, char** arg) {
  const std::string where = "fix " + std::string(arg[0]) + " " + style;
  try {
    TemplateArguments arguments({arg, arg + narg});
    if (!arguments.sieve.empty())
      arguments.read_sieve(shared_text(*lmp, arguments.sieve));
    shape::Notes notes;
    std::vector<TemplateSize> sizes = sizes_of(arguments, notes);
    print_notes(lmp, where, notes);
    return new FixParticletemplateCluster(lmp, arguments, std::move(sizes));
  } catch (const std::invalid_argument& problem) {
    lmp->error->all(FLERR, (where + ": " + problem.what()).c_str());
    return nullptr;
  }
}

const RegisterStyle registered({"fix", style, "a cluster of spheres for fix insert/*: one body, one atom",
                                &create_template});

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> first;
  for (const std::string& word : words)
    first.push_back(const_cast<char*>(word.c_str()));
  return first;
}

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

FixParticletemplateCluster::FixParticletemplateCluster(LAMMPS* lmp, const TemplateArguments& arguments,
                                                       std::vector<TemplateSize> sizes)
    : FixTemplateSphere(lmp, static_cast<int>(arguments.stock.size()), pointers(arguments.stock).data()),
      sizes_(std::move(sizes)), density_(arguments.density), orientation_(arguments.orientation) {
  double least = HUGE_VAL, part = 0;
  volume_expect = 0;
  for (const TemplateSize& size : sizes_) {
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

const TemplateSize& FixParticletemplateCluster::size_of(RanPark& random) const {
  if (sizes_.size() == 1)
    return sizes_.front();
  const double part = random.uniform();
  return *std::find_if(sizes_.begin(), sizes_.end() - 1,
                       [part](const TemplateSize& size) { return part < size.below; });
}

FixParticletemplateCluster::~FixParticletemplateCluster() {
  delete pti;
  if (pti_list)
    delete_ptilist();
}

void FixParticletemplateCluster::post_create() {
  for (TemplateSize& size : sizes_) {
    size.shape_id = FixClusterBodies::require(lmp).shapes().add(std::move(*size.shape));
    size.shape.reset();
  }
}

void FixParticletemplateCluster::fill(ParticleToInsert& particle) {
  auto& cluster = static_cast<ClusterToInsert&>(particle);
  const TemplateSize& size = size_of(*random_insertion);
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
