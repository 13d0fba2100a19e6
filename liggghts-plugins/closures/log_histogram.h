// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Distribution of a positive quantity over many decades. Integer counts give the same quantiles on any number of ranks.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace eccentra::closures {

/// Counts of positive values in bins of equal width in their logarithm, with their mean and the largest. Memory does
/// not depend on their number.
class LogHistogram {
 public:
  LogHistogram() : counts_(kBins, 0) {}

  /// Values below the lowest bin count there, values above the highest one in that.
  void add(double value) {
    const double place = value > kLowest ? 1.0 + std::log10(value / kLowest) * kPerDecade : 0.0;
    ++counts_[static_cast<int>(std::min(place, kBins - 1.0))];
    const double capped = std::min(value, kHighest);
    sum_ += capped;
    largest_ = std::max(largest_, capped);
  }
  /// Sums over all ranks; each rank then has the result. Collective.
  void merge(MPI_Comm ranks) {
    MPI_Allreduce(MPI_IN_PLACE, counts_.data(), kBins, MPI_INT64_T, MPI_SUM, ranks);
    MPI_Allreduce(MPI_IN_PLACE, &sum_, 1, MPI_DOUBLE, MPI_SUM, ranks);
    MPI_Allreduce(MPI_IN_PLACE, &largest_, 1, MPI_DOUBLE, MPI_MAX, ranks);
  }
  /// Number of values.
  std::int64_t count() const {
    std::int64_t all = 0;
    for (const std::int64_t c : counts_)
      all += c;
    return all;
  }
  /// Exact mean; 0 without values.
  double mean() const { return count() ? sum_ / double(count()) : 0.0; }
  /// Exact largest value; 0 without values.
  double largest() const { return largest_; }
  /// Quantile: the upper edge of its bin (5 %).
  double quantile(double part) const {
    const double wanted = part * double(count());
    std::int64_t below = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      below += counts_[bin];
      if (double(below) >= wanted)
        return bin == 0 ? 0.0 : std::min(largest_, kLowest * std::pow(10.0, double(bin) / kPerDecade));
    }
    return largest_;
  }

  /// Number of doubles of a saved state.
  static constexpr int state_size() { return kBins + 2; }
  /// Writes state_size() doubles.
  void save(double* state) const {
    std::copy(counts_.begin(), counts_.end(), state);
    state[kBins] = sum_;
    state[kBins + 1] = largest_;
  }
  /// Reads what save() wrote.
  void load(const double* state) {
    for (int bin = 0; bin < kBins; ++bin)
      counts_[bin] = static_cast<std::int64_t>(state[bin]);
    sum_ = state[kBins];
    largest_ = state[kBins + 1];
  }

 private:
  static constexpr double kLowest = 1e-12, kHighest = 1e12;
  static constexpr int kPerDecade = 50;
  static constexpr int kBins = 24 * kPerDecade + 2; ///< all decades, what lies below and what lies above
  std::vector<std::int64_t> counts_;
  double sum_ = 0.0;
  double largest_ = 0.0;
};

} // namespace eccentra::closures
