// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What fix fluid/force says: effects and their price, ranges of validity, and the screen that switches effects.
#include "closures/particle_numbers.h"
#include "styles/fluid/fix_fluid_force.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "update.h"

#include <algorithm>
#include <cstdio>

namespace eccentra::styles {

namespace {
/// Shorter runs say nothing about cost, and scripts make them by the hundred.
constexpr int kShortestTimedRun = 1000;
constexpr double kNanosecond = 1e9;
} // namespace

void FixFluidForce::print(const std::string& text) {
  if (comm->me != 0)
    return;
  for (FILE* out : {screen, logfile}) {
    if (!out)
      continue;
    std::fputs(text.c_str(), out);
    std::fflush(out);
  }
}

void FixFluidForce::report_effects() {
  std::string text = "fix fluid/force '" + std::string(id) + "': effects on:";
  int on = 0;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (!acting_[e])
      continue;
    text += std::string(on++ ? ", " : " ") + effects_[e]->name();
  }
  if (eddies_)
    text += ", turbulent_dispersion";
  text += on ? "; asks the flow for" : " none; asks the flow for";
  const int doubles = link::columns_of_set(needs_);
  text += (doubles ? " " : "") + link::names_of(needs_);
  text += doubles ? " (" : " nothing (";
  text += std::to_string(doubles * sizeof(double)) + " bytes per particle); evaluates " + std::to_string(on) +
          " closures per particle and step; holds " + std::to_string(arrays_.columns() * sizeof(double)) +
          " bytes per particle\n";
  print(text);
}

std::vector<double> FixFluidForce::nanoseconds_per_visit() {
  std::vector<double> sums = seconds_;
  sums.push_back(eddy_seconds_);
  sums.push_back(visits_);
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, world);
  const double visits = sums.back();
  sums.pop_back();
  for (double& sum : sums)
    sum = visits > 0.0 ? sum / visits * kNanosecond : 0.0;
  return sums;
}

void FixFluidForce::follow_screen() {
  if (!screen_->step())
    return;
  const std::vector<bool> all(effects_.size(), true);
  if (screen_->measuring()) {
    const std::vector<double> cost = nanoseconds_per_visit();
    const std::vector<bool> keep = screen_->decide(world, effects_);
    print("fix fluid/force '" + std::string(id) + "', step " + std::to_string(update->ntimestep) + ", " +
          screen_->table(effects_, keep, cost));
    switch_effects(keep);
    report_effects();
  } else if (acting_ == all || (measurement_due_ && !awaits_samples_)) {
    measurement_due_ = false;
    switch_effects(all);
    screen_->start();
  } else if (!measurement_due_) {
    // First the flow must be sampled for the effects that are off.
    prepare_measurement();
  }
}

void FixFluidForce::prepare_measurement() {
  measurement_due_ = true;
  awaits_samples_ = true;
  needs_ |= quantities_of(std::vector<bool>(effects_.size(), true));
  declare_arrays();
}

void FixFluidForce::post_run() {
  if (!range_warned_)
    report_ranges();
  if (update->ntimestep - first_of_run_ >= kShortestTimedRun)
    report_cost();
}

// Towards small numbers every closure has a limit that it keeps; only above its range is it extrapolated.
void FixFluidForce::report_ranges() {
  const closures::HalfStep half_step = make_half_step(update->dt);
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (!acting_[e])
      continue;
    for (const closures::Validity& validity : effects_[e]->validity()) {
      LAMMPS_NS::bigint outside[2] = {0, 0};
      for (int i = 0; i < half_step.count; ++i) {
        if (!(half_step.mask[i] & groupbit))
          continue;
        outside[0] += closures::particle_numbers(half_step, i, options_.rheology)[validity.number] > validity.high;
        ++outside[1];
      }
      MPI_Allreduce(MPI_IN_PLACE, outside, 2, MPI_LMP_BIGINT, MPI_SUM, world);
      if (outside[0] == 0)
        continue;
      range_warned_ = true;
      char text[256];
      std::snprintf(text, sizeof(text),
                    "fix fluid/force '%s': %s is used outside its range by %ld of %ld particles: %s is above %g (see "
                    "docs/closures.md for what it does there; said once)",
                    id, effects_[e]->name(), static_cast<long>(outside[0]), static_cast<long>(outside[1]),
                    closures::kNumberNames[validity.number], validity.high);
      if (comm->me == 0)
        error->warning(FLERR, text);
    }
  }
  if (eddies_)
    report_eddies(half_step);
}

void FixFluidForce::report_eddies(const closures::HalfStep& half_step) {
  if (!half_step.samples.turbulence())
    return;
  LAMMPS_NS::bigint larger[2] = {0, 0};
  for (int i = 0; i < half_step.count; ++i) {
    if (!(half_step.mask[i] & groupbit))
      continue;
    const double* turbulence = half_step.samples.turbulence()[i];
    const closures::EddyScales scales = closures::eddy_scales(turbulence[0], turbulence[1]);
    larger[0] += scales.speed > 0.0 && 2.0 * half_step.radius[i] > scales.length;
    ++larger[1];
  }
  MPI_Allreduce(MPI_IN_PLACE, larger, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (larger[0] == 0)
    return;
  range_warned_ = true;
  if (comm->me == 0)
    error->warning(FLERR, ("fix fluid/force '" + std::string(id) + "': turbulent_dispersion moves " +
                           std::to_string(larger[0]) + " of " + std::to_string(larger[1]) +
                           " particles too far: they are larger than the eddies about them, whose whole fluctuation "
                           "they see (docs/turbulence.md; said once)")
                              .c_str());
}

void FixFluidForce::report_cost() {
  const double mine = MPI_Wtime() - run_began_;
  double sums[2] = {eddy_seconds_, mine};
  for (const double seconds : seconds_)
    sums[0] += seconds;
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, world);
  const std::vector<double> cost = nanoseconds_per_visit();
  std::string text = "fix fluid/force '" + std::string(id) + "': ns per particle and step:";
  char part[128];
  int on = 0;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (!acting_[e])
      continue;
    std::snprintf(part, sizeof(part), "%s %s %.1f", on++ ? "," : "", effects_[e]->name(), cost[e]);
    text += part;
  }
  if (eddies_) {
    std::snprintf(part, sizeof(part), ", turbulent_dispersion %.1f", cost.back());
    text += part;
  }
  std::snprintf(part, sizeof(part), "; %.1f %% of the run\n", 100.0 * sums[0] / sums[1]);
  print(text + part);
}

} // namespace eccentra::styles
