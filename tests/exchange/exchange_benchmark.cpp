// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Seconds per exchange of 30,000 particles: finding cells, deposition and sampling, with and without diffusion.
#include "exchange/particleExchange.H"
#include "exchange/shared_mesh.h"
#include "link/start_mpi.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace eccentra;
using namespace eccentra::exchange;
using test::sharedMesh;

constexpr int kParticles = 30000;
constexpr double kHole = 0.0635, kPipe = 0.02413, kOffset = 0.019685, kLength = 0.1, kDiameter = 1e-3;

std::vector<std::array<double, 3>> scatter() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::array<double, 3>> position;
  while (position.size() < kParticles) {
    const double x = kHole * (2 * unit(random) - 1), y = kHole * (2 * unit(random) - 1);
    if (std::hypot(x, y) < kHole && std::hypot(x, y + kOffset) > kPipe)
      position.push_back({x, y, kLength * unit(random)});
  }
  return position;
}

/// What link solver adds to the work of both sides: particles reach the rank and cell where they are, seven doubles and
/// the cell hint come back.
void travel(benchmark::State& state) {
  std::vector<std::array<double, 3>> position = scatter(), zero(kParticles, {0, 0, 0});
  const std::vector<double> volume(kParticles, 1e-9), drag(kParticles, 1e-8);
  std::vector<double> samples(7 * std::size_t(kParticles));
  std::vector<link::CellHint> cellHints(kParticles);
  link::ParticleArrays particles;
  particles.count = kParticles;
  particles.position = reinterpret_cast<const double(*)[3]>(position.data());
  particles.volume = volume.data();
  particles.impulse = reinterpret_cast<const double(*)[3]>(zero.data());
  particles.drag_coefficient = drag.data();
  particles.cell_hint = cellHints.data();
  particlePoints present(*sharedMesh);
  for (auto _ : state) {
    for (auto& x : position)
      x[2] = std::fmod(x[2] + 3e-5, kLength);
    present.invite(particles, VoidFraction::centre, 0);
    present.answer(
        7, 0, [](const ParticlePoint& particlePoint, double* values) { std::fill_n(values, 7, particlePoint.volume); },
        [&](int row, const double* centre, const double*) { std::copy_n(centre, 7, &samples[7 * std::size_t(row)]); },
        cellHints.data());
  }
  state.SetItemsProcessed(state.iterations() * kParticles);
}

void exchangeOf(benchmark::State& state, VoidFraction method) {
  std::vector<std::array<double, 3>> position = scatter(), zero(kParticles, {0, 0, 0}), velocity(kParticles),
                                     pressure(kParticles);
  const std::vector<double> volume(kParticles, M_PI / 6 * std::pow(kDiameter, 3)), drag(kParticles, 1e-8);
  std::vector<link::CellHint> cellHints(kParticles);
  link::ParticleArrays particles;
  particles.count = kParticles;
  particles.position = reinterpret_cast<const double(*)[3]>(position.data());
  particles.volume = volume.data();
  particles.impulse = reinterpret_cast<const double(*)[3]>(zero.data());
  particles.drag_coefficient = drag.data();
  particles.cell_hint = cellHints.data();
  link::FluidSamples samples;
  samples[link::kVelocity] = reinterpret_cast<double*>(velocity.data());
  samples[link::kPressureGradient] = reinterpret_cast<double*>(pressure.data());
  Foam::volVectorField u(Foam::IOobject("u", sharedMesh->time().timeName(), *sharedMesh), *sharedMesh,
                         Foam::dimensionedVector("u", Foam::dimVelocity, Foam::vector(0, 0, 1)));
  FlowFields flow;
  flow.velocity = &u;
  flow.density[link::kPressureGradient] = &u.primitiveField();
  ExchangeSettings settings;
  settings.method = method;
  settings.length = 0.01;
  particleExchange exchange(*sharedMesh, settings);
  Foam::scalarField solid, dragField;
  Foam::vectorField force;
  for (auto _ : state) {
    // A shift of a thirtieth of a millimetre: what particles do between two coupling steps.
    for (auto& x : position)
      x[2] = std::fmod(x[2] + 3e-5, kLength);
    exchange.deposit(particles, 5e-3, solid, &force, &dragField);
    exchange.sample(flow, particles, samples);
  }
  state.SetItemsProcessed(state.iterations() * kParticles);
}

} // namespace

int main(int argc, char** argv) {
  eccentra::link::start_mpi(&argc, &argv);
  test::openSharedMesh(argv[0]);
  benchmark::Initialize(&argc, argv);
  benchmark::RegisterBenchmark("link solver", travel)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("exchange/centre", exchangeOf, VoidFraction::centre)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("exchange/diffusion", exchangeOf, VoidFraction::diffusion)
      ->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  MPI_Finalize();
  return 0;
}
