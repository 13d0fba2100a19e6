// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Deposit and sample, with the same weights.
#include "exchange/particleExchange.H"

#include "exchange/flowAtPoints.H"
#include "support/rankSums.H"

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

} // namespace

particleExchange::particleExchange(const fvMesh& mesh, const ExchangeSettings& settings)
    : mesh_(mesh), settings_(settings), particlePoints_(mesh), overflow_(mesh, settings.maxSolid),
      solidVolume_(mesh.nCells(), Zero) {
  for (const ForceDensity& density : kForceDensities)
    pending_[density.quantity] = pendingForce(mesh.nCells());
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
    touched_ = std::make_unique<touchedCells>(mesh);
  }
}

std::vector<scalarField*> particleExchange::memory() {
  std::vector<scalarField*> fields;
  for (const ForceDensity& density : kForceDensities)
    pending_[density.quantity].addMemory(fields);
  return fields;
}

void particleExchange::gather() {
  const std::vector<ParticlePoint>& here = particlePoints_.here();
  const auto amountsOf = [](const ParticlePoint& particlePoint) {
    Bundled<kWide> amounts{};
    amounts.at[kVolume] = particlePoint.volume;
    for (int k = 0; k < 3; ++k)
      amounts.at[kImpulse + k] = particlePoint.impulse[k];
    amounts.at[kDrag] = particlePoint.drag;
    return amounts;
  };
  wide_.cells.assign(mesh_.nCells(), Bundled<kWide>{});
  if (!sharing_) {
    for (const ParticlePoint& particlePoint : here)
      wide_.cells[particlePoint.at.cell].at += amountsOf(particlePoint).at;
    return;
  }
  sharing_->clear(wide_, *touched_, 1);
  for (std::size_t g = 0; g < here.size(); ++g)
    vertexSharing::put(shares_[g], amountsOf(here[g]), wide_);
  sharing_->collect(wide_, *touched_, 0);
}

void particleExchange::soften() {
  if (!sharing_)
    return;
  std::vector<Bundled<kWide>> unchanged;
  touched_->forCells(1, [&](label cell) { unchanged.push_back(wide_.cells[cell]); });
  sharing_->clear(wide_, *touched_, 2);
  std::size_t next = 0;
  touched_->forCells(1, [&](label cell) { wide_.aroundCells[cell] = unchanged[next++]; });
  sharing_->collect(wide_, *touched_, 1);
  touched_->forCells(2, [&](label cell) { wide_.cells[cell].at[kVolume] = wide_.aroundCells[cell].at[kVolume]; });
}

void particleExchange::locate(const link::ParticleArrays& particles) {
  particlePoints_.invite(particles, VoidFraction::centre, 0);
  std::array<double, 1> sums{double(particlePoints_.numberOutside())};
  sumOverRanks(sums);
  balance_.outside = std::llround(sums[0]);
}

void particleExchange::deposit(const link::ParticleArrays& particles, double elapsed, scalarField& solid,
                               vectorField* force, scalarField* drag) {
  particlePoints_.invite(particles, settings_.method, settings_.length);
  shares_.clear();
  if (sharing_) {
    for (const ParticlePoint& particlePoint : particlePoints_.here())
      shares_.push_back(sharing_->sharesOf(particlePoint.at.position, particlePoint.at.cell));
    touched_->mark([this](auto visit) {
      for (const PointShares& shares : shares_)
        visit(shares.cell);
    });
  }
  gather();
  soften();
  FieldBundle<kWide>& amounts = wide_.cells;
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
  std::array<double, 10> sums{scale,
                              volume,
                              sum(solidVolume_),
                              particleImpulse.x(),
                              particleImpulse.y(),
                              particleImpulse.z(),
                              meshImpulse.x(),
                              meshImpulse.y(),
                              meshImpulse.z(),
                              double(particlePoints_.numberOutside())};
  sumOverRanks(sums);
  balance_.outside = std::llround(sums[9]);
  balance_.impulseScale = sums[0];
  balance_.particleVolume = sums[1];
  balance_.meshVolume = sums[2];
  balance_.particleImpulse = threeOf(&sums[3]);
  balance_.meshImpulse = threeOf(&sums[6]);
}

template <int width> void particleExchange::makeReadable(const std::vector<const vectorField*>& fields) {
  SharedFields<width>& readable = shared<width>();
  if (sharing_)
    sharing_->clear(readable, *touched_, 1);
  readable.cells.assign(mesh_.nCells(), Bundled<width>{});
  for (std::size_t f = 0; f < fields.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      scalarField component(fields[f]->component(k));
      overflow_.sample(component);
      forAll(component, cell) readable.cells[cell].at[3 * f + k] = component[cell];
    }
  if (diffusion_)
    diffusion_->sample(readable.cells, 3 * static_cast<int>(fields.size()), *touched_, 1);
  if (sharing_)
    sharing_->makeReadable(readable, *touched_, 0);
}

unsigned particleExchange::offered() {
  unsigned all = flowAtPoints::offered();
  for (const ForceDensity& density : kForceDensities)
    all |= density.quantity;
  return all;
}

