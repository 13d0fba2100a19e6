// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A coupled run goes on from what it kept.
#include "coupled/coupledRun.H"

#include "coupled/fluidCheckpoint.H"
#include "flow/caseFiles.H"
#include "support/processGuards.H"

#include "Time.H"

namespace eccentra {

using namespace Foam;

link::CheckpointChoice coupledRun::newestCheckpoint() const {
  const auto fluidPart = [this](const link::Manifest& dem, std::string& why) {
    return fluidCheckpoint::whole(mesh_, dem.mark, why);
  };
  const link::CheckpointChoice choice = link::newest_checkpoint(fluidPart);
  for (const std::string& sentence : choice.passed_over)
    Info << sentence << endl;
  Info << (choice.mark.step < 0 ? "no complete checkpoint: the run begins at its beginning"
                                : "the run goes on from checkpoint " + std::to_string(choice.mark.step))
       << endl;
  return choice;
}

std::vector<scalarField*> coupledRun::cellValues() {
  std::vector<scalarField*> values = exchange_->memory();
  if (dem_.overlap)
    values.insert(values.end(), {&overlap_.after, &solid_});
  return values;
}

void coupledRun::resumeFrom(const link::CheckpointMark& mark) {
  std::string why;
  if (!fluidCheckpoint::whole(mesh_, mark, why))
    throw link::Refusal("the DEM side goes on from checkpoint " + std::to_string(mark.step) +
                        " but the fluid cannot: " + why + "; take another checkpoint for both, or begin anew");
  const dictionary facts = fluidCheckpoint::facts(mesh_, mark.step);
  if (facts.get<bool>("overlap") != dem_.overlap)
    throw link::Refusal("checkpoint " + std::to_string(mark.step) + " was written with overlap " +
                        (dem_.overlap ? "no" : "yes") + " and fix fluid/couple has the other: give it the same");
  // A folder of that time may have told another step, in fewer digits; only a step makes it the last one.
  time_.setDeltaT(facts.get<scalar>("lastStep"), false);
  ++time_;
  time_.setTime(facts.get<scalar>("time"), facts.get<label>("timeIndex"));
  time_.setDeltaT(facts.get<scalar>("lastStep"), false);
  exchange::ExchangeSettings settings;
  settings.length = facts.get<scalar>("length");
  settings.diffusionSteps = facts.get<label>("diffusionSteps");
  makeExchange(settings);
  fluidCheckpoint::readFields(*flow_, dem_.overlap, cellValues(), mark.step);
  flow_->resume(facts.get<scalar>("drive"));
  requests_.resume(unsigned(facts.get<label>("asked")));
  const dictionary report = facts.subDict("report");
  startFunctionObjects(time_);
  report_ = std::make_unique<couplingReport>(mesh_, dem_, reportEvery(), &report);
}

std::string coupledRun::checkpoint(const link::CheckpointMark& mark) {
  const trapping on(traps_);
  dictionary facts;
  facts.add("time", time_.value());
  facts.add("timeIndex", time_.timeIndex());
  facts.add("lastStep", time_.deltaTValue());
  facts.add("length", exchange_->settings().length);
  facts.add("diffusionSteps", label(exchange_->settings().diffusionSteps));
  facts.add("drive", flow_->drive().G());
  facts.add("asked", label(requests_.asked()));
  facts.add("overlap", dem_.overlap);
  facts.add("report", report_->state());
  return fluidCheckpoint::write(*flow_, dem_.overlap, cellValues(), mark, facts);
}

} // namespace eccentra
