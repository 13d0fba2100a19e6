// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix sleep/cluster: who falls asleep and who wakes up.
#include "styles/bodies/fix_sleep_cluster.h"

#include "base/option_reader.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_gravity.h"
#include "force.h"
#include "lammps.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

constexpr const char* style_name = "sleep/cluster";
const RegisterFix<FixSleepCluster> registered(style_name, "bodies at rest sleep until forces wake them");

/// A body falls asleep at this part of the imbalance that would wake it, so that it stays asleep.
constexpr double part_to_sleep = 0.5;

double squared(const double* v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

} // namespace

SleepArguments read_sleep_arguments(const std::vector<std::string>& arguments) {
  SleepArguments read;
  base::OptionReader reader(arguments);
  while (reader.more()) {
    const std::string& keyword = reader.keyword();
    if (keyword == "tolerance")
      read.tolerance = reader.between(0, 1);
    else if (keyword == "speed")
      read.speed = reader.between(0, 1);
    else if (keyword == "window")
      read.window = reader.count(1, "steps");
    else if (keyword == "every")
      read.every = reader.count(1, "steps");
    else if (keyword == "recheck")
      read.recheck = reader.count(0, "steps");
    else
      reader.unknown("tolerance, speed, window, every, recheck");
  }
  return read;
}

FixSleepCluster::FixSleepCluster(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (const FixSleepCluster* other = find(lmp))
    fail("is the second one, after '" + std::string(other->id) + "': one group sleeps, write one of them");
  try {
    arguments_ = read_sleep_arguments({arg + 3, arg + narg});
  } catch (const std::invalid_argument& problem) {
    fail(problem.what());
  }
  nevery = 1;
  scalar_flag = vector_flag = peratom_flag = 1;
  size_vector = 5;
  size_peratom_cols = columns;
  global_freq = peratom_freq = 1;
  extscalar = extvector = 0;
  restart_peratom = 1;
  create_attribute = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
  for (int i = 0; i < atom->nlocal; ++i)
    set_arrays(i);
}

FixSleepCluster::~FixSleepCluster() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(state_);
}

FixSleepCluster* FixSleepCluster::find(LAMMPS* lmp) {
  return static_cast<FixSleepCluster*>(lmp->modify->find_fix_style_strict(style_name, 0));
}

void FixSleepCluster::fail(const std::string& sentence) const {
  error->all(FLERR, ("fix " + std::string(id) + " sleep/cluster: " + sentence).c_str());
  std::abort(); // not reached: error->all ends the run
}

// Modify::setup wipes the per-atom data of a fix that it takes for new.
void FixSleepCluster::post_create() {
  just_created = 0;
}

int FixSleepCluster::setmask() {
  return FixConst::END_OF_STEP;
}

double FixSleepCluster::gravity() const {
  double sum[3] = {0, 0, 0};
  for (int n = 0; n < modify->nfix; ++n)
    if (std::strcmp(modify->fix[n]->style, "gravity") == 0) {
      double g[3];
      static_cast<FixGravity*>(modify->fix[n])->get_gravity(g);
      for (int k = 0; k < 3; ++k)
        sum[k] += g[k];
    }
  return std::sqrt(squared(sum));
}

void FixSleepCluster::init() {
  if (!force->pair || std::strcmp(force->pair_style, "gran/cluster") != 0)
    fail("needs pair_style gran/cluster, which leaves out pairs that sleep and serves plain spheres, too; the pair "
         "style "
         "is '" +
         std::string(force->pair ? force->pair_style : "none") + "'");
  if (!modify->find_fix_style_strict("nve/cluster", 0))
    fail("needs fix nve/cluster, which leaves out bodies that sleep and moves plain spheres, too");
  if (modify->n_fixes_style_strict("gravity") == 0)
    fail("measures forces by the weight of a body: add fix gravity");
  bodies_ = &FixClusterBodies::require(lmp);
}

// What a script has set in motion since the last run is awake.
void FixSleepCluster::setup(int) {
  steps_asleep_ = steps_ = wake_ups_ = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (asleep(i) && (moves(i) || !(atom->mask[i] & groupbit)))
      wake(i);
}

bool FixSleepCluster::moves(int i) const {
  return squared(atom->v[i]) + squared(atom->omega[i]) > 0;
}

bool FixSleepCluster::balanced(int i, double part, double gravity) const {
  const double limit = part * atom->rmass[i] * gravity, lever = atom->radius[i];
  return squared(atom->f[i]) <= limit * limit && squared(atom->torque[i]) <= limit * limit * lever * lever;
}

