// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Courant-bounded time step.
#include "flow/timeStepControl.H"

#include "support/inputError.H"

#include <cmath>

namespace Foam {

namespace {
const scalar largestGrowth = 1.2;
// Two backward differences stay stable while a step is less than 2.4 times the one before it.
const scalar largestLeap = 2;
const scalar maxParts = 10000;
// An interval that holds a whole number of steps is not split once more for its last digit.
const scalar roundOff = 1e-9;
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

scalar timeStepControl::partOf(scalar left, scalar courant) {
  scalar parts = 1;
  if (active_) {
    const scalar present = runTime_.deltaTValue();
    const scalar wanted = courant > VSMALL ? present * maxCo_ / courant : GREAT;
    parts = max(scalar(1), std::ceil(left / min(wanted, min(largestLeap * present, maxDeltaT_)) * (1 - roundOff)));
  }
  if (parts > maxParts) {
    throw inputError(runTime_.controlDict(), "maxCo", maxCo_,
                     "this takes more than 10000 steps to the next coupling step: raise maxCo or maxDeltaT");
  }
  runTime_.setDeltaT(left / parts, false);
  return parts > 1 ? left - left / parts : 0;
}

} // namespace Foam
