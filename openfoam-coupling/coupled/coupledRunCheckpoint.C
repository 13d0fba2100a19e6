// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A coupled run goes on from what it kept.
#include "coupled/coupledRun.H"

#include "coupled/fluidCheckpoint.H"
#include "flow/caseFiles.H"
#include "support/processGuards.H"

#include "link/checkpoint/checkpoint_room.h"

#include "OSspecific.H"
#include "Time.H"

#include <sstream>

namespace eccentra {

using namespace Foam;

namespace {

/// Of two numbers that a script and a dictionary state.
constexpr double kSameNumber = 1e-9;

} // namespace

link::CheckpointChoice coupledRun::newestCheckpoint() const {
  const auto fluidPart = [this](const link::Manifest& dem, std::string& why) {
    return fluidCheckpoint::whole(mesh_, dem.mark, why);
  };
  const link::CheckpointChoice choice = link::newest_checkpoint(fluidPart);
  for (const std::string& sentence : choice.passed_over)
    Info << sentence.c_str() << endl;
  if (choice.none_is_whole())
    throw link::Refusal(std::string("none of the checkpoints in '") + link::kCheckpoints +
                        "' is complete: remove or rename that folder to begin anew");
  if (choice.mark.step < 0)
    Info << "no complete checkpoint: the run begins at its beginning" << endl;
  else
    Info << "the run goes on from checkpoint " << label(choice.mark.step) << endl;
  keepLog(choice.mark.step >= 0);
  return choice;
}

std::vector<scalarField*> coupledRun::cellValues() {
  std::vector<scalarField*> values = exchange_->memory();
  if (dem_.overlap)
    values.insert(values.end(), {&overlap_.after, &solid_});
  return values;
}

// The same instant has the same meaning on the same mesh and clock only.
void coupledRun::checkOrigin(const dictionary& facts, const link::CheckpointMark& mark) const {
  const std::string name = "checkpoint " + std::to_string(mark.step);
  if (!fluidCheckpoint::sameMesh(facts.get<scalarList>("mesh"), fluidCheckpoint::fingerprint(mesh_)))
    throw link::Refusal("constant/polyMesh is not the mesh of " + name +
                        ": make that mesh again to go on from it, or begin anew in another folder");
  const auto same = [&](const char* what, double now, const char* remedy) {
    const double then = facts.get<scalar>(what);
    if (mag(now - then) <= kSameNumber * mag(then))
      return;
    std::ostringstream text;
    text.precision(12);
    text << what << " is " << now << " but " << name << " was written with " << then << ": " << remedy;
    throw link::Refusal(text.str());
  };
  same("deltaT", interval_, "give system/controlDict the same, or begin anew in another folder");
  same("every", double(dem_.interval), "give fix fluid/couple the same, or begin anew in another folder");
  same("timestep", dem_.time_step, "give the DEM script the same, or begin anew in another folder");
}

// LIGGGHTS empties its log when it starts: the interrupted run's stays, under another name.
void coupledRun::keepLog(bool goesOn) const {
  const fileName log(properties_.getOrDefault<fileName>("demLog", "log.liggghts"));
  if (goesOn && Pstream::master() && isFile(log, false))
    link::keep_beside(log);
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
  checkOrigin(facts, mark);
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
  couplingReport::head(*flow_);
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
  facts.add("mesh", fluidCheckpoint::fingerprint(mesh_));
  facts.add("deltaT", interval_);
  facts.add("every", scalar(dem_.interval));
  facts.add("timestep", dem_.time_step);
  facts.add("report", report_->state());
  return fluidCheckpoint::write(*flow_, dem_.overlap, cellValues(), mark, facts);
}

} // namespace eccentra
