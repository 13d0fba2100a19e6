// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Deposit and sample, with the same weights.
#include "exchange/particleExchange.H"

#include "support/rankSums.H"

#include "fvcGrad.H"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace eccentra::exchange {

using namespace Foam;

namespace {

std::invalid_argument wrong(const char* keyword, double value, const char* remedy) {
  return std::invalid_argument(std::string(keyword) + " is " + std::to_string(value) + ": " + remedy);
}

std::array<double, 3> threeOf(const double* values) {
  return {values[0], values[1], values[2]};
}

/// No bed of grains at rest is looser: below it maxSolid would move grains that lie where they are.
constexpr double kLoosest = 0.4;

/// Lanes of what particles bring.
constexpr int kVolume = 0, kImpulse = 1, kDrag = 4, kBrought = 5;

/// Value at a point: that of its cell, with the gradient there.
template <class Value, class Gradient>
Value linear(const Value& value, const Gradient& gradient, const vector& fromCentre) {
  return value + (fromCentre & gradient);
}

} // namespace

particleExchange::particleExchange(const fvMesh& mesh, const ExchangeSettings& settings)
    : mesh_(mesh), settings_(settings), particlePoints_(mesh), overflow_(mesh, settings.maxSolid),
      solidVolume_(mesh.nCells(), Zero), pressurePending_(mesh.nCells()), stressPending_(mesh.nCells()) {
  if (!(settings.maxSolid >= kLoosest && settings.maxSolid < 1))
    throw wrong(
        "mostSolid", settings.maxSolid,
        "give a fraction from 0.4 on and below 1, such as 0.74; grains at rest fill more than 0.4 of a cell, and what "
        "exceeds mostSolid is moved to other cells");
  if (!(settings.fractionFloor >= 0 && settings.fractionFloor < 1))
    throw wrong("fractionFloor", settings.fractionFloor, "give a fraction from 0 to below 1, such as 0.3");
  const bool spreads = settings.method == VoidFraction::diffusion || settings.method == VoidFraction::gaussian;
  if (spreads && !(settings.length > 0))
    throw wrong("length", settings.length, "give a positive length in metres, such as three particle diameters");
  if (settings.diffusionSteps < 1)
    throw wrong("diffusionSteps", settings.diffusionSteps, "give a whole number from 1 on");
  if (!(settings.tolerance > 0 && settings.tolerance < 1))
    throw wrong("tolerance", settings.tolerance, "give a number between 0 and 1, such as 1e-9");
  if (settings.method == VoidFraction::diffusion) {
    diffusion_ =
        std::make_unique<conservativeDiffusion>(mesh, settings.length, settings.diffusionSteps, settings.tolerance);
    sharing_ = std::make_unique<vertexSharing>(mesh);
    reading_ = std::make_unique<flowReading>(mesh, *sharing_);
  }
}

std::vector<scalarField*> particleExchange::memory() {
  std::vector<scalarField*> fields;
  pressurePending_.addMemory(fields);
  stressPending_.addMemory(fields);
  return fields;
}

FieldBundle<kWide> particleExchange::gather() const {
  const std::vector<ParticlePoint>& here = particlePoints_.here();
  const auto amountsOf = [](const ParticlePoint& particlePoint) {
    Bundled<kWide> amounts{};
    amounts.at[kVolume] = particlePoint.volume;
    for (int k = 0; k < 3; ++k)
      amounts.at[kImpulse + k] = particlePoint.impulse[k];
    amounts.at[kDrag] = particlePoint.drag;
    return amounts;
  };
  if (!sharing_) {
    FieldBundle<kWide> cells(mesh_.nCells(), Bundled<kWide>{});
    for (const ParticlePoint& particlePoint : here)
      cells[particlePoint.at.cell].at += amountsOf(particlePoint).at;
    return cells;
  }
  SharedFields<kWide> shared = sharing_->empty<kWide>();
  for (std::size_t g = 0; g < here.size(); ++g)
    vertexSharing::put(shares_[g], amountsOf(here[g]), shared);
  sharing_->collect(shared);
  return std::move(shared.cells);
}

