// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements fix fluid/force: time stepping and per-atom data around the effects.
#include "styles/fluid/fix_fluid_force.h"

#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_gravity.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {

const RegisterFix<FixFluidForce>
    registered("fluid/force",
               "drag, lift, pressure, stress and buoyancy forces of a Herschel-Bulkley fluid on particles");

constexpr const char* kEffectOrder[] = {"drag",           "shear_lift", "rotational_lift", "pressure_gradient",
                                        "viscous_stress", "buoyancy",   "drag_torque",     "strain_torque",
                                        "pitching_torque"};
constexpr int kDimension = 3;

} // namespace

FixFluidForce::FixFluidForce(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg), geometry_(lmp) {
  const std::vector<std::string> arguments(arg + 3, arg + narg);
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "fix fluid/force needs particles with radius and mass: use atom_style granular");
  if (find(lmp))
    error->all(FLERR, ("fix fluid/force '" + std::string(id) + "' is the second one, after '" + find(lmp)->id +
                       "': write all effects in one fix fluid/force")
                          .c_str());
  try {
    options_ = closures::read_fluid_options(arguments, atom->ntypes);
  } catch (const std::invalid_argument& problem) {
    error->all(FLERR, ("fix fluid/force '" + std::string(id) + "': " + problem.what()).c_str());
  }
  effects_ = closures::make_effects(options_);
  seconds_.assign(effects_.size(), 0.0);
  if (options_.screen.tolerance > 0.0)
    screen_ = std::make_unique<closures::EffectScreen>(options_.screen, effects_);
  geometry_.set_sphericity(options_.sphericity);
  if (options_.turbulent_dispersion)
    eddies_ = std::make_unique<closures::EddyInteraction>(options_.dispersion_seed);

  vector_flag = 1;
  size_vector = kDimension * static_cast<int>(std::size(kEffectOrder));
  global_freq = 1;
  extvector = 1;
  peratom_flag = 1;
  size_peratom_cols = 4;
  peratom_freq = 1;
  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;

  arrays_.declare(kImpulse, kDimension, true);
  arrays_.declare(kCoefficient, 1, true);
  arrays_.declare(kLast, kDimension + 1, true);
  if (eddies_)
    arrays_.declare(kEddies, closures::kEddyColumns, true);
  switch_effects(std::vector<bool>(effects_.size(), true));
  atom->add_callback(0);
  atom->add_callback(1);
}

FixFluidForce::~FixFluidForce() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

FixFluidForce* FixFluidForce::find(LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (auto* fix = dynamic_cast<FixFluidForce*>(lmp->modify->fix[i]))
      return fix;
  return nullptr;
}

void FixFluidForce::switch_effects(const std::vector<bool>& on) {
  acting_ = on;
  needs_ = quantities_of(on);
  declare_arrays();
}

unsigned FixFluidForce::quantities_of(const std::vector<bool>& on) const {
  unsigned all = 0;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    if (on[e])
      all |= effects_[e]->needs();
  return eddies_ && (all & link::kVelocity) ? all | closures::EddyInteraction::kNeeds : all;
}

void FixFluidForce::declare_arrays() {
  for (const link::FlowQuantity& quantity : link::kFlowQuantities) {
    const bool needed = needs_ & quantity.bit;
    const unsigned array = link::place_of(quantity.bit);
    if (arrays_.enabled(array) != needed || !array_atom)
      arrays_.declare(array, quantity.columns, needed);
  }
  grow_arrays(atom->nmax);
}

link::FluidSamples FixFluidForce::samples() {
  awaits_samples_ = false;
  return sample_arrays();
}

link::FluidSamples FixFluidForce::sample_arrays() {
  link::FluidSamples samples;
  for (const link::FlowQuantity& quantity : link::kFlowQuantities)
    samples[quantity.bit] = arrays_.data(link::place_of(quantity.bit));
  return samples;
}

link::FluidReaction FixFluidForce::reaction() {
  return {reinterpret_cast<double(*)[3]>(arrays_.data(kImpulse)), arrays_.data(kCoefficient), elapsed_};
}

void FixFluidForce::reset_reaction() {
  const std::size_t count = atom->nlocal;
  std::fill_n(arrays_.data(kImpulse), kDimension * count, 0.0);
  std::fill_n(arrays_.data(kCoefficient), count, 0.0);
  elapsed_ = 0.0;
}

std::array<double, 3> FixFluidForce::received(int i) {
  const double* impulse = arrays_.data(kImpulse) + kDimension * std::size_t(i);
  const double* last = arrays_.data(kLast) + (kDimension + 1) * std::size_t(i);
  return {impulse[0] - pending_ * last[0], impulse[1] - pending_ * last[1], impulse[2] - pending_ * last[2]};
}

bool FixFluidForce::acts(const std::string& effect) const {
  for (std::size_t e = 0; e < effects_.size(); ++e)
    if (acting_[e] && effect == effects_[e]->slot())
      return true;
  return false;
}

