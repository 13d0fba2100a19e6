// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements the screen of effects.
#include "closures/effect_screen.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numeric>

namespace eccentra::closures {

namespace {

constexpr double kQuantile = 0.95;
constexpr int kSamples = 64;       ///< of one measurement
constexpr double kFormat = 1000;   ///< of the state: with classes of size
constexpr double kEndless = 1e100; ///< more than the histograms tell apart

bool is_drag(const Effect& effect) {
  return !std::strcmp(effect.slot(), "drag");
}

/// Rows of a LIGGGHTS array, one after the other.
void copy_rows(double** rows, int count, std::vector<double>& out) {
  out.resize(3 * std::size_t(count));
  for (int i = 0; i < count; ++i)
    std::copy_n(rows[i], 3, &out[3 * std::size_t(i)]);
}

double change_of_row(const double* now, const double* before) {
  const double change[3] = {now[0] - before[0], now[1] - before[1], now[2] - before[2]};
  return base::norm(change);
}

/// a/b where nothing over nothing is nothing, and something over nothing is endless. No division by zero: a solver
/// that hosts this library traps it.
double ratio(double a, double b) {
  if (a == 0.0)
    return 0.0;
  return b <= a / kEndless ? kEndless : a / b;
}

template <class... Values> void append(std::string& text, const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof(line), format, values...);
  text += line;
}

} // namespace

EffectScreen::EffectScreen(const ScreenOptions& options, const EffectList& effects)
    : options_(options), stride_(std::max(1, options.steps / kSamples)) {
  measures_.resize(effects.size());
  numbers_.resize(kNumbers);
}

void EffectScreen::clear() {
  for (LogHistogram* histogram : histograms(~0U))
    *histogram = LogHistogram();
}

int EffectScreen::class_of(double radius) {
  constexpr double smallest = 1e-6; // [m]
  return std::clamp(static_cast<int>(std::floor(std::log2(std::max(radius, smallest) / smallest))), 0, kClasses - 1);
}

unsigned EffectScreen::classes() const {
  unsigned present = 0;
  for (int k = 0; k < kClasses && !measures_.empty(); ++k)
    present |= measures_.front().to_reference[static_cast<std::size_t>(k)].count() > 0 ? 1U << unsigned(k) : 0U;
  return present;
}

double EffectScreen::deciding(std::size_t effect) const {
  double largest = 0;
  for (const LogHistogram& of_class : measures_[effect].to_reference)
    largest = std::max(largest, of_class.quantile(kQuantile));
  return largest;
}

std::vector<LogHistogram*> EffectScreen::histograms(unsigned classes) {
  std::vector<LogHistogram*> all;
  for (Measure& m : measures_) {
    all.insert(all.end(), {&m.to_weight, &m.to_drag});
    for (int k = 0; k < kClasses; ++k)
      if ((classes >> unsigned(k)) & 1U)
        all.push_back(&m.to_reference[static_cast<std::size_t>(k)]);
  }
  for (LogHistogram& number : numbers_)
    all.push_back(&number);
  return all;
}

void EffectScreen::merge(MPI_Comm ranks) {
  unsigned present = classes();
  MPI_Allreduce(MPI_IN_PLACE, &present, 1, MPI_UNSIGNED, MPI_BOR, ranks);
  for (LogHistogram* histogram : histograms(present))
    histogram->merge(ranks);
}

void EffectScreen::apply(const HalfStep& half_step, const EffectList& effects, const Rheology& fluid) {
  const std::size_t count = half_step.count;
  magnitude_.assign(effects.size() * count, 0.0);
  torque_peers_.resize(count);
  for (int i = 0; i < half_step.count; ++i)
    torque_peers_[i] = base::norm(half_step.torque[i]);
  for (std::size_t e = 0; e < effects.size(); ++e) {
    copy_rows(half_step.force, half_step.count, before_force_);
    copy_rows(half_step.torque, half_step.count, before_torque_);
    effects[e]->apply(half_step);
    double** const rows = effects[e]->is_torque() ? half_step.torque : half_step.force;
    const std::vector<double>& before = effects[e]->is_torque() ? before_torque_ : before_force_;
    for (std::size_t i = 0; i < count; ++i)
      magnitude_[e * count + i] = change_of_row(rows[i], &before[3 * i]);
  }
  const auto drag = std::find_if(effects.begin(), effects.end(), [](const auto& effect) { return is_drag(*effect); });
  const double g = base::norm(half_step.gravity);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(half_step.mask[i] & half_step.group) || (half_step.mask[i] & half_step.frozen))
      continue;
    const double weight = std::abs(half_step.mass[i] - fluid.density * sphere_volume(half_step.radius[i])) * g;
    const double resisted = drag == effects.end() ? 0.0 : magnitude_[(drag - effects.begin()) * count + i];
    const auto size_class = static_cast<std::size_t>(class_of(half_step.radius[i]));
    for (std::size_t e = 0; e < effects.size(); ++e) {
      const double size = magnitude_[e * count + i];
      Measure& m = measures_[e];
      LogHistogram& to_reference = m.to_reference[size_class];
      if (effects[e]->is_torque()) {
        m.to_weight.add(ratio(size, weight * half_step.radius[i]));
        m.to_drag.add(ratio(size, resisted * half_step.radius[i]));
        to_reference.add(ratio(size, torque_peers_[i]));
      } else {
        m.to_weight.add(ratio(size, weight));
        m.to_drag.add(ratio(size, resisted));
        to_reference.add(ratio(size, std::max(weight, resisted)));
      }
    }
    const auto numbers = particle_numbers(half_step, static_cast<int>(i), fluid);
    for (int n = 0; n < kNumbers; ++n)
      numbers_[n].add(numbers[n]);
  }
}