void particleExchange::soften(FieldBundle<kWide>& amounts) const {
  if (!sharing_)
    return;
  SharedFields<kWide> shared = sharing_->empty<kWide>();
  shared.aroundCells = amounts;
  sharing_->collect(shared);
  for (std::size_t cell = 0; cell < amounts.size(); ++cell) {
    const double volume = amounts[cell].at[kVolume];
    amounts[cell] = shared.cells[cell];
    amounts[cell].at[kVolume] = volume;
  }
}

void particleExchange::deposit(const link::ParticleArrays& particles, double elapsed, scalarField& solid,
                               vectorField* force, scalarField* drag) {
  particlePoints_.invite(particles, settings_.method, settings_.length);
  shares_.clear();
  if (sharing_)
    for (const ParticlePoint& particlePoint : particlePoints_.here())
      shares_.push_back(sharing_->sharesOf(particlePoint.at.position, particlePoint.at.cell));
  FieldBundle<kWide> amounts = gather();
  soften(amounts);
  if (diffusion_)
    diffusion_->spread(amounts, kBrought);
  const auto component = [&](int lane) {
    scalarField values(mesh_.nCells());
    forAll(values, cell) values[cell] = amounts[cell].at[lane];
    return values;
  };
  solidVolume_ = component(kVolume);
  balance_.fits = overflow_.settle(solidVolume_);
  solid = solidVolume_ / mesh_.V();

  const double rate = elapsed > 0 ? 1.0 / elapsed : 0.0;
  vector meshImpulse(Zero);
  if (force)
    force->setSize(mesh_.nCells());
  for (int k = 0; k < 3 && force; ++k) {
    scalarField impulse(component(kImpulse + k));
    overflow_.spread(impulse);
    meshImpulse[k] = sum(impulse);
    force->replace(k, -rate * impulse / mesh_.V());
  }
  if (drag) {
    scalarField dragAmount(component(kDrag));
    overflow_.spread(dragAmount);
    // The tolerance of the diffusion may leave a drag coefficient of -1e-20 where no particle is.
    *drag = rate * max(dragAmount, 0.0) / mesh_.V();
  }

  double volume = 0, scale = 0;
  vector particleImpulse(Zero);
  for (std::size_t i = 0; i < particles.count; ++i) {
    volume += particles.volume[i];
    const vector own(particles.impulse[i][0], particles.impulse[i][1], particles.impulse[i][2]);
    particleImpulse += own;
    scale += mag(own);
  }
  std::array<double, 9> sums{scale,
                             volume,
                             sum(solidVolume_),
                             particleImpulse.x(),
                             particleImpulse.y(),
                             particleImpulse.z(),
                             meshImpulse.x(),
                             meshImpulse.y(),
                             meshImpulse.z()};
  sumOverRanks(sums);
  balance_.impulseScale = sums[0];
  balance_.particleVolume = sums[1];
  balance_.meshVolume = sums[2];
  balance_.particleImpulse = threeOf(&sums[3]);
  balance_.meshImpulse = threeOf(&sums[6]);
}

template <int width>
SharedFields<width> particleExchange::readable(const std::vector<const vectorField*>& fields) const {
  SharedFields<width> shared;
  if (sharing_)
    shared = sharing_->empty<width>();
  shared.cells.assign(mesh_.nCells(), Bundled<width>{});
  for (std::size_t f = 0; f < fields.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      scalarField component(fields[f]->component(k));
      overflow_.sample(component);
      forAll(component, cell) shared.cells[cell].at[3 * f + k] = component[cell];
    }
  if (diffusion_)
    diffusion_->sample(shared.cells, 3 * static_cast<int>(fields.size()));
  if (sharing_)
    sharing_->makeReadable(shared);
  return shared;
}

