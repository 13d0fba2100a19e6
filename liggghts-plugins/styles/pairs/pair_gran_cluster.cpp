// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// pair_style gran/cluster as LIGGGHTS sees it: arguments, materials, lists, restart. The force loop is in
// pair_gran_cluster_forces.cpp.
#include "styles/pairs/pair_gran_cluster.h"

#include "contact/stock_contact_keywords.h"
#include "styles/bodies/fix_sleep_cluster.h"
#include "styles/bodies/restart_version.h"
#include "styles/entry/style_registry.h"
#include "styles/pairs/hull_contacts.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "lammps.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <cstring>
#include <string>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

constexpr const char* style = "pair_style gran/cluster";

/// Beside the bit of tangential_damping in restart files.
constexpr int kFrictionless = 2;

Pair* create_pair(LAMMPS* lmp) {
  return new PairGranCluster(lmp);
}

const styles::RegisterStyle registered({"pair_style", "gran/cluster",
                                        "Hertz-Mindlin contacts between clusters (and plain spheres)", nullptr, nullptr,
                                        nullptr, nullptr, &create_pair});

/// A keyword with the values that it takes; `is_set` hears which one was typed.
struct Choice {
  const char* keyword;
  std::vector<const char*> values;
};

std::string listed(const std::vector<const char*>& values) {
  std::string text;
  for (const char* value : values)
    text += (text.empty() ? "" : ", ") + std::string(value);
  return text;
}

} // namespace

PairGranCluster::PairGranCluster(LAMMPS* lmp) : PairGran(lmp) {}

PairGranCluster::~PairGranCluster() {
  // The fix that keeps history outlives us only where the whole of LIGGGHTS ends.
  if (near_)
    FixClusterHistory::require(lmp).hand_over = nullptr;
}

void PairGranCluster::settings(int narg, char** arg) {
  const Choice choices[] = {
      {"model", {"hertz"}},
      {"tangential", {"off", "history"}},
      {"rolling_friction", {"off"}},
      {"cohesion", {"off"}},
      {"surface", {"default"}},
      {"tangential_damping", {"on", "off"}},
      {"contacts", {"shared", "parallel"}},
      {"damping", {"stock", "paper"}},
  };
  arguments_ = ClusterContactKeywords();
  arguments_.tangential = false; // as in stock, where no tangential model is written
  bool have_model = false;
  for (int i = 0; i < narg; i += 2) {
    const std::string keyword = arg[i];
    const Choice* choice = nullptr;
    if (contact::stock_contact_keywords().count(keyword)) {
      if (const std::string refused = contact::refused_stock_keyword(keyword, i + 1 < narg ? arg[i + 1] : "");
          !refused.empty())
        error->all(FLERR, (std::string(style) + ": " + refused).c_str());
      continue;
    }
    for (const Choice& c : choices)
      if (keyword == c.keyword)
        choice = &c;
    if (!choice)
      error->all(FLERR, (std::string(style) + ": unknown keyword '" + keyword +
                         "': known are model, tangential, rolling_friction, contacts, damping, tangential_damping, "
                         "cohesion and surface")
                            .c_str());
    if (i + 1 >= narg)
      error->all(FLERR,
                 (std::string(style) + ": keyword '" + keyword + "' needs a value: " + listed(choice->values)).c_str());
    const std::string value = arg[i + 1];
    bool known = false;
    for (const char* v : choice->values)
      known = known || value == v;
    if (!known)
      error->all(FLERR,
                 (std::string(style) + ": " + keyword + " '" + value + "' is not offered: write " +
                  listed(choice->values) + (keyword == "rolling_friction" ? " (clusters roll by their shape)" : ""))
                     .c_str());
    have_model = have_model || keyword == "model";
    if (keyword == "contacts")
      arguments_.sharing = value == "shared" ? ContactSharing::shared : ContactSharing::parallel;
    if (keyword == "damping")
      arguments_.damping = value == "stock" ? contact::DampingLaw::stock : contact::DampingLaw::paper;
    if (keyword == "tangential")
      arguments_.tangential = value != "off";
    if (keyword == "tangential_damping")
      arguments_.tangential_damping = value == "on";
  }
  if (!arguments_.tangential)
    arguments_.tangential_damping = false;
  if (!have_model)
    error->all(
        FLERR,
        (std::string(style) + ": no contact model: write model hertz tangential history rolling_friction off").c_str());
}

