// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names and sizes of the quantities that travel, and their sums.
#include "coupled/fluidRequests.H"

#include "link/flow_quantities.h"

#include "messageStream.H"

namespace eccentra {

using Foam::endl;
using Foam::Info;

namespace {

/// Meetings from one report to the next.

constexpr double kMegabyte = 1e6;

/// A quantity that the particles may ask for.
struct Asked {
  unsigned bit;
  const char* name;
  int doubles;
};
constexpr Asked kQuantities[] = {{link::kVelocity, "velocity", 3},
                                 {link::kFraction, "fraction", 1},
                                 {link::kPressureGradient, "pressureGradient", 3},
                                 {link::kStressDivergence, "stressDivergence", 3},
                                 {link::kVorticity, "vorticity", 3}};

/// Bytes of one particle's samples.
std::size_t bytesToParticles(unsigned needed) {
  std::size_t doubles = 0;
  for (const Asked& quantity : kQuantities)
    doubles += needed & quantity.bit ? quantity.doubles : 0;
  return doubles * sizeof(double);
}

/// Bytes of one particle on its way to the fluid: position, volume, impulse, drag coefficient, extent.
std::size_t bytesToFluid(bool extents) {
  return (3 + 1 + 3 + 1 + (extents ? link::kExtentDoubles : 0)) * sizeof(double);
}

} // namespace

void fluidRequests::add(const link::CouplingStep& couplingStep, bool extents) {
  asked_ = couplingStep.needed;
  ++couplingSteps_;
  pressureGradients_ += (asked_ & link::kPressureGradient) != 0;
  stressDivergences_ += (asked_ & link::kStressDivergence) != 0;
  velocityGradients_ += (asked_ & (link::kVelocity | link::kVorticity)) != 0;
  fractionGradients_ += (asked_ & link::kFraction) != 0;
  bytesToFluid_ += double(couplingStep.totals.particles) * bytesToFluid(extents);
  bytesToParticles_ += double(couplingStep.totals.particles) * bytesToParticles(asked_);
}

void fluidRequests::print(const link::CouplingStep& couplingStep, bool extents, double time, int cells, double length) {
  Info << "coupling, t " << time << " s: " << int(couplingStep.totals.particles) << " particles on " << cells
       << " cells; the fluid is asked for";
  for (const Asked& quantity : kQuantities)
    if (couplingStep.needed & quantity.bit)
      Info << " " << quantity.name;
  Info << (couplingStep.needed ? "" : " nothing") << "; " << int(bytesToFluid(extents))
       << " bytes per particle to the fluid, " << int(bytesToParticles(couplingStep.needed))
       << " back; spreading length " << length << " m" << endl;
}

void fluidRequests::printSums() const {
  Info << "computed in " << couplingSteps_ << " meetings: pressureGradient " << pressureGradients_
       << " times, stressDivergence " << stressDivergences_ << ", velocity gradient " << velocityGradients_
       << ", fraction gradient " << fractionGradients_ << "; " << bytesToFluid_ / kMegabyte
       << " MB of particles to the fluid, " << bytesToParticles_ / kMegabyte << " MB of samples back" << endl;
}

} // namespace eccentra
