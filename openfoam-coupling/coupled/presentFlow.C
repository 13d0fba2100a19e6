// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the fields from the flow and from its turbulence model.
#include "coupled/presentFlow.H"

#include "link/flow_quantities.h"

#include "turbulenceModel.H"

namespace eccentra {

using namespace Foam;

presentFlow::presentFlow(const averagedFlow& flow, unsigned asked) : flow_(flow), velocity_(flow.velocityOfFluxes()) {
  if (asked & link::kTurbulence) {
    energy_ = flow.turbulence()->k();
    dissipation_ = flow.turbulence()->epsilon();
  }
}

void presentFlow::give(exchange::FlowFields& fields) const {
  fields.velocity = &velocity_();
  fields.fraction = &flow_.alpha();
  if (energy_.valid())
    fields.turbulence = {&energy_(), &dissipation_()};
}

} // namespace eccentra