// Here forces are complete: those of the fluid have been added before the last half half step.
void FixSleepCluster::end_of_step() {
  const double g = gravity();
  const double part = arguments_.tolerance;
  const bool look = update->ntimestep % arguments_.every == 0;
  const bool wake_all = arguments_.recheck > 0 && update->ntimestep % arguments_.recheck == 0;
  const int looks = (arguments_.window + arguments_.every - 1) / arguments_.every;
  const int all = atom->nlocal;
  for (int i = 0; i < all; ++i) {
    if (!(atom->mask[i] & groupbit))
      continue;
    if (asleep(i)) {
      ++steps_asleep_;
      if (wake_all || !balanced(i, part, g) || moves(i))
        wake(i);
    } else if (look) {
      const double d = 2 * atom->radius[i], fastest = arguments_.speed * arguments_.speed * g * d, r = atom->radius[i];
      const bool at_rest = squared(atom->v[i]) <= fastest && r * r * squared(atom->omega[i]) <= fastest &&
                           balanced(i, part_to_sleep * part, g);
      state_[i][1] = at_rest ? state_[i][1] + 1 : 0;
      if (state_[i][1] >= looks)
        fall_asleep(i);
    }
  }
  steps_ += all;
}

void FixSleepCluster::fall_asleep(int i) {
  state_[i][0] = 1;
  std::fill_n(atom->v[i], 3, 0.);
  std::fill_n(atom->omega[i], 3, 0.);
  if (bodies_->shape_id(i) != FixClusterBodies::plain_sphere)
    std::fill_n(bodies_->angular_momentum(i), 3, 0.);
}

void FixSleepCluster::wake(int i) {
  state_[i][0] = state_[i][1] = 0;
  ++wake_ups_;
}

void FixSleepCluster::post_run() {
  const double share = compute_vector(1), wake_ups = compute_vector(2), net = compute_vector(4);
  if (comm->me != 0 || update->nsteps == 0)
    return;
  char line[256];
  std::snprintf(line, sizeof line,
                "fix %s sleep/cluster: %.1f %% of bodies and steps asleep, %.0f wake-ups; sleepers carry %.2g of their "
                "weight themselves\n",
                id, 100 * share, wake_ups, net);
  for (FILE* out : {screen, logfile})
    if (out)
      std::fputs(line, out);
}

double FixSleepCluster::compute_scalar() {
  return compute_vector(0);
}

double FixSleepCluster::compute_vector(int n) {
  const double g = gravity();
  enum { sleepers, slept, steps, wake_ups, weight, fx, fy, fz, terms };
  double mine[terms] = {0, steps_asleep_, steps_, wake_ups_, 0, 0, 0, 0}, all[terms];
  double largest = 0, largest_of_all = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!asleep(i))
      continue;
    const double w = atom->rmass[i] * g;
    mine[sleepers] += 1;
    mine[weight] += w;
    for (int k = 0; k < 3; ++k)
      mine[fx + k] += atom->f[i][k];
    if (w > 0)
      largest = std::max(largest, std::sqrt(squared(atom->f[i])) / w);
  }
  MPI_Allreduce(mine, all, terms, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&largest, &largest_of_all, 1, MPI_DOUBLE, MPI_MAX, world);
  const double values[] = {all[sleepers], all[steps] > 0 ? all[slept] / all[steps] : 0, all[wake_ups], largest_of_all,
                           all[weight] > 0 ? std::sqrt(squared(all + fx)) / all[weight] : 0};
  return values[n];
}

void FixSleepCluster::grow_arrays(int nmax) {
  memory->grow(state_, nmax, static_cast<int>(columns), "sleep_cluster:state");
  array_atom = state_;
}

void FixSleepCluster::copy_arrays(int i, int j, int) {
  std::copy(state_[i], state_[i] + columns, state_[j]);
}

void FixSleepCluster::set_arrays(int i) {
  std::fill(state_[i], state_[i] + columns, 0.);
}

int FixSleepCluster::pack_exchange(int i, double* buf) {
  std::copy(state_[i], state_[i] + columns, buf);
  return columns;
}

int FixSleepCluster::unpack_exchange(int i, double* buf) {
  std::copy(buf, buf + columns, state_[i]);
  return columns;
}

int FixSleepCluster::pack_restart(int i, double* buf) {
  buf[0] = size_restart(i);
  std::copy(state_[i], state_[i] + columns, buf + 1);
  return size_restart(i);
}

void FixSleepCluster::unpack_restart(int i, int nth) {
  const double* extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; ++k)
    m += static_cast<int>(extra[m]);
  std::copy(extra + m + 1, extra + m + 1 + columns, state_[i]);
}

int FixSleepCluster::size_restart(int) {
  return 1 + columns;
}

int FixSleepCluster::maxsize_restart() {
  return 1 + columns;
}

double FixSleepCluster::memory_usage() {
  return static_cast<double>(atom->nmax) * columns * sizeof(double);
}

} // namespace eccentra::styles
