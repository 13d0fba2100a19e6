// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Courant-bounded time step.
#include "timeStepControl.H"

#include "inputError.H"

namespace Foam {

namespace {
const scalar largestGrowth = 1.2;
} // namespace

timeStepControl::timeStepControl(Time& runTime)
    : runTime_(runTime), active_(runTime.controlDict().getOrDefault("adjustTimeStep", false)),
      maxCo_(runTime.controlDict().getOrDefault<scalar>("maxCo", 0.5)),
      maxDeltaT_(runTime.controlDict().getOrDefault<scalar>("maxDeltaT", GREAT)) {
  if (!(maxCo_ > 0)) {
    throw inputError(runTime.controlDict(), "maxCo", maxCo_, "give a Courant number above 0");
  }
  if (!(maxDeltaT_ > 0)) {
    throw inputError(runTime.controlDict(), "maxDeltaT", maxDeltaT_, "give a time step above 0 s");
  }
  if (!(runTime.deltaTValue() > 0)) {
    throw inputError(runTime.controlDict(), "deltaT", runTime.deltaTValue(), "give a time step above 0 s");
  }
}

void timeStepControl::adjust(scalar courant) {
  if (!active_) {
    return;
  }
  const scalar present = runTime_.deltaTValue();
  const scalar wanted = courant > VSMALL ? present * maxCo_ / courant : GREAT;
  runTime_.setDeltaT(min(min(wanted, largestGrowth * present), maxDeltaT_));
}

} // namespace Foam
