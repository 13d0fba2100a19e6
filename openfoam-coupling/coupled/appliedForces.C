// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Means of the force densities over the steps of an interval.
#include "coupled/appliedForces.H"

#include "link/flow_quantities.h"

namespace eccentra {

using namespace Foam;

namespace {

/// As the flow has it at present [N/m3].
tmp<volVectorField> densityOf(const averagedFlow& flow, link::Quantity quantity) {
  return quantity == link::kPressureGradient ? flow.pressureGradient() : flow.stressDivergence();
}

} // namespace

appliedForces::appliedForces(const averagedFlow& flow, unsigned asked) : flow_(flow), asked_(asked) {}

void appliedForces::add(const volScalarField& alpha, scalar part) {
  for (const auto& [quantity, sign] : exchange::kForceDensities)
    if (asked_ & quantity)
      mean_[quantity].add(densityOf(flow_, quantity), alpha, part);
}

void appliedForces::complete(const volScalarField& alpha, scalar part, exchange::FlowFields& fields) {
  for (const auto& [quantity, sign] : exchange::kForceDensities)
    if (asked_ & quantity) {
      density_[quantity] = densityOf(flow_, quantity);
      mean_[quantity].complete(density_[quantity].ref(), alpha, part);
      fields.density[quantity] = &density_[quantity]().primitiveField();
    }
}

} // namespace eccentra
