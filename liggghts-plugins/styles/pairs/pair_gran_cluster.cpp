// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// pair_style gran/cluster as LIGGGHTS sees it: arguments, materials, lists, restart. The force loop is in
// pair_gran_cluster_forces.cpp.
#include "styles/pairs/pair_gran_cluster.h"

#include "styles/bodies/fix_sleep_cluster.h"
#include "styles/bodies/restart_version.h"
#include "styles/entry/style_registry.h"
#include "styles/pairs/hull_contacts.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "lammps.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

constexpr const char* style = "pair_style gran/cluster";

Pair* create_pair(LAMMPS* lmp) {
  return new PairGranCluster(lmp);
}

const RegisterStyle registered({"pair_style", "gran/cluster", "contacts between clusters (and plain spheres)", nullptr,
                                nullptr, nullptr, nullptr, &create_pair});

} // namespace

PairGranCluster::PairGranCluster(LAMMPS* lmp) : PairGran(lmp) {}

PairGranCluster::~PairGranCluster() {
  // The fix that keeps history outlives us only where the whole of LIGGGHTS ends.
  if (near_)
    FixClusterHistory::require(lmp).hand_over = nullptr;
}

void PairGranCluster::settings(int narg, char** arg) {
  std::vector<std::string> words(arg, arg + narg);
  typed_.clear();
  for (const std::string& word : words)
    typed_ += word + " ";
  try {
    arguments_ = read_contact_keywords(words);
    stock_.reset();
    if (!arguments_.in_blocks) {
      stock_ = std::make_unique<StockContact>(lmp, false);
      stock_->choose(arguments_.names, arguments_.options);
      stock_->set_tangential(arguments_.synchronised, arguments_.friction);
      stock_->set_rolling_radius(arguments_.rolling_radius);
    }
  } catch (const std::invalid_argument& problem) {
    error->all(FLERR, (std::string(style) + ": " + problem.what()).c_str());
  }
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
  reach_ = 1;
  if (stock_) {
    stock_->connect();
    reach_ = stock_->reach();
  } else {
    model_ = contact::find_contact_model(arguments_.names.normal);
    materials_.connect(lmp, *model_, arguments_.tangential, style);
  }

  bodies_ = &FixClusterBodies::require(lmp);
  for (int id = 0; id < bodies_->shapes().size(); ++id)
    if (bodies_->shapes().surface(id).count >= contact::max_surface_spheres)
      error->all(FLERR, ("shape '" + bodies_->shapes()[id].name() + "' has " +
                         std::to_string(bodies_->shapes().surface(id).count) +
                         " sub-spheres at its surface; contacts can number at most " +
                         std::to_string(contact::max_surface_spheres - 1) + ": use a coarser shape")
                            .c_str());
  for (int id = 0; id < bodies_->shapes().size() && stock_; ++id)
    if (bodies_->shapes().surface(id).hull)
      error->all(FLERR,
                 (std::string(style) + ": the rounded body '" + bodies_->shapes()[id].name() +
                  "' has contacts of model hertz alone; expected model hertz, tangential history or off, no rolling "
                  "friction and no cohesion, or a cluster of spheres")
                     .c_str());
  for (int id = 0; id < bodies_->shapes().size() && !hulls_; ++id)
    if (bodies_->shapes().surface(id).hull)
      hulls_ = std::make_unique<HullContacts>();
  FixClusterHistory& history = FixClusterHistory::require(lmp);
  all_records_ = &contact_records(lmp);
  if (!near_)
    near_ = std::make_unique<NearPairs>(lmp, *bodies_, history);
  near_->set_history_width(stock_ ? stock_->history_size() : 0);
  resting_ = FixSleepCluster::find(lmp) ? std::make_unique<RestingPairs>() : nullptr;
  history.hand_over = [this](bool keep) {
    if (resting_)
      resting_->release(*near_);
    near_->hand_over(keep);
  };
}

bool PairGranCluster::contact_match(const std::string type, const std::string model) {
  const StockModelNames& names = arguments_.names;
  const std::pair<const char*, std::string> ours[] = {{"model", names.normal},
                                                      {"tangential", names.tangential},
                                                      {"rolling_friction", names.rolling},
                                                      {"cohesion", names.cohesion},
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
  return stock_ ? stock_->exponent() : contact::find_contact_model(arguments_.names.normal)->exponent;
}

/// The line as it was typed.
void PairGranCluster::write_restart_settings(FILE* fp) {
  const int head[] = {restart_mark, static_cast<int>(typed_.size())};
  fwrite(head, sizeof(int), 2, fp);
  fwrite(typed_.data(), 1, typed_.size(), fp);
}

void PairGranCluster::read_restart_settings(FILE* fp, const int, const int) {
  int head[2] = {restart_mark, 0};
  if (comm->me == 0 && fread(head, sizeof(int), 2, fp) != 2)
    error->one(FLERR, (std::string(style) + ": the restart file ends within the settings of the pair style").c_str());
  MPI_Bcast(head, 2, MPI_INT, 0, world);
  if (const std::string problem = restart_problem(head[0], style); !problem.empty())
    error->all(FLERR, problem.c_str());
  constexpr int longest = 1 << 16;
  if (head[1] < 0 || head[1] > longest)
    error->all(FLERR, damaged_restart(style).c_str());
  std::string line(head[1], ' ');
  if (comm->me == 0 && fread(line.data(), 1, line.size(), fp) != line.size())
    error->one(FLERR, (std::string(style) + ": the restart file ends within the settings of the pair style").c_str());
  MPI_Bcast(line.data(), head[1], MPI_CHAR, 0, world);
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  std::vector<char*> arg;
  for (std::string& word : words)
    arg.push_back(word.data());
  settings(static_cast<int>(arg.size()), arg.data());
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
