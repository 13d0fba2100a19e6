// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One coupling step of particles and fluid, on the fluid's side.
#include "coupled/coupledRun.H"

#include "coupled/appliedForces.H"
#include "coupled/presentFlow.H"
#include "flow/caseFiles.H"
#include "flow/feedbackShares.H"
#include "flow/flowMeasures.H"
#include "support/inputError.H"
#include "support/processGuards.H"
#include "support/stopwatch.H"

#include "Time.H"

#include <cmath>

namespace eccentra {

using namespace Foam;

namespace {

/// Defaults of lengths, in mean particle diameters.
constexpr double kDiffusionDiameters = 3.0;
constexpr double kGaussianDiameters = 1.0;
/// One implicit step leaves a cusp that a particle feels while it crosses cells.
constexpr label kDiffusionSteps = 2;
/// Share of the largest force below which inertia counts as none at the end of a run-in.
constexpr scalar kSteady = 0.1;

} // namespace

void coupledRun::makeExchange(const link::CouplingStep& couplingStep) {
  exchange::ExchangeSettings settings;
  const double diameter =
      couplingStep.totals.particles
          ? std::cbrt(6.0 / constant::mathematical::pi * couplingStep.totals.volume / couplingStep.totals.particles)
          : 0.0;
  const double diameters = method_ == exchange::VoidFraction::gaussian ? kGaussianDiameters : kDiffusionDiameters;
  settings.length = properties_.getOrDefault<scalar>("length", diameters * diameter);
  if (!(settings.length > 0) &&
      (method_ == exchange::VoidFraction::diffusion || method_ == exchange::VoidFraction::gaussian))
    throw inputError(properties_, "length", settings.length,
                     "give the length of spreading in metres (three particle diameters), as the scene starts empty");
  settings.diffusionSteps = properties_.getOrDefault<label>("diffusionSteps", kDiffusionSteps);
  makeExchange(settings);
}

void coupledRun::makeExchange(exchange::ExchangeSettings settings) {
  settings.method = method_;
  settings.maxSolid = properties_.getOrDefault<scalar>("mostSolid", settings.maxSolid);
  settings.fractionFloor = properties_.getOrDefault<scalar>("fractionFloor", settings.fractionFloor);
  settings.tolerance = properties_.getOrDefault<scalar>("tolerance", settings.tolerance);
  try {
    exchange_ = std::make_unique<exchange::particleExchange>(mesh_, settings);
    exchange_->allowDepths(depths_);
  } catch (const std::invalid_argument& problem) {
    throw inputError(properties_.name() + ": " + problem.what());
  }
}

// The fluid alone, with long steps, until it flows: the particles then start in a developed flow.
void coupledRun::runIn() {
  const dictionary* dict = properties_.findDict("runIn");
  if (!dict || time_.value() > SMALL)
    return;
  const label steps = dict->get<label>("steps");
  const scalar step = dict->get<scalar>("deltaT");
  if (steps < 0 || !(step > 0))
    throw inputError(*dict, "deltaT", step, "give a positive time step, and steps from 0 on");
  const scalar start = time_.value();
  const label index = time_.timeIndex();
  const scalar usual = time_.deltaTValue();
  time_.setDeltaT(step, false);
  // Before the start: OpenFOAM would take the times at which fields are due as passed, and boundary conditions that
  // change in time would be those of a later time.
  time_.setTime(start - (steps + 1) * step, index); // half a step beyond the last one counts as well
  const quiet silence(verbose_);
  for (label i = 0; i < steps; ++i) {
    ++time_;
    flow_->advance();
  }
  if (steps > 0)
    flow_->momentumResidual();
  const scalar unsteadiness = steps > 0 ? flow_->unsteadiness() : 0;
  time_.setDeltaT(usual, false);
  time_.setTime(start, index);
  messageStream::level = std::max(messageStream::level, 1);
  Info << "run-in of the fluid: " << steps << " steps of " << step << " s, dp/dz " << pressureGradientOf(*flow_)
       << " Pa/m" << endl;
  if (unsteadiness > kSteady)
    Info << "warning: the run-in did not reach a steady flow: in its last step the inertia of the fluid is "
         << 100 * unsteadiness << " % of the largest force; give runIn more steps or longer ones" << endl;
}

void coupledRun::checkFinite(const link::CouplingStep& couplingStep) const {
  const link::DemTotals& totals = couplingStep.totals;
  double sum = totals.fastest;
  for (int k = 0; k < 3; ++k)
    sum += totals.momentum[k] + totals.volume_position[k];
  const bool particles = std::isfinite(sum);
  if (particles && std::isfinite(mag(flow_->superficialVelocity())))
    return;
  throw link::Refusal("the coupled run has blown up at t = " + time_.timeName() + " s: the " +
                      (particles ? "fluid's velocity" : "particles' motion") +
                      " is no number; reduce deltaT and the DEM time step together, or every, and go on from the last "
                      "checkpoint with -resume");
}

void coupledRun::begin(const link::CouplingStep& couplingStep, const link::ParticleArrays& particles) {
  makeExchange(couplingStep);
  exchange_->locate(particles);
  checkInside(couplingStep);
  couplingReport::head(*flow_);
  runIn();
  startFunctionObjects(time_);
  report_ = std::make_unique<couplingReport>(mesh_, dem_, reportEvery());
}

void coupledRun::setStressShare() {
  flow_->setStressShare(requests_.asked() & link::kStressDivergence ? averagedFlow::stressShare::fraction
                                                                    : averagedFlow::stressShare::full);
}

// The screen of fix fluid/force may drop quantities, and ask for them again.
void coupledRun::follow(const link::CouplingStep& couplingStep) {
  // Over the time that has passed, particles received V div tau if they were told it at its beginning.
  setStressShare();
  if (requests_.changes(couplingStep))
    fluidRequests::print(couplingStep, dem_.extents, time_.value(), returnReduce(mesh_.nCells(), sumOp<label>()),
                         exchange_->settings().length);
  requests_.add(couplingStep, dem_.extents);
}

// Returns the fluid fraction that this interval leads to, and which part of the forces pending the particles are told.
scalarField coupledRun::receive(const link::CouplingStep& couplingStep, const link::ParticleArrays& particles,
                                bool start, scalarField& forceShare) {
  scalarField drag;
  vectorField force;
  scalarField& solid = solid_;
  scalarField* const wantedDrag = semiImplicit_ ? &drag : nullptr;
  exchange_->deposit(particles, couplingStep.elapsed, solid, &force, wantedDrag);
  flow_->particleForce().primitiveFieldRef() = force / flow_->rho();
  flow_->particleForce().correctBoundaryConditions();
  if (semiImplicit_) {
    flow_->exchange().primitiveFieldRef() = drag / flow_->rho();
    flow_->exchange().correctBoundaryConditions();
  }
  const scalar density =
      couplingStep.totals.volume > 0 ? couplingStep.totals.mass / couplingStep.totals.volume : flow_->rho();
  const feedbackLoads loads(solid, wantedDrag, density, flow_->rho(), couplingStep.elapsed);
  forceShare = loads.force();
  const scalar share = start ? 1.0 : loads.fraction();
  const scalarField& before = flow_->alpha().primitiveField();
  return share < 1 ? scalarField(before + share * (1.0 - solid - before)) : scalarField(1.0 - solid);
}

void coupledRun::setFraction(const scalarField& before, const scalarField& after, scalar part) {
  flow_->alpha().primitiveFieldRef() = part < 1 ? scalarField(before + part * (after - before)) : after;
  flow_->alpha().correctBoundaryConditions();
}

// From the last coupling step to this one; `left` after the first step [s]. Returns whether fields are due to be
// written.
bool coupledRun::takeSteps(scalar left, const scalarField& before, const scalarField& after, appliedForces& applied) {
  for (bool due = false;;) {
    try {
      const quiet silence(verbose_);
      flow_->advance();
    } catch (const solidVolumeError& problem) {
      throw link::Refusal(std::string(link::kVolumeChanged) + problem.what());
    }
    executeFunctionObjects();
    due = due || time_.writeTime();
    if (!(left > 0))
      return due;
    applied.add(flow_->alpha(), time_.deltaTValue() / interval_);
    left = timeStep_.partOf(left, flow_->CourantNo());
    ++time_;
    setFraction(before, after, 1 - left / interval_);
  }
}

void coupledRun::executeFunctionObjects() {
  time_.functionObjects().execute();
}

link::StepAnswer coupledRun::couple(const link::CouplingStep& couplingStep, const link::ParticleArrays& particles,
                                    const link::FluidSamples& samples) {
  checkFinite(couplingStep);
  const trapping on(traps_);
  if (dem_.overlap)
    exchangeAhead(couplingStep, particles, samples);
  else
    exchangeInTurn(couplingStep, particles, samples);
  if (outsideAtStart_ < 0)
    checkInside(couplingStep);
  else
    followOutside();
  return answer();
}

void coupledRun::exchangeInTurn(const link::CouplingStep& couplingStep, const link::ParticleArrays& particles,
                                const link::FluidSamples& samples) {
  const bool first = !exchange_;
  if (first)
    begin(couplingStep, particles);
  follow(couplingStep);
  stopwatch watch;
  CostByPart cost(couplingStep);
  const bool advances = couplingStep.elapsed > 0;
  const scalar left = advances ? timeStep_.partOf(interval_, flow_->CourantNo()) : 0;
  if (advances)
    ++time_;

  const scalarField before(flow_->alpha().primitiveField());
  const bool start = first && time_.value() <= SMALL;
  scalarField forceShare;
  const scalarField after(receive(couplingStep, particles, start, forceShare));
  setFraction(before, after, 1 - left / interval_);
  if (start)
    flow_->resetFractionHistory();
  cost.exchange = watch.lap();

  appliedForces applied(*flow_, requests_.asked());
  const bool due = advances && takeSteps(left, before, after, applied);
  cost.fluid = watch.lap();
  checkFinite(couplingStep);

  exchange::FlowFields fields;
  const presentFlow present(*flow_, requests_.asked());
  present.give(fields);
  applied.complete(flow_->alpha(), time_.deltaTValue() / interval_, fields);
  fields.share = &forceShare;
  exchange_->sample(fields, particles, samples);
  if (advances)
    flow_->takeBack(exchange_->untold() * (interval_ / (time_.deltaTValue() * flow_->rho())));
  cost.exchange += watch.lap();
  report_->add(*flow_, *exchange_, couplingStep, particles, cost, Zero);
  if (due)
    writer_.writeNow();
}

void coupledRun::run_ended() {
  if (!report_)
    return;
  report_->finish(*flow_);
  requests_.printSums();
}

} // namespace eccentra