void FixFluidForce::announce_source(const std::string& fix_id) {
  if (std::find(sources_.begin(), sources_.end(), fix_id) == sources_.end())
    sources_.push_back(fix_id);
}

int FixFluidForce::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::PRE_FINAL_INTEGRATE;
}

// LIGGGHTS would call set_arrays for all atoms at the first set-up, also over what was read from a restart file.
void FixFluidForce::post_create() {
  if (!recent_restart)
    for (int i = 0; i < atom->nlocal; ++i)
      set_arrays(i);
  just_created = 0;
}

void FixFluidForce::init() {
  if (std::strcmp(update->integrate_style, "verlet") != 0)
    error->all(FLERR, ("fix fluid/force works with run_style verlet, not with '" +
                       std::string(update->integrate_style) + "': remove the command run_style")
                          .c_str());
  if (modify->n_fixes_style_strict("gravity") > 1)
    error->all(FLERR, "fix fluid/force found more than one fix gravity: buoyancy needs exactly one, so join them");
  if (modify->n_fixes_style("multisphere"))
    error->all(FLERR, "fix fluid/force treats each particle by itself and fix multisphere would make one of each "
                      "sub-sphere: use particletemplate/cluster with fix nve/cluster instead");
  geometry_.init();
  for (const auto& effect : effects_)
    effect->prepare(geometry_);
}

void FixFluidForce::setup(int) {
  sources_.erase(std::remove_if(sources_.begin(), sources_.end(),
                                [this](const std::string& source) { return modify->find_fix(source.c_str()) < 0; }),
                 sources_.end());
  if (needs_ && sources_.empty())
    error->all(FLERR, ("fix fluid/force '" + std::string(id) +
                       "' has nobody to sample the flow: add fix fluid/uniform (a prescribed flow) or fix "
                       "fluid/couple (a solver)")
                          .c_str());
  if (sources_.size() > 1)
    error->all(FLERR, ("fix fluid/force '" + std::string(id) + "' is given the flow by both fix '" + sources_[0] +
                       "' and fix '" + sources_[1] + "': unfix one of them")
                          .c_str());
  first_step_ = !carries_on_;
  carries_on_ = false;
  first_of_run_ = update->ntimestep;
  run_began_ = MPI_Wtime();
  std::fill(seconds_.begin(), seconds_.end(), 0.0);
  eddy_seconds_ = visits_ = 0.0;
  if (!reported_)
    report_effects();
  reported_ = true;
}

// The first half half step of a run is applied here and not in setup(), where fixes further down have not yet added
// theirs.
void FixFluidForce::pre_initial_integrate() {
  if (!first_step_)
    return;
  first_step_ = false;
  // The half half step that a run before this one left unapplied is replaced by a new one.
  auto* impulse = reinterpret_cast<double(*)[3]>(arrays_.data(kImpulse));
  auto* last = reinterpret_cast<double(*)[4]>(arrays_.data(kLast));
  double* coefficient = arrays_.data(kCoefficient);
  for (int i = 0; i < atom->nlocal; ++i) {
    for (int k = 0; k < kDimension; ++k)
      impulse[i][k] -= pending_ * last[i][k];
    coefficient[i] -= pending_ * last[i][kDimension];
  }
  elapsed_ -= pending_;
  apply(0.5 * update->dt, 0.0);
  pending_ = 0.0;
}

void FixFluidForce::pre_final_integrate() {
  apply(update->dt, update->dt);
  pending_ = 0.5 * update->dt;
  if (screen_)
    follow_screen();
}

closures::HalfStep FixFluidForce::make_half_step(double interval) {
  geometry_.refresh();
  closures::HalfStep half_step;
  half_step.count = atom->nlocal;
  half_step.interval = interval;
  half_step.velocity = atom->v;
  half_step.force = atom->f;
  half_step.spin = atom->omega;
  half_step.torque = atom->torque;
  half_step.mass = atom->rmass;
  half_step.radius = geometry_.radius();
  half_step.kind = geometry_.kind();
  half_step.mask = atom->mask;
  half_step.group = groupbit;
  for (int i = 0; i < modify->nfix; ++i) {
    Fix* fix = modify->fix[i];
    if (fix->time_integrate)
      half_step.integrated |= fix->groupbit;
    if (!std::strcmp(fix->style, "freeze"))
      half_step.frozen |= fix->groupbit;
    if (!std::strcmp(fix->style, "gravity"))
      static_cast<FixGravity*>(fix)->get_gravity(half_step.gravity);
  }
  half_step.samples = sample_arrays();
  half_step.impulse = reinterpret_cast<double(*)[3]>(arrays_.data(kImpulse));
  half_step.drag_coefficient = arrays_.data(kCoefficient);
  half_step.last = reinterpret_cast<double(*)[4]>(arrays_.data(kLast));
  return half_step;
}