particleExchange::AppliedFields particleExchange::appliedFields(const FlowFields& flow,
                                                                const link::FluidSamples& samples) {
  AppliedFields applied;
  scalarField fluidSolid, solid;
  if (flow.share) {
    fluidSolid = 1.0 - flow.fraction->primitiveField();
    solid = solidVolume_ / mesh_.V();
  }
  const auto tell = [&](const vectorField& given, pendingForce& deferred) {
    return flow.share ? deferred.tell(given, fluidSolid, solid, *flow.share) : given;
  };
  if (samples.pressure_gradient)
    applied.pressureGradient = tell(*flow.pressureGradient, pressurePending_);
  if (samples.stress_divergence)
    applied.stressDivergence = tell(*flow.stressDivergence, stressPending_);
  return applied;
}

vectorField particleExchange::untold() const {
  return stressPending_.back() - pressurePending_.back();
}

/// Of the fluid at a particle point.
struct PointFlow {
  vector velocity = Zero;
  scalar fraction = 1;
};

struct particleExchange::FlowAtParticlePoints {
  const fvMesh& mesh;
  const scalar minFraction; ///< that a velocity may be divided by
  const volScalarField* fraction;
  tmp<volVectorField> flux; ///< alpha U per area; U where the fraction is not known
  tmp<volTensorField> gradU, gradFlux;
  tmp<volVectorField> gradFraction;
  SharedFields<kNarrow> readable; ///< flux and fraction

  PointFlow at(const ParticlePoint& particlePoint, const PointShares* shares) const {
    const label cell = particlePoint.at.cell;
    const point x(particlePoint.at.position[0], particlePoint.at.position[1], particlePoint.at.position[2]);
    const vector fromCentre(particlePoint.outside ? vector(Zero) : x - mesh.cellCentres()[cell]);
    Bundled<kNarrow> read{};
    if (shares && !readable.cells.empty())
      vertexSharing::read(*shares, readable, read);
    PointFlow here;
    if (fraction)
      here.fraction =
          shares ? read.at[flowReading::kScalar] : linear((*fraction)[cell], gradFraction()[cell], fromCentre);
    if (flux.valid()) {
      here.velocity =
          shares ? vector(read.at[0], read.at[1], read.at[2]) : linear(flux()[cell], gradFlux()[cell], fromCentre);
      if (fraction)
        here.velocity /= std::max(here.fraction, minFraction);
    }
    return here;
  }
};

particleExchange::FlowAtParticlePoints particleExchange::flowAtParticlePoints(const FlowFields& flow,
                                                                              const link::FluidSamples& samples) const {
  FlowAtParticlePoints at{mesh_, 1.0 - settings_.maxSolid, flow.fraction, {}, {}, {}, {}, {}};
  if (samples.vorticity)
    at.gradU = fvc::grad(*flow.velocity);
  if (samples.velocity) {
    at.flux = flow.fraction ? *flow.fraction * *flow.velocity : tmp<volVectorField>(*flow.velocity);
    at.gradFlux = fvc::grad(at.flux());
  }
  if (flow.fraction && (samples.fraction || samples.velocity))
    at.gradFraction = fvc::grad(*flow.fraction);
  else
    at.fraction = nullptr;
  if (reading_ && (at.flux.valid() || at.fraction))
    at.readable =
        reading_->readable(at.flux.valid() ? &at.flux() : nullptr, at.gradFlux.valid() ? &at.gradFlux() : nullptr,
                           at.fraction, at.gradFraction.valid() ? &at.gradFraction() : nullptr);
  return at;
}

void particleExchange::sample(const FlowFields& flow, const link::ParticleArrays& particles,
                              const link::FluidSamples& samples) {
  const AppliedFields applied = appliedFields(flow, samples);
  if (samples.pressure_gradient && samples.stress_divergence)
    sampleAt<kWide>(flow, applied, particles, samples);
  else
    sampleAt<kNarrow>(flow, applied, particles, samples);
  balanceForces(applied, particles, samples);
}

