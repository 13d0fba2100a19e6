// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method: the surface of a union is the growth of its volume.
#include "shape/vtk/balanced_cover.h"

#include "shape/union_geometry.h"

#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr double kVolumeError = 1e-9;
constexpr int kMaxSteps = 50;

} // namespace

double grow_to_volume(std::vector<Sphere>& spheres, double volume) {
  double grown = 0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const MassProperties p = measure_union(spheres).properties;
    if (std::abs(p.volume - volume) <= kVolumeError * volume)
      return grown;
    const double by = (volume - p.volume) / p.surface;
    for (Sphere& s : spheres)
      s.radius += by;
    grown += by;
  }
  throw std::invalid_argument("no growth of the spheres gives their union the volume of the solid: write cover inside");
}

} // namespace eccentra::shape
