// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the fields from the flow and from its turbulence model.
#include "coupled/presentFlow.H"

#include "link/flow_quantities.h"

#include "turbulenceModel.H"

namespace eccentra {

using namespace Foam;

presentFlow::presentFlow(averagedFlow& flow, unsigned asked)
    : fraction_(flow.alpha()), velocity_(flow.velocityOfFluxes()) {
  if (asked & link::kTurbulence) {
    energy_ = flow.turbulence()->k();
    dissipation_ = flow.turbulence()->epsilon();
  }
}

void presentFlow::give(exchange::FlowFields& fields) const {
  fields.velocity = &velocity_();
  fields.fraction = &fraction_;
  if (energy_.valid())
    fields.turbulence = {&energy_(), &dissipation_()};
}

} // namespace eccentra