template <int width>
void particleExchange::sampleAt(const FlowFields& flow, const AppliedFields& applied,
                                const link::ParticleArrays& particles, const link::FluidSamples& samples) {
  const FlowAtParticlePoints atParticlePoints(flowAtParticlePoints(flow, samples));
  std::vector<const vectorField*> forces;
  if (samples.pressure_gradient)
    forces.push_back(&applied.pressureGradient);
  if (samples.stress_divergence)
    forces.push_back(&applied.stressDivergence);
  SharedFields<width> shared;
  if (!forces.empty())
    shared = readable<width>(forces);

  const int perCentre = (samples.velocity ? 3 : 0) + (samples.fraction ? 1 : 0) + (samples.vorticity ? 3 : 0);
  const int perPoint = 3 * static_cast<int>(forces.size());
  const auto put = [](double*& at, const vector& v) {
    for (int k = 0; k < 3; ++k)
      *at++ = v[k];
  };
  const auto fill = [&](const ParticlePoint& particlePoint, double* at) {
    const PointShares* shares = sharing_ ? &shares_[&particlePoint - particlePoints_.here().data()] : nullptr;
    if (particlePoint.centre) {
      const PointFlow here(atParticlePoints.at(particlePoint, shares));
      if (samples.velocity)
        put(at, here.velocity);
      if (samples.fraction)
        *at++ = std::clamp(here.fraction, settings_.fractionFloor, 1.0);
      if (samples.vorticity)
        put(at, 2.0 * (*skew(atParticlePoints.gradU()[particlePoint.at.cell])));
    }
    if (perPoint > 0) {
      Bundled<width> values;
      if (shares)
        vertexSharing::read(*shares, shared, values);
      else
        values = shared.cells[particlePoint.at.cell];
      for (int k = 0; k < perPoint; ++k)
        *at++ = particlePoint.weight * values.at[k];
    }
  };
  for (std::size_t i = 0; i < particles.count; ++i)
    for (int k = 0; k < 3; ++k) {
      if (samples.pressure_gradient)
        samples.pressure_gradient[i][k] = 0;
      if (samples.stress_divergence)
        samples.stress_divergence[i][k] = 0;
    }
  const auto add = [&](int row, const double* centre, const double* point) {
    if (centre) {
      if (samples.velocity)
        for (int k = 0; k < 3; ++k)
          samples.velocity[row][k] = *centre++;
      if (samples.fraction)
        samples.fraction[row] = *centre++;
      if (samples.vorticity)
        for (int k = 0; k < 3; ++k)
          samples.vorticity[row][k] = *centre++;
    }
    if (samples.pressure_gradient)
      for (int k = 0; k < 3; ++k)
        samples.pressure_gradient[row][k] += *point++;
    if (samples.stress_divergence)
      for (int k = 0; k < 3; ++k)
        samples.stress_divergence[row][k] += *point++;
  };
  particlePoints_.answer(perCentre, perPoint, fill, add, particles.cell_hint);
}

void particleExchange::balanceForces(const AppliedFields& applied, const link::ParticleArrays& particles,
                                     const link::FluidSamples& samples) {
  vector onMesh(Zero), onParticles(Zero), pending(Zero);
  double scale = 0;
  const auto add = [&](const vectorField& field, const double(*values)[3], const pendingForce& deferred, double sign) {
    onMesh += sum(vectorField(solidVolume_ * field));
    for (std::size_t i = 0; i < particles.count; ++i) {
      const vector force(particles.volume[i] * vector(values[i][0], values[i][1], values[i][2]));
      onParticles += force;
      scale += mag(force);
      pending += sign * force;
    }
    for (int k = 0; k < 3; ++k)
      pending[k] += sign * sum(scalarField(deferred.rest(k) * mesh_.V()));
  };
  if (samples.pressure_gradient)
    add(applied.pressureGradient, samples.pressure_gradient, pressurePending_, -1);
  if (samples.stress_divergence)
    add(applied.stressDivergence, samples.stress_divergence, stressPending_, 1);
  std::array<double, 10> sums{scale,           onMesh.x(),      onMesh.y(),  onMesh.z(),  onParticles.x(),
                              onParticles.y(), onParticles.z(), pending.x(), pending.y(), pending.z()};
  sumOverRanks(sums);
  balance_.pressureForceScale = sums[0];
  balance_.meshPressureForce = threeOf(&sums[1]);
  balance_.particlePressureForce = threeOf(&sums[4]);
  balance_.pendingForce = threeOf(&sums[7]);
}

} // namespace eccentra::exchange
