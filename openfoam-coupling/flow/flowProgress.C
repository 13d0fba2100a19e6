// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Progress line and cost table of a flow run.
#include "flow/flowProgress.H"

#include "support/inputError.H"

#include <cmath>
#include <cstdio>

namespace Foam {

flowProgress::flowProgress(const Time& runTime, const averagedFlow& flow, bool verbose)
    : runTime_(runTime), flow_(flow), verbose_(verbose), hostLevel_(messageStream::level),
      interval_(runTime.controlDict().getOrDefault<scalar>("progressInterval", 2)), startTime_(runTime.value()) {}

flowProgress::~flowProgress() {
  messageStream::level = hostLevel_;
}

void flowProgress::silence() {
  if (!verbose_) {
    messageStream::level = 0;
  }
}

void flowProgress::report() {
  messageStream::level = hostLevel_;
  ++steps_;
  if (elapsed() - printed_ < interval_) {
    return;
  }
  printed_ = elapsed();
  line();
}

void flowProgress::line() const {
  const vector superficial = flow_.superficialVelocity();
  const scalar courant = flow_.CourantNo();
  if (!std::isfinite(mag(superficial))) {
    throw inputError("the flow has blown up at t = " + runTime_.timeName() +
                     " s: reduce deltaT, or maxCo with adjustTimeStep");
  }
  const scalar done = runTime_.value() - startTime_;
  const scalar left = done > 0 ? elapsed() * (runTime_.endTime().value() - runTime_.value()) / done : 0;
  if (Pstream::master()) {
    std::printf("t %.4g of %.4g s  dt %.3g s  Co %.3g  <alpha U> %.6g m/s  G %.5g Pa/m  %.3g ms/step  left %d:%02d\n",
                runTime_.value(), runTime_.endTime().value(), runTime_.deltaTValue(), courant, mag(superficial),
                flow_.drivingPressureGradient(), 1e3 * elapsed() / steps_, int(left) / 60, int(left) % 60);
    std::fflush(stdout);
  }
}

void flowProgress::summary() const {
  if (steps_ > 0) {
    line();
  }
  const averagedFlow::costs& cost = flow_.cost();
  if (Pstream::master()) {
    std::printf("%d steps in %.3g s: rheology %.3g, momentum %.3g, pressure %.3g s; mass balance %.2g\n", int(steps_),
                elapsed(), cost.rheology, cost.momentum, cost.pressure, flow_.continuityError());
    std::fflush(stdout);
  } else {
    flow_.continuityError();
  }
}

} // namespace Foam
