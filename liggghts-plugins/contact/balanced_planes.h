// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the planes between ranks should stand so that each slab holds as many bodies; pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace eccentra::contact {

/// `planes`: the present ones as fractions of the box, from 0 to 1, one more than slabs. `counts`: bodies in equal bins
/// over the box, all ranks together. Returns planes nearer to equal shares: each moves at most half of the way to its
/// neighbours, so that no body changes by more than one slab, and leaves slabs of at least `narrowest` (where that many
/// fit).
inline std::vector<double> balanced_planes(const std::vector<double>& planes, const std::vector<double>& counts,
                                           double narrowest) {
  const int slabs = static_cast<int>(planes.size()) - 1;
  double total = 0;
  for (const double count : counts)
    total += count;
  std::vector<double> next = planes;
  if (total <= 0)
    return next;
  narrowest = std::min(narrowest, 1. / slabs);
  std::size_t bin = 0;
  double before = 0; // bodies below this bin
  for (int p = 1; p < slabs; ++p) {
    const double wanted = total * p / slabs;
    while (bin < counts.size() && before + counts[bin] < wanted)
      before += counts[bin++];
    const double inside = bin < counts.size() && counts[bin] > 0 ? (wanted - before) / counts[bin] : 0;
    const double ideal = (static_cast<double>(bin) + inside) / static_cast<double>(counts.size());
    const double low = 0.5 * (planes[p - 1] + planes[p]), high = 0.5 * (planes[p] + planes[p + 1]);
    next[p] = std::clamp(ideal, low, high);
  }
  for (int p = 1; p < slabs; ++p)
    next[p] = std::max(next[p], next[p - 1] + narrowest);
  for (int p = slabs - 1; p > 0; --p)
    next[p] = std::min(next[p], next[p + 1] - narrowest);
  // A plane pushed along by its neighbours must not carry bodies past a slab.
  for (int p = 1; p < slabs; ++p)
    if (next[p] < planes[p - 1] || next[p] > planes[p + 1])
      return planes;
  return next;
}

/// True if each slab is at least `narrowest` wide, to round-off, or as wide as equal parts would be.
inline bool as_wide_as(const std::vector<double>& planes, double narrowest) {
  const double least = std::min(narrowest, 1. / static_cast<double>(planes.size() - 1)) * (1 - 1e-9);
  for (std::size_t p = 1; p < planes.size(); ++p)
    if (!(planes[p] - planes[p - 1] >= least))
      return false;
  return true;
}

/// Planes as near to `goal` as half of the way to their neighbours lets them come in one go, so that no body changes by
/// more than one slab. Both with as many planes, from 0 to 1.
inline std::vector<double> planes_towards(const std::vector<double>& planes, const std::vector<double>& goal) {
  std::vector<double> next = planes;
  for (std::size_t p = 1; p + 1 < planes.size(); ++p)
    next[p] = std::clamp(goal[p], 0.5 * (planes[p - 1] + planes[p]), 0.5 * (planes[p] + planes[p + 1]));
  return next;
}

} // namespace eccentra::contact
