// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Compares all spheres of a list with each other.
#include "shape/coincident_spheres.h"

#include <algorithm>
#include <cmath>

namespace eccentra::shape {
namespace {

constexpr double kSame = 1e-3, kNear = 0.05; ///< parts of the larger radius

/// How far two spheres are from being one, in parts of the larger radius.
double difference(const Sphere& a, const Sphere& b) {
  return ((a.centre - b.centre).norm() + std::abs(a.radius - b.radius)) / std::max(a.radius, b.radius);
}

} // namespace

void merge_coincident(std::vector<Sphere>& spheres, const std::string& where, Notes& notes) {
  std::vector<bool> dropped(spheres.size(), false);
  int repeated = 0, close = 0;
  std::string first_repeated, first_close;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = i + 1; j < spheres.size() && !dropped[i]; ++j) {
      if (dropped[j])
        continue;
      const double apart = difference(spheres[i], spheres[j]);
      const std::string pair = std::to_string(i + 1) + " and " + std::to_string(j + 1);
      if (apart <= kSame) {
        dropped[spheres[j].radius > spheres[i].radius ? i : j] = true;
        if (++repeated == 1)
          first_repeated = pair;
      } else if (apart <= kNear && ++close == 1) {
        first_close = pair;
      }
    }
  if (repeated > 0) {
    std::vector<Sphere> kept;
    for (std::size_t k = 0; k < spheres.size(); ++k)
      if (!dropped[k])
        kept.push_back(spheres[k]);
    notes.push_back(
        {where + ": " + std::to_string(repeated) + " of " + std::to_string(spheres.size()) +
         " spheres repeat another within 0.1 % of its radius and were left out (first pair: " + first_repeated + ")"});
    spheres = kept;
  }
  if (close > 0)
    notes.push_back({where + ": " + std::to_string(close) +
                     " pair(s) of spheres nearly coincide, within 5 % of the "
                     "radius (first: " +
                     first_close + "); each sphere is a contact of its own: delete one of each pair"});
}

} // namespace eccentra::shape