void PairGranCluster::init_style() {
  if (force->newton_pair)
    error->all(FLERR, (std::string(style) + " needs `newton off` at the head of the script").c_str());
  if (cpl_)
    error->all(FLERR,
               "compute pair/gran/local sees bodies, not sub-contacts, and cannot be used with gran/cluster; expected "
               "compute contact/cluster/local");
  PairGran::init_style();
}

void PairGranCluster::init_granular() {
  PropertyRegistry& registry = force->registry;
  registry.registerProperty("Yeff", &MODEL_PARAMS::createYeff, style);
  registry.registerProperty("Geff", &MODEL_PARAMS::createGeff, style);
  registry.registerProperty("betaeff", &MODEL_PARAMS::createBetaEff, style);
  if (arguments_.tangential)
    registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict, style);
  registry.connect("Yeff", youngs_, style);
  registry.connect("Geff", shear_, style);
  registry.connect("betaeff", damping_, style);
  if (arguments_.tangential)
    registry.connect("coeffFrict", friction_, style);
  else
    friction_ = no_friction_.matrix(atom->ntypes);

  bodies_ = &FixClusterBodies::require(lmp);
  for (int id = 0; id < bodies_->shapes().size(); ++id)
    if (bodies_->shapes().surface(id).count >= contact::max_surface_spheres)
      error->all(FLERR, ("shape '" + bodies_->shapes()[id].name() + "' has " +
                         std::to_string(bodies_->shapes().surface(id).count) +
                         " sub-spheres at its surface; contacts can number at most " +
                         std::to_string(contact::max_surface_spheres - 1) + ": use a coarser shape")
                            .c_str());
  for (int id = 0; id < bodies_->shapes().size() && !hulls_; ++id)
    if (bodies_->shapes().surface(id).hull)
      hulls_ = std::make_unique<HullContacts>();
  FixClusterHistory& history = FixClusterHistory::require(lmp);
  all_records_ = &contact_records(lmp);
  if (!near_)
    near_ = std::make_unique<NearPairs>(lmp, *bodies_, history);
  resting_ = FixSleepCluster::find(lmp) ? std::make_unique<RestingPairs>() : nullptr;
  history.hand_over = [this](bool keep) {
    if (resting_)
      resting_->release(*near_);
    near_->hand_over(keep);
  };
}

bool PairGranCluster::contact_match(const std::string type, const std::string model) {
  const std::pair<const char*, const char*> ours[] = {{"model", "hertz"},
                                                      {"tangential", arguments_.tangential ? "history" : "off"},
                                                      {"rolling_friction", "off"},
                                                      {"cohesion", "off"},
                                                      {"surface", "default"}};
  for (const auto& [keyword, value] : ours)
    if (type == keyword)
      return model == value;
  return false;
}

int64_t PairGranCluster::hashcode() {
  // Tells our neighbour list from those of stock styles; any number that no model combination has.
  return 0x0045434345ll;
}

double PairGranCluster::stressStrainExponent() {
  return 1.5;
}

void PairGranCluster::write_restart_settings(FILE* fp) {
  const int values[] = {restart_mark, static_cast<int>(arguments_.sharing), static_cast<int>(arguments_.damping),
                        (arguments_.tangential_damping ? 1 : 0) + (arguments_.tangential ? 0 : kFrictionless)};
  fwrite(values, sizeof(int), 4, fp);
}

void PairGranCluster::read_restart_settings(FILE* fp, const int, const int) {
  int values[4] = {restart_mark, 0, 0, 1};
  if (comm->me == 0 && fread(values, sizeof(int), 4, fp) != 4)
    error->one(FLERR, (std::string(style) + ": the restart file ends within the settings of the pair style").c_str());
  MPI_Bcast(values, 4, MPI_INT, 0, world);
  if (const std::string problem = restart_problem(values[0], style); !problem.empty())
    error->all(FLERR, problem.c_str());
  arguments_.sharing = static_cast<ContactSharing>(values[1]);
  arguments_.damping = static_cast<contact::DampingLaw>(values[2]);
  arguments_.tangential_damping = (values[3] & 1) != 0;
  arguments_.tangential = (values[3] & kFrictionless) == 0;
}

double PairGranCluster::memory_usage() {
  return PairGran::memory_usage() + sizeof(*this) + (near_ ? near_->memory_usage() : 0);
}

void* PairGranCluster::extract(const char* name, int& dim) {
  dim = 0;
  if (!std::strcmp(name, "contacts"))
    return &contact_count_;
  if (!std::strcmp(name, "near_pairs"))
    return &near_count_;
  return PairGran::extract(name, dim);
}

} // namespace eccentra::styles
