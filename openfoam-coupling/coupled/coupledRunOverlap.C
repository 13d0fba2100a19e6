// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Both sides at the same time: from one coupling step to the next the flow takes its step with the particles and
// impulses of the first one, while DEM runs the same interval with the samples of the first one.
#include "coupled/coupledRun.H"

#include "coupled/appliedForces.H"
#include "coupled/presentFlow.H"
#include "support/processGuards.H"
#include "support/stopwatch.H"

#include "Time.H"

#include <algorithm>

namespace eccentra {

using namespace Foam;

void coupledRun::advance() {
  if (!dem_.overlap || overlap_.ahead || !exchange_)
    throw link::Refusal("the DEM side spoke out of turn: install the same release of Eccentra on both sides");
  const trapping on(traps_);
  overlap_.ahead = true;
  stopwatch watch;
  setStressShare();
  const scalarField before(flow_->alpha().primitiveField());
  const scalar left = timeStep_.partOf(interval_, flow_->CourantNo());
  ++time_;
  setFraction(before, overlap_.after, 1 - left / interval_);
  overlap_.applied = std::make_unique<appliedForces>(*flow_, requests_.asked());
  const bool due = takeSteps(left, before, overlap_.after, *overlap_.applied);
  overlap_.fields = {};
  overlap_.applied->complete(flow_->alpha(), time_.deltaTValue() / interval_, overlap_.fields);
  overlap_.cost = watch.lap();
  if (report_ ? report_->due() : true)
    flow_->momentumResidual();
  if (due)
    writer_.writeNow();
}

// The flow received alpha f of a shared force density f, and the particles were to get (1 - alpha) f with the fraction
// that the flow knew; where they are now they get another part of it. The difference goes into the next step.
void coupledRun::returnDifference(const scalarField& assumedSolid, const exchange::FlowFields& fields) {
  if (assumedSolid.empty())
    return;
  const scalarField more((solid_ - assumedSolid) / flow_->rho());
  vectorField& force = flow_->particleForce().primitiveFieldRef();
  for (const auto& [quantity, sign] : exchange::kForceDensities)
    if (const vectorField* density = fields.density[quantity])
      force -= sign * more * *density;
  flow_->particleForce().correctBoundaryConditions();
}

void coupledRun::exchangeAhead(const link::CouplingStep& couplingStep, const link::ParticleArrays& particles,
                               const link::FluidSamples& samples) {
  if (overlap_.ahead != (couplingStep.elapsed > 0))
    throw link::Refusal("the DEM side spoke out of turn: install the same release of Eccentra on both sides");
  overlap_.ahead = false;
  const bool first = !exchange_;
  if (first)
    begin(couplingStep, particles);
  const bool news = requests_.changes(couplingStep);
  follow(couplingStep);
  stopwatch watch;
  CostByPart cost(couplingStep);
  cost.fluid = overlap_.cost;
  cost.together = std::max(cost.dem.wall, cost.fluid.wall);

  exchange::FlowFields fields = overlap_.fields;
  // Quantities that nobody asked for while the flow advanced are those of its end.
  std::unique_ptr<appliedForces> present;
  if (news || !overlap_.applied) {
    present = std::make_unique<appliedForces>(*flow_, couplingStep.needed);
    present->complete(flow_->alpha(), 1, fields);
  }
  for (const auto& [quantity, sign] : exchange::kForceDensities)
    if (!samples[quantity])
      fields.density[quantity] = nullptr;
  const presentFlow read(*flow_, couplingStep.needed);
  read.give(fields);
  const scalarField assumedSolid(solid_);
  const bool start = first && time_.value() <= SMALL;
  // What the flow gives reaches the particles an interval later still: it is told as it is
  // (docs/couplingProperties.md).
  scalarField unused;
  overlap_.after = receive(couplingStep, particles, start, unused);
  if (start) {
    setFraction(overlap_.after, overlap_.after, 1);
    flow_->resetFractionHistory();
  }
  exchange_->sample(fields, particles, samples);
  if (couplingStep.elapsed > 0)
    returnDifference(assumedSolid, fields);
  cost.exchange = watch.lap();
  const vector onItsWay(interval_ * flow_->rho() *
                        gSum(vectorField(mesh_.V() * flow_->particleForce().primitiveField())));
  report_->add(*flow_, *exchange_, couplingStep, particles, cost, onItsWay);
}

} // namespace eccentra
