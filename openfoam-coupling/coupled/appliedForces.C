// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Means of pressure gradient and stress divergence over the steps of an interval.
#include "coupled/appliedForces.H"

#include "link/flow_quantities.h"

namespace eccentra {

using namespace Foam;

appliedForces::appliedForces(const averagedFlow& flow, unsigned asked)
    : flow_(flow), pressure_(asked & link::kPressureGradient), stress_(asked & link::kStressDivergence) {}

void appliedForces::add(const volScalarField& alpha, scalar part) {
  if (pressure_)
    pressureMean_.add(flow_.pressureGradient(), alpha, part);
  if (stress_)
    stressMean_.add(flow_.stressDivergence(), alpha, part);
}

void appliedForces::complete(const volScalarField& alpha, scalar part, exchange::FlowFields& fields) {
  if (pressure_) {
    pressureGradient_ = flow_.pressureGradient();
    pressureMean_.complete(pressureGradient_.ref(), alpha, part);
    fields.pressureGradient = &pressureGradient_().primitiveField();
  }
  if (stress_) {
    stressDivergence_ = flow_.stressDivergence();
    stressMean_.complete(stressDivergence_.ref(), alpha, part);
    fields.stressDivergence = &stressDivergence_().primitiveField();
  }
}

} // namespace eccentra
