// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of fix particletemplate/cluster and fills what stock fix insert/* places.
#include "styles/bodies/fix_particletemplate_cluster.h"

#include "shape/shape_keywords.h"
#include "styles/bodies/cluster_to_insert.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/printed_notes.h"
#include "styles/entry/style_registry.h"

#include "error.h"
#include "lammps.h"
#include "math_extra_liggghts.h"
#include "memory.h"

#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;
using namespace LMP_PROBABILITY_NS;

namespace {

constexpr const char* style = "particletemplate/cluster";

Fix* create_template(LAMMPS* lmp, int narg, char** arg) {
  return new FixParticletemplateCluster(lmp, TemplateArguments(lmp, narg, arg));
}

const styles::RegisterStyle registered({"fix", style, "a cluster of spheres for fix insert/*: one body, one atom",
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
constexpr StockKeyword stock_keywords[] = {{"atom_type", 2},    {"region", 2},  {"region_variable", 2},
                                           {"volume_limit", 2}, {"density", 3}, {"additional_group", 2}};

bool is_keyword(const std::string& word) {
  for (const StockKeyword& keyword : stock_keywords)
    if (word == keyword.name)
      return true;
  return word == "shape" || word == "diameter" || word == "orientation";
}

} // namespace

TemplateArguments::TemplateArguments(LAMMPS* lmp, int narg, char** arg) {
  const char* id = arg[0];
  if (narg < 4)
    fail(lmp, id,
         "needs a seed, a density and a shape: ... SEED atom_type 1 density constant 2619 shape cube 64 "
         "diameter 6.35e-3");
  stock.assign(arg, arg + 4);
  bool have_density = false;
  for (int i = 4; i < narg;) {
    const std::string word = arg[i];
    int taken = 0;
    for (const StockKeyword& keyword : stock_keywords)
      if (word == keyword.name) {
        taken = keyword.arguments;
        have_density = have_density || word == "density";
      }
    if (taken > 0) {
      if (i + taken > narg)
        fail(lmp, id, "keyword '" + word + "' needs " + std::to_string(taken - 1) + " value(s)");
      stock.insert(stock.end(), arg + i, arg + i + taken);
      i += taken;
    } else if (word == "shape") {
      if (!shape_keywords.empty())
        fail(lmp, id, "'shape' stands twice");
      for (++i; i < narg && !is_keyword(arg[i]); ++i)
        shape_keywords.emplace_back(arg[i]);
      if (shape_keywords.empty())
        fail(lmp, id, "nothing follows 'shape': give a shape, such as cube 64 or file NAME.clump");
    } else if (word == "diameter" || word == "orientation") {
      if (i + 1 >= narg)
        fail(lmp, id, "keyword '" + word + "' needs a value");
      const std::string value = arg[i + 1];
      if (word == "diameter") {
        char* end = nullptr;
        diameter = std::strtod(value.c_str(), &end);
        if (*end || !(diameter > 0) || !std::isfinite(diameter))
          fail(lmp, id, "diameter '" + value + "' is not a length greater than 0 m");
      } else if (value == "random" || value == "given") {
        random_orientation = value == "random";
      } else {
        fail(lmp, id, "orientation '" + value + "' is unknown: write random (the default) or given");
      }
      i += 2;
    } else {
      fail(lmp, id,
           "unknown keyword '" + word +
               "': known are atom_type, region, density, volume_limit, "
               "additional_group, shape, diameter and orientation");
    }
  }
  if (!have_density)
    fail(lmp, id, "no density: write `density constant VALUE`, that of the solid in kg/m3");
  if (shape_keywords.empty())
    fail(lmp, id, "no shape: write for example `shape cube 64`");
}

FixParticletemplateCluster::FixParticletemplateCluster(LAMMPS* lmp, const TemplateArguments& arguments)
    : FixTemplateSphere(lmp, static_cast<int>(arguments.stock.size()), const_cast<char**>(arguments.stock.data())),
      density_(expectancy(pdf_density)), random_orientation_(arguments.random_orientation) {
  std::size_t used = 0;
  try {
    shape::Notes notes;
    shape::ClusterShape shape = shape::make_shape(arguments.shape_keywords, 0, used, arguments.diameter, notes);
    if (used != arguments.shape_keywords.size())
      fail(lmp, id,
           "unknown word '" + arguments.shape_keywords[used] + "' after the shape '" + shape.name() +
               "': diameter and orientation may follow");
    styles::print_notes(lmp, "fix " + std::string(id) + " " + style, notes);
    volume_ = shape.volume();
    pdf_radius = new PDF(error);
    pdf_radius->set_params<RANDOM_CONSTANT>(shape.bounding_radius());
    shape_ = std::make_unique<shape::ClusterShape>(std::move(shape));
  } catch (const std::invalid_argument& problem) {
    fail(lmp, id, problem.what());
  }
  volume_expect = volume_;
  mass_expect = density_ * volume_;
  // FixTemplateSphere made a sphere for insertion one by one; ours is a cluster.
  delete pti;
  pti = new ClusterToInsert(lmp, nullptr);
}

FixParticletemplateCluster::~FixParticletemplateCluster() {
  delete pti;
  if (pti_list)
    delete_ptilist();
}

void FixParticletemplateCluster::post_create() {
  shape_id_ = FixClusterBodies::require(lmp).shapes().add(std::move(*shape_));
}

void FixParticletemplateCluster::fill(ParticleToInsert& particle) {
  auto& cluster = static_cast<ClusterToInsert&>(particle);
  cluster.shape_id = shape_id_;
  cluster.atom_type = atom_type;
  cluster.radius_ins[0] = cluster.r_bound_ins = expectancy(pdf_radius);
  cluster.density_ins = density_;
  cluster.volume_ins = volume_;
  cluster.mass_ins = density_ * volume_;
  for (int k = 0; k < 3; ++k)
    cluster.x_ins[0][k] = cluster.v_ins[k] = cluster.omega_ins[k] = 0;
  if (!random_orientation_)
    return;
  cluster.orientations = random_insertion;
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