bool EffectScreen::step() {
  ++done_;
  if (measuring_)
    return done_ >= options_.steps;
  return options_.recheck > 0 && done_ >= options_.recheck;
}

void EffectScreen::start() {
  clear();
  measuring_ = true;
  done_ = 0;
}

std::vector<bool> EffectScreen::decide(MPI_Comm ranks, const EffectList& effects) {
  merge(ranks);
  std::vector<std::size_t> order(measures_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto size = [this](std::size_t e) { return deciding(e); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size(a) < size(b); });
  std::vector<bool> keep(measures_.size(), true);
  double dropped = 0.0;
  for (const std::size_t e : order) {
    dropped += size(e);
    // No particle was there to judge by: keep.
    if (dropped > options_.tolerance || measures_[e].to_weight.count() == 0)
      break;
    keep[e] = false;
  }
  for (std::size_t e = 0; e < effects.size(); ++e)
    for (std::size_t other = 0; keep[e] && effects[e]->requires_slot() && other < effects.size(); ++other)
      if (!std::strcmp(effects[other]->slot(), effects[e]->requires_slot()))
        keep[other] = true;
  measuring_ = false;
  done_ = 0;
  return keep;
}

std::string EffectScreen::table(const EffectList& effects, const std::vector<bool>& keep,
                                const std::vector<double>& nanoseconds) const {
  std::string text;
  append(text, "screen: %d steps, %lld observations, tolerance %g\n", options_.steps,
         static_cast<long long>(numbers_[0].count()), options_.tolerance);
  text += "                      of submerged weight         of drag                     decides     cost\n"
          "  effect              mean     95 %     largest   mean     95 %     largest   95 %        ns/particle\n";
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const Measure& m = measures_[e];
    append(text, "  %-18s  %-8.2e %-8.2e %-8.2e  %-8.2e %-8.2e %-8.2e  %-8.2e    %-8.1f  %s\n", effects[e]->name(),
           m.to_weight.mean(), m.to_weight.quantile(kQuantile), m.to_weight.largest(), m.to_drag.mean(),
           m.to_drag.quantile(kQuantile), m.to_drag.largest(), deciding(e), nanoseconds[e],
           keep[e] ? "stays on" : "switched off");
  }
  const unsigned present = classes();
  if ((present & (present - 1)) != 0) { // more than one
    text += "  what decides, by classes of size: diameter from [mm]";
    for (int k = 0; k < kClasses; ++k)
      if ((present >> unsigned(k)) & 1U)
        append(text, "  %-8.3g", 2e-3 * std::pow(2.0, k));
    text += "\n";
    for (std::size_t e = 0; e < effects.size(); ++e) {
      append(text, "    %-49s", effects[e]->name());
      for (int k = 0; k < kClasses; ++k)
        if ((present >> unsigned(k)) & 1U)
          append(text, "  %-8.2e", measures_[e].to_reference[static_cast<std::size_t>(k)].quantile(kQuantile));
      text += "\n";
    }
  }
  double all = 0.0, kept = 0.0;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    all += nanoseconds[e];
    kept += keep[e] ? nanoseconds[e] : 0.0;
  }
  append(text, "  what stays on costs %.1f of %.1f ns per particle and step\n", kept, all);
  text +=
      "  (torques: of weight or drag times R; what decides is the ratio to the larger of weight and drag, for a torque"
      " to all other torques)\n"
      "  number              mean     95 %     largest   held by\n";
  for (int n = 0; n < kNumbers; ++n) {
    append(text, "  %-18s  %-8.2e %-8.2e %-8.2e ", kNumberNames[n], numbers_[n].mean(), numbers_[n].quantile(kQuantile),
           numbers_[n].largest());
    for (const auto& effect : effects)
      for (const Validity& validity : effect->validity())
        if (validity.number == n)
          append(text, " %s: %g to %g%s;", effect->name(), validity.low, validity.high,
                 numbers_[n].largest() > validity.high ? " (EXCEEDED)" : "");
    text += "\n";
  }
  return text;
}

std::vector<double> EffectScreen::save(MPI_Comm ranks) const {
  EffectScreen merged = *this;
  merged.merge(ranks);
  const unsigned present = merged.classes();
  std::vector<double> state = {double(measuring_), double(done_), kFormat + double(measures_.size()), double(present)};
  for (LogHistogram* histogram : merged.histograms(present)) {
    state.resize(state.size() + LogHistogram::state_size());
    histogram->save(&state[state.size() - LogHistogram::state_size()]);
  }
  return state;
}

std::size_t EffectScreen::load(const double* state, bool with_sums) {
  measuring_ = state[0] != 0.0;
  done_ = static_cast<long>(state[1]);
  if (state[2] != kFormat + double(measures_.size()))
    return 0;
  std::size_t read = 4;
  for (LogHistogram* histogram : histograms(static_cast<unsigned>(state[3]))) {
    if (with_sums)
      histogram->load(state + read);
    read += LogHistogram::state_size();
  }
  return read;
}

} // namespace eccentra::closures
