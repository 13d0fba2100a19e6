// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The rules by which two solvers refuse each other.
#include "link/terms.h"

#include "link/flow_quantities.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace eccentra::link {
namespace {

/// Relative difference of two time intervals, densities or periodic lengths that counts as agreement.
constexpr double kSame = 1e-6;
/// Two boxes describe the same place if they share at least this part of the longer of the two, per direction.
constexpr double kSharedPart = 0.5;
/// Components of gravity are typed with a few digits: this part of its size is agreement (0.06 degrees).
constexpr double kSameGravity = 1e-3;

bool same(double a, double b) {
  return std::abs(a - b) <= kSame * std::max(std::abs(a), std::abs(b));
}

template <class... Values> std::string sentence(const char* format, Values... values) {
  char text[512];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string extents_disagreement(const Extents& dem, const Extents& fluid) {
  static const char axis[] = {'x', 'y', 'z'};
  for (int k = 0; k < 3; ++k) {
    const double dem_length = dem.high[k] - dem.low[k];
    const double fluid_length = fluid.high[k] - fluid.low[k];
    if (dem.periodic[k] != fluid.periodic[k])
      return sentence("direction %c is %s in the DEM script but %s in the mesh: make both the same (boundary command, "
                      "patches of the mesh)",
                      axis[k], dem.periodic[k] ? "periodic" : "not periodic",
                      fluid.periodic[k] ? "periodic" : "not periodic");
    if (dem.periodic[k] &&
        (!same(dem_length, fluid_length) || std::abs(dem.low[k] - fluid.low[k]) > kSame * fluid_length))
      return sentence(
          "the periodic direction %c spans %g to %g m in the DEM script but %g to %g m in the mesh: make both "
          "the same",
          axis[k], dem.low[k], dem.high[k], fluid.low[k], fluid.high[k]);
    const double shared = std::min(dem.high[k], fluid.high[k]) - std::max(dem.low[k], fluid.low[k]);
    if (shared < kSharedPart * std::max(dem_length, fluid_length))
      return sentence(
          "direction %c spans %g to %g m in the DEM script but %g to %g m in the mesh, which is another place "
          "or another length unit: check both",
          axis[k], dem.low[k], dem.high[k], fluid.low[k], fluid.high[k]);
  }
  return "";
}

double size(const double (&v)[3]) {
  return std::hypot(v[0], v[1], v[2]);
}

std::string rheology_disagreement(const FlowCurve& dem, const FlowCurve& fluid) {
  const bool applied = dem.consistency > 0 && fluid.consistency > 0;
  if (!applied || (same(dem.yield_stress, fluid.yield_stress) && same(dem.consistency, fluid.consistency) &&
                   same(dem.index, fluid.index)))
    return "";
  return sentence("the fluid's rheology is tau0 %g Pa, k %g Pa s^n, n %g in fix fluid/force but tau0 %g, k %g, n %g in "
                  "constant/transportProperties: make both the same",
                  dem.yield_stress, dem.consistency, dem.index, fluid.yield_stress, fluid.consistency, fluid.index);
}

std::string gravity_disagreement(const DemTerms& dem, const FluidTerms& fluid) {
  const double difference[3] = {dem.gravity[0] - fluid.gravity[0], dem.gravity[1] - fluid.gravity[1],
                                dem.gravity[2] - fluid.gravity[2]};
  if (!fluid.has_gravity || size(difference) <= kSameGravity * std::max(size(dem.gravity), size(fluid.gravity)))
    return "";
  return sentence(
      "gravity is (%g %g %g) m/s2 in the DEM script (fix gravity) but (%g %g %g) in constant/g: make both the "
      "same, or remove constant/g, which the flow does not need",
      dem.gravity[0], dem.gravity[1], dem.gravity[2], fluid.gravity[0], fluid.gravity[1], fluid.gravity[2]);
}

} // namespace

std::string disagreement(const DemTerms& dem, const FluidTerms& fluid) {
  if (dem.protocol != fluid.protocol)
    return sentence("the DEM side speaks version %u of the protocol and the fluid side version %u: install the same "
                    "release of Eccentra on both",
                    dem.protocol, fluid.protocol);
  if (!same(dem.length_unit, fluid.length_unit))
    return sentence("one unit of length is %g m in the DEM script but %g m in the mesh: use 'units si'",
                    dem.length_unit, fluid.length_unit);
  if (!(dem.time_step > 0) || dem.interval < 1 || !(fluid.time_step > 0))
    return sentence("the steps of time must be positive (timestep %g s, every %lld, deltaT %g s)", dem.time_step,
                    static_cast<long long>(dem.interval), fluid.time_step);
  if (!same(dem.time_step * dem.interval, fluid.time_step))
    return sentence(
        "%lld DEM steps of %g s make %.9g s but the fluid step (deltaT) is %.9g s: change every, timestep or "
        "deltaT",
        static_cast<long long>(dem.interval), dem.time_step, dem.time_step * dem.interval, fluid.time_step);
  if (const std::string text = extents_disagreement(dem.domain, fluid.domain); !text.empty())
    return text;
  if (const unsigned missing = dem.needed & ~fluid.offered; missing != 0)
    return missing == kTurbulence
               ? std::string("turbulent_dispersion of fix fluid/force needs the turbulence of the flow but this solver "
                             "computes a laminar one: choose a turbulence model there, or drop the word")
               : sentence("the closures need %s of the flow but this solver does not offer that: drop the effect that "
                          "needs it from fix fluid/force",
                          names_of(missing).c_str());
  if (dem.fluid_density > 0 && !same(dem.fluid_density, fluid.fluid_density))
    return sentence("the fluid's density is %g kg/m3 in fix fluid/force but %g kg/m3 in the solver: make both the same",
                    dem.fluid_density, fluid.fluid_density);
  if (const std::string text = rheology_disagreement(dem.rheology, fluid.rheology); !text.empty())
    return text;
  return gravity_disagreement(dem, fluid);
}

} // namespace eccentra::link
