// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of the quantities that travel, and their sums.
#include "coupled/fluidRequests.H"

#include "link/flow_quantities.h"

#include "messageStream.H"

namespace eccentra {

using Foam::endl;
using Foam::Info;

namespace {

constexpr double kMegabyte = 1e6;

/// Bytes of one particle's samples.
std::size_t bytesToParticles(unsigned needed) {
  return link::columns_of_set(needed) * sizeof(double);
}

/// Bytes of one particle on its way to the fluid: position, volume, impulse, drag coefficient, extent.
std::size_t bytesToFluid(bool extents) {
  return (3 + 1 + 3 + 1 + (extents ? link::kExtentDoubles : 0)) * sizeof(double);
}

} // namespace

void fluidRequests::add(const link::CouplingStep& couplingStep, bool extents) {
  asked_ = couplingStep.needed;
  ++couplingSteps_;
  for (const link::FlowQuantity& quantity : link::kFlowQuantities)
    times_[quantity.bit] += (asked_ & quantity.bit) != 0;
  bytesToFluid_ += double(couplingStep.totals.particles) * bytesToFluid(extents);
  bytesToParticles_ += double(couplingStep.totals.particles) * bytesToParticles(asked_);
}

void fluidRequests::print(const link::CouplingStep& couplingStep, bool extents, double time, int cells, double length) {
  Info << "coupling, t " << time << " s: " << int(couplingStep.totals.particles) << " particles on " << cells
       << " cells; the fluid is asked for "
       << (couplingStep.needed ? link::names_of(couplingStep.needed, " ").c_str() : "nothing") << "; "
       << int(bytesToFluid(extents)) << " bytes per particle to the fluid, "
       << int(bytesToParticles(couplingStep.needed)) << " back; spreading length " << length << " m" << endl;
}

void fluidRequests::printSums() const {
  Info << "computed in " << couplingSteps_ << " coupling steps:";
  for (const link::FlowQuantity& quantity : link::kFlowQuantities)
    Info << " " << quantity.name << " " << times_[quantity.bit] << " times,";
  Info << " " << bytesToFluid_ / kMegabyte << " MB of particles to the fluid, " << bytesToParticles_ / kMegabyte
       << " MB of samples back" << endl;
}

} // namespace eccentra
