// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Progress line and cost table of a flow run.
#include "flow/flowProgress.H"

#include "support/foam_compat.H"
#include "support/inputError.H"

#include "OSspecific.H"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

namespace Foam {

namespace {

const label usualReport = 20;

label readReport(const Time& runTime) {
  const IOdictionary properties(
      IOobject("flowProperties", runTime.constant(), runTime, IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false));
  const label every = properties.getOrDefault<label>("report", usualReport);
  if (every < 1) {
    throw inputError(properties, "report", every, "give a whole number of steps, at least 1");
  }
  return every;
}

} // namespace

flowProgress::flowProgress(const Time& runTime, averagedFlow& flow, bool verbose)
    : runTime_(runTime), flow_(flow), verbose_(verbose), hostLevel_(messageStream::level),
      interval_(runTime.controlDict().getOrDefault<scalar>("progressInterval", 2)), startTime_(runTime.value()),
      every_(readReport(runTime)) {
  openTable();
  const std::string head = regimeHead(flow);
  if (Pstream::master()) {
    std::printf("%s", head.c_str());
  }
}

flowProgress::~flowProgress() {
  messageStream::level = hostLevel_;
}

void flowProgress::openTable() {
  if (!Pstream::master()) {
    return;
  }
  const fileName folder(runTime_.globalPath() / "postProcessing" / "eccentra" / runTime_.timeName());
  mkDir(folder);
  table_ = folder / "flow.csv";
  std::ofstream(table_) << "time,mean_velocity,pressure_gradient,courant,continuity_error"
                        << flowMeasures::columns(flow_.mesh()) << '\n';
}

void flowProgress::row(const flowMeasures& measures) {
  rowAt_ = steps_;
  const scalar courant = flow_.CourantNo(), continuity = flow_.continuityError();
  const scalar velocity = flow_.superficialVelocity() & flowAxis(flow_);
  if (!Pstream::master()) {
    return;
  }
  std::ostringstream text;
  text.precision(13);
  text << runTime_.value() << ',' << velocity << ',' << measures.gradient << ',' << courant << ',' << continuity
       << measures.values() << '\n';
  std::ofstream file(table_, std::ios::app);
  file << text.str() << std::flush;
  if (!file && !tableFailed_) {
    std::cerr << "annulusFoam: warning: " << table_ << ": a row could not be written: free space on the disk"
              << std::endl;
  }
  tableFailed_ = !file;
}

void flowProgress::warn(const flowMeasures& measures) {
  const std::string convergence = flow_.convergence().news(runTime_.timeName());
  const std::string turbulence = warnedOfTurbulence_ ? "" : regimeWarning(flow_, measures.Reynolds);
  warnedOfTurbulence_ = warnedOfTurbulence_ || !turbulence.empty();
  if (Pstream::master()) {
    std::printf("%s%s", convergence.c_str(), turbulence.c_str());
    std::fflush(stdout);
  }
}

void flowProgress::silence() {
  if (!verbose_) {
    messageStream::level = 0;
  }
}

void flowProgress::report() {
  messageStream::level = hostLevel_;
  ++steps_;
  bool speaks = elapsed() - printed_ >= interval_;
  // One clock for all ranks: what follows is collective.
  eccentra::compat::broadcast(speaks);
  const bool writes = steps_ % every_ == 0;
  if (!speaks && !writes) {
    return;
  }
  const flowMeasures measures(flow_);
  if (writes) {
    row(measures);
  }
  warn(measures);
  if (speaks) {
    printed_ = elapsed();
    line(measures);
  }
}

void flowProgress::line(const flowMeasures& measures) const {
  const vector superficial = flow_.superficialVelocity();
  const scalar courant = flow_.CourantNo();
  if (!std::isfinite(mag(superficial))) {
    throw inputError("the flow has blown up at t = " + runTime_.timeName() +
                     " s: reduce deltaT, or maxCo with adjustTimeStep");
  }
  const scalar done = runTime_.value() - startTime_;
  const scalar left = done > 0 ? elapsed() * (runTime_.endTime().value() - runTime_.value()) / done : 0;
  if (Pstream::master()) {
    std::printf(
        "t %.4g of %.4g s  dt %.3g s  Co %.3g  <alpha U> %.6g m/s  G %.5g Pa/m  %s  %.3g ms/step  left %d:%02d\n",
        runTime_.value(), runTime_.endTime().value(), runTime_.deltaTValue(), courant, mag(superficial),
        measures.gradient, measures.text().c_str(), 1e3 * elapsed() / steps_, int(left) / 60, int(left) % 60);
    std::fflush(stdout);
  }
}

void flowProgress::summary() {
  if (steps_ > 0) {
    const flowMeasures measures(flow_);
    if (rowAt_ != steps_) {
      row(measures);
    }
    warn(measures);
    line(measures);
  }
  const averagedFlow::costs& cost = flow_.cost();
  const scalar continuity = flow_.continuityError();
  const std::string turbulence = turbulenceSummary(flow_);
  if (Pstream::master()) {
    std::printf("%d steps in %.3g s: rheology %.3g, momentum %.3g, pressure %.3g s; mass balance %.2g\n%s%s",
                int(steps_), elapsed(), cost.rheology, cost.momentum, cost.pressure, continuity, turbulence.c_str(),
                flow_.convergence().summary().c_str());
    std::fflush(stdout);
  }
}

} // namespace Foam