particleExchange::AppliedFields particleExchange::appliedFields(const FlowFields& flow,
                                                                const link::FluidSamples& samples) {
  AppliedFields applied;
  scalarField fluidSolid, solid;
  if (flow.share) {
    fluidSolid = 1.0 - flow.fraction->primitiveField();
    solid = solidVolume_ / mesh_.V();
  }
  for (const auto& [quantity, sign] : kForceDensities)
    if (samples[quantity]) {
      const vectorField& given = *flow.density[quantity];
      applied[quantity] = flow.share ? pending_[quantity].tell(given, fluidSolid, solid, *flow.share) : given;
    }
  return applied;
}

vectorField particleExchange::untold() const {
  vectorField all(mesh_.nCells(), Zero);
  for (const auto& [quantity, sign] : kForceDensities)
    all += sign * pending_[quantity].back();
  return all;
}

void particleExchange::sample(const FlowFields& flow, const link::ParticleArrays& particles,
                              const link::FluidSamples& samples) {
  const AppliedFields applied = appliedFields(flow, samples);
  std::vector<link::Quantity> densities;
  for (const ForceDensity& density : kForceDensities)
    if (samples[density.quantity])
      densities.push_back(density.quantity);
  if (3 * densities.size() > kNarrow)
    sampleAt<kWide>(flow, applied, densities, particles, samples);
  else
    sampleAt<kNarrow>(flow, applied, densities, particles, samples);
  balanceForces(applied, particles, samples);
}

template <int width>
void particleExchange::sampleAt(const FlowFields& flow, const AppliedFields& applied,
                                const std::vector<link::Quantity>& densities, const link::ParticleArrays& particles,
                                const link::FluidSamples& samples) {
  unsigned asked = 0;
  for (const link::FlowQuantity& quantity : link::kFlowQuantities)
    if (samples[quantity.bit])
      asked |= quantity.bit;
  const flowAtPoints centres(mesh_, flow, asked, settings_.fractionFloor, 1.0 - settings_.maxSolid, reading_.get(),
                             touched_.get());
  asked &= flowAtPoints::offered();
  std::vector<const vectorField*> fields;
  for (const link::Quantity quantity : densities)
    fields.push_back(&applied[quantity]);
  if (!fields.empty())
    makeReadable<width>(fields);
  const SharedFields<width>& readable = shared<width>();

  const int perCentre = centres.columns();
  const int perPoint = 3 * static_cast<int>(densities.size());
  const auto fill = [&](const ParticlePoint& particlePoint, double* at) {
    const PointShares* shares = sharing_ ? &shares_[&particlePoint - particlePoints_.here().data()] : nullptr;
    if (particlePoint.centre) {
      centres.read(particlePoint, shares, at);
      at += perCentre;
    }
    if (perPoint > 0) {
      Bundled<width> values;
      if (shares)
        vertexSharing::read(*shares, readable, values);
      else
        values = readable.cells[particlePoint.at.cell];
      for (int k = 0; k < perPoint; ++k)
        *at++ = particlePoint.weight * values.at[k];
    }
  };
  for (const link::Quantity quantity : densities)
    std::fill_n(samples[quantity], 3 * particles.count, 0.0);
  const auto add = [&](int row, const double* centre, const double* point) {
    if (centre)
      for (const link::FlowQuantity& quantity : link::kFlowQuantities)
        if (asked & quantity.bit) {
          std::copy_n(centre, quantity.columns, samples[quantity.bit] + quantity.columns * std::size_t(row));
          centre += quantity.columns;
        }
    for (const link::Quantity quantity : densities)
      for (int k = 0; k < 3; ++k)
        samples[quantity][3 * std::size_t(row) + k] += *point++;
  };
  particlePoints_.answer(perCentre, perPoint, fill, add, particles.cell_hint);
}

void particleExchange::balanceForces(const AppliedFields& applied, const link::ParticleArrays& particles,
                                     const link::FluidSamples& samples) {
  vector onMesh(Zero), onParticles(Zero), pending(Zero);
  double scale = 0;
  for (const auto& [quantity, sign] : kForceDensities) {
    const double* values = samples[quantity];
    if (!values)
      continue;
    onMesh += sum(vectorField(solidVolume_ * applied[quantity]));
    for (std::size_t i = 0; i < particles.count; ++i, values += 3) {
      const vector force(particles.volume[i] * vector(values[0], values[1], values[2]));
      onParticles += force;
      scale += mag(force);
      pending += sign * force;
    }
    for (int k = 0; k < 3; ++k)
      pending[k] += sign * sum(scalarField(pending_[quantity].rest(k) * mesh_.V()));
  }
  std::array<double, 10> sums{scale,           onMesh.x(),      onMesh.y(),  onMesh.z(),  onParticles.x(),
                              onParticles.y(), onParticles.z(), pending.x(), pending.y(), pending.z()};
  sumOverRanks(sums);
  balance_.pressureForceScale = sums[0];
  balance_.meshPressureForce = threeOf(&sums[1]);
  balance_.particlePressureForce = threeOf(&sums[4]);
  balance_.pendingForce = threeOf(&sums[7]);
}

} // namespace eccentra::exchange