void FixFluidForce::see_eddies(closures::HalfStep& half_step, double interval) {
  if (!eddies_ || !(needs_ & link::kTurbulence))
    return;
  const double before = MPI_Wtime();
  auto* eddies = reinterpret_cast<closures::Eddy*>(arrays_.data(kEddies));
  eddies_->age(half_step, interval, atom->tag, update->ntimestep, eddies);
  seen_.resize(kDimension * std::size_t(half_step.count));
  closures::EddyInteraction::see(half_step, eddies, reinterpret_cast<double(*)[3]>(seen_.data()));
  half_step.samples[link::kVelocity] = seen_.data();
  eddy_seconds_ += MPI_Wtime() - before;
}

void FixFluidForce::apply(double interval, double ageing) {
  closures::HalfStep half_step = make_half_step(interval);
  see_eddies(half_step, ageing);
  std::fill_n(arrays_.data(kLast), (kDimension + 1) * std::size_t(half_step.count), 0.0);
  elapsed_ += interval;
  if (screen_ && screen_->sample_now()) {
    screen_->apply(half_step, effects_, options_.rheology);
    return;
  }
  double before = MPI_Wtime();
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (!acting_[e])
      continue;
    effects_[e]->apply(half_step);
    const double after = MPI_Wtime();
    seconds_[e] += after - before;
    before = after;
  }
  visits_ += half_step.count;
}

void FixFluidForce::grow_arrays(int rows) {
  arrays_.grow(rows);
  rows_.resize(rows);
  for (int i = 0; i < rows; ++i)
    rows_[i] = arrays_.data(kLast) + (kDimension + 1) * std::size_t(i);
  array_atom = rows_.data();
}

void FixFluidForce::copy_arrays(int from, int to, int) {
  arrays_.copy(from, to);
}

// Until the flow is sampled at it, a new particle moves with the fluid, in clear fluid.
void FixFluidForce::set_arrays(int i) {
  arrays_.zero(i);
  const link::FluidSamples flow = sample_arrays();
  for (const link::FlowQuantity& quantity : link::kFlowQuantities)
    if (double* values = flow[quantity.bit])
      std::fill_n(values + quantity.columns * std::size_t(i), quantity.columns, quantity.at_rest);
  if (flow.velocity())
    std::copy_n(atom->v[i], kDimension, flow.velocity()[i]);
}

int FixFluidForce::pack_exchange(int i, double* buffer) {
  return arrays_.pack(i, buffer);
}

int FixFluidForce::unpack_exchange(int row, double* buffer) {
  return arrays_.unpack(row, buffer);
}

int FixFluidForce::pack_restart(int i, double* buffer) {
  buffer[0] = size_restart(i);
  buffer[1] = arrays_.layout();
  arrays_.pack(i, buffer + 2);
  return size_restart(i);
}

void FixFluidForce::unpack_restart(int row, int nth) {
  const double* extra = atom->extra[row];
  for (int i = 0; i < nth; ++i)
    extra += static_cast<int>(*extra);
  set_arrays(row);
  arrays_.unpack(row, extra + 2, static_cast<unsigned>(extra[1]));
}

int FixFluidForce::size_restart(int) {
  return arrays_.columns() + 2;
}

int FixFluidForce::maxsize_restart() {
  return arrays_.columns() + 2;
}

void FixFluidForce::write_restart(FILE* file) {
  std::vector<double> state = {elapsed_, pending_, double(effects_.size())};
  for (const bool on : acting_)
    state.push_back(on);
  state.push_back(measurement_due_);
  state.push_back(screen_ ? 1.0 : 0.0);
  if (screen_) {
    const std::vector<double> more = screen_->save(world);
    state.insert(state.end(), more.begin(), more.end());
  }
  if (comm->me != 0)
    return;
  const int bytes = static_cast<int>(state.size() * sizeof(double));
  std::fwrite(&bytes, sizeof(int), 1, file);
  std::fwrite(state.data(), sizeof(double), state.size(), file);
}

// The script may name other effects than the one that wrote the file did: then it has its way.
void FixFluidForce::restart(char* buffer) {
  const auto* state = reinterpret_cast<const double*>(buffer);
  elapsed_ = state[0];
  pending_ = state[1];
  const auto count = static_cast<std::size_t>(state[2]);
  const double* screened = state + 4 + count;
  if (count != effects_.size() || !screen_ || *screened == 0.0)
    return;
  screen_->load(screened + 1, comm->me == 0);
  switch_effects(std::vector<bool>(state + 3, state + 3 + count));
  if (state[3 + count] != 0.0)
    prepare_measurement();
}

double FixFluidForce::memory_usage() {
  return double(atom->nmax) * arrays_.columns() * sizeof(double);
}

double FixFluidForce::compute_vector(int n) {
  const std::string wanted = kEffectOrder[n / kDimension];
  double mine = 0.0;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    if (acting_[e] && wanted == effects_[e]->slot())
      mine = effects_[e]->total()[n % kDimension];
  double all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

} // namespace eccentra::styles
