// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Measures each effect in a scene and decides which of them are kept.
#pragma once

#include "closures/effect.h"
#include "closures/log_histogram.h"
#include "closures/particle_numbers.h"
#include "closures/screen_options.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace eccentra::closures {

/// During a measurement every effect is on. Forces are compared with the larger of submerged weight and drag of the
/// same particle; the rotational drag with the sum of all other torques on it. Particles are judged by classes of size,
/// each of a factor of two: of an effect the largest of the 95 % values of all classes counts, so that many large
/// bodies do not decide for a few small ones. The effects with the smallest values are dropped as long as the sum of
/// the dropped values stays below the tolerance. An effect that another one needs stays with it.
class EffectScreen {
 public:
  /// `effects` must have the same order in later calls.
  EffectScreen(const ScreenOptions& options, const EffectList& effects);

  /// As given.
  const ScreenOptions& options() const { return options_; }
  /// True while measuring (every effect is on).
  bool measuring() const { return measuring_; }
  /// True in the half steps whose forces are recorded.
  bool sample_now() const { return measuring_ && done_ % stride_ == 0; }
  /// Applies all effects like a half step without a screen, and records the force of each.
  void apply(const HalfStep& half_step, const EffectList& effects, const Rheology& fluid);
  /// Counts a step. True if a measurement has just ended or must begin; measuring() tells which.
  bool step();
  /// Begins a measurement.
  void start();
  /// Ends a measurement. One flag per effect, true: kept. The same on all ranks; collective.
  std::vector<bool> decide(MPI_Comm ranks, const EffectList& effects);
  /// The table of the last measurement; nanoseconds per particle and step of each effect as measured elsewhere.
  std::string table(const EffectList& effects, const std::vector<bool>& keep,
                    const std::vector<double>& nanoseconds) const;

  /// State for a restart file: sums over ranks, so call on all ranks; load with the sums on one rank only.
  std::vector<double> save(MPI_Comm ranks) const;
  /// Returns the number of values read.
  std::size_t load(const double* state, bool with_sums);

 private:
  static constexpr int kClasses = 17; ///< of size; the first one begins at a radius of 1 um
  /// Record of one effect.
  struct Measure {
    LogHistogram to_weight, to_drag;
    std::vector<LogHistogram> to_reference = std::vector<LogHistogram>(kClasses);
  };
  static int class_of(double radius);
  double deciding(std::size_t effect) const;
  /// One bit for each class that has particles.
  unsigned classes() const;
  /// The histograms of what these classes have.
  std::vector<LogHistogram*> histograms(unsigned classes);
  void merge(MPI_Comm ranks);
  void clear();

  ScreenOptions options_;
  int stride_;
  bool measuring_ = true;
  long done_ = 0; ///< steps since the measurement or the pause began
  std::vector<Measure> measures_;
  std::vector<LogHistogram> numbers_;
  std::vector<double> before_force_, before_torque_, magnitude_, torque_peers_;
};

} // namespace eccentra::closures
