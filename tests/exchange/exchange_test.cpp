// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Particles on a real annulus mesh, whole and cut in two: volume, momentum, adjointness, place and order of sampling.
// The particles of a scene are dealt out to the ranks in turn, so that nearly half of them lie on another rank than
// their cell.
#include "exchange/shared_mesh.h"

#include "exchange/particleExchange.H"

#include "fvCFD.H"
#include "uncorrectedSnGrad.H"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace {

using namespace eccentra;
using namespace eccentra::exchange;
using eccentra::test::sharedMesh;

constexpr double kDiameter = 6.35e-3;
constexpr double kLength = 0.1;
constexpr double kHole = 0.0635, kPipe = 0.02413, kOffset = 0.019685;
constexpr double kElapsed = 5e-3;

int rank() {
  return Foam::Pstream::parRun() ? Foam::Pstream::myProcNo() : 0;
}
int ranks() {
  return Foam::Pstream::nProcs();
}

/// Particles of one rank, with room for all samples.
struct Scene {
  std::vector<std::array<double, 3>> position, impulse, velocitySample, pressureSample, vorticitySample;
  std::vector<double> volume, drag, fractionSample;
  std::vector<std::array<double, 9>> extent, gradientSample;
  std::vector<link::CellHint> cell_hint;
  int dealt = 0;

  void add(double x, double y, double z, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const std::array<double, 3> push{1e-5 * normal(random), 1e-5 * normal(random), 1e-5 * normal(random)};
    std::array<double, 9> axes;
    for (double& value : axes)
      value = 0.3 * kDiameter * normal(random);
    if (dealt++ % ranks() != rank())
      return;
    position.push_back({x, y, z});
    impulse.push_back(push);
    extent.push_back(axes);
    volume.push_back(M_PI / 6 * std::pow(kDiameter, 3));
    drag.push_back(1e-7);
  }

  link::ParticleArrays arrays(bool clusters = false) {
    link::ParticleArrays view;
    view.count = position.size();
    cell_hint.resize(view.count);
    view.position = reinterpret_cast<const double(*)[3]>(position.data());
    view.volume = volume.data();
    view.impulse = reinterpret_cast<const double(*)[3]>(impulse.data());
    view.drag_coefficient = drag.data();
    if (clusters)
      view.extent = reinterpret_cast<const double(*)[9]>(extent.data());
    view.cell_hint = cell_hint.data();
    return view;
  }

  link::FluidSamples samples() {
    // One row more: a null pointer would say that this rank asks for nothing.
    for (auto* rows : {&velocitySample, &pressureSample, &vorticitySample})
      rows->resize(position.size() + 1);
    fractionSample.resize(position.size() + 1);
    link::FluidSamples view;
    view[link::kVelocity] = reinterpret_cast<double*>(velocitySample.data());
    view[link::kFraction] = fractionSample.data();
    view[link::kPressureGradient] = reinterpret_cast<double*>(pressureSample.data());
    view[link::kVorticity] = reinterpret_cast<double*>(vorticitySample.data());
    return view;
  }
};

/// All over the annulus, up to the walls and across the periodic planes.
Scene scattered(int count) {
  Scene scene;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  while (scene.dealt < count) {
    const double x = kHole * (2 * unit(random) - 1), y = kHole * (2 * unit(random) - 1);
    if (std::hypot(x, y) < kHole && std::hypot(x, y + kOffset) > kPipe)
      scene.add(x, y, kLength * unit(random), random);
  }
  return scene;
}

/// Grains on a close lattice in the narrow gap: more than thin cells hold by themselves.
Scene packed() {
  Scene scene;
  std::mt19937 random(11);
  for (double x = -0.015; x < 0.015; x += kDiameter)
    for (double y = -0.062; y < -0.045; y += kDiameter)
      for (double z = 0; z < kLength; z += kDiameter)
        if (std::hypot(x, y) < kHole && std::hypot(x, y + kOffset) > kPipe)
          scene.add(x, y, z, random);
  return scene;
}

ExchangeSettings settingsOf(VoidFraction method) {
  ExchangeSettings settings;
  settings.method = method;
  settings.length = method == VoidFraction::gaussian ? kDiameter : 3 * kDiameter;
  settings.tolerance = 1e-13;
  return settings;
}

const VoidFraction kMethods[] = {VoidFraction::centre, VoidFraction::divided, VoidFraction::gaussian,
                                 VoidFraction::diffusion};

Foam::tmp<Foam::volVectorField> fieldOf(const std::function<Foam::vector(const Foam::point&)>& f) {
  using namespace Foam;
  auto field = tmp<volVectorField>(new volVectorField(IOobject("f", sharedMesh->time().timeName(), *sharedMesh),
                                                      *sharedMesh, dimensionedVector("0", dimVelocity, Zero)));
  forAll(field(), celli) field.ref()[celli] = f(sharedMesh->C()[celli]);
  for (auto& patch : field.ref().boundaryFieldRef())
    if (!patch.coupled())
      forAll(patch, i) patch[i] = f(patch.patch().Cf()[i]);
  field.ref().correctBoundaryConditions();
  return field;
}

void checkBalances(Scene scene, bool clusters) {
  for (const VoidFraction method : kMethods) {
    ExchangeSettings settings = settingsOf(method);
    // Sums do not depend on it.
    settings.tolerance = 1e-8;
    particleExchange exchange(*sharedMesh, settings);
    Foam::scalarField solid, drag;
    Foam::vectorField force;
    const link::ParticleArrays particles = scene.arrays(clusters);
    std::fill(scene.cell_hint.begin(), scene.cell_hint.end(), link::CellHint{});
    const auto u = fieldOf([](const Foam::point& x) { return Foam::vector(std::sin(50 * x.x()), x.y(), 1); });
    const Foam::vectorField gradient(u().primitiveField() * 1000.0);
    Foam::volScalarField alpha(Foam::IOobject("alpha", sharedMesh->time().timeName(), *sharedMesh), *sharedMesh,
                               Foam::dimensionedScalar("1", Foam::dimless, 1), "zeroGradient");
    // Twice: the second time the particles are found from their cell hint.
    for (int couplingStep = 0; couplingStep < 2; ++couplingStep) {
      exchange.deposit(particles, kElapsed, solid, &force, &drag);
      EXPECT_GE(Foam::gMin(solid), -settings.tolerance);
      EXPECT_TRUE(exchange.balance().fits);
      EXPECT_LE(Foam::gMax(solid), exchange.settings().maxSolid * 1.01);
      alpha.primitiveFieldRef() = 1.0 - solid;
      alpha.correctBoundaryConditions();
      FlowFields flow;
      flow.velocity = &u();
      flow.fraction = &alpha;
      flow.density[link::kPressureGradient] = &gradient;
      exchange.sample(flow, particles, scene.samples());
      const ExchangeBalance& balance = exchange.balance();
      EXPECT_NEAR(balance.meshVolume / balance.particleVolume, 1.0, 1e-12);
      EXPECT_NEAR(Foam::gSum(Foam::scalarField(solid * sharedMesh->V())) / balance.particleVolume, 1.0, 1e-12);
      const Foam::vector forceSum(Foam::gSum(Foam::vectorField(force * sharedMesh->V())));
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(balance.meshImpulse[k], balance.particleImpulse[k], 1e-12 * balance.impulseScale);
        // What the fluid receives is the opposite of what the particles got.
        EXPECT_NEAR(-forceSum[k] * kElapsed, balance.particleImpulse[k], 1e-12 * balance.impulseScale);
        EXPECT_NEAR(balance.meshPressureForce[k], balance.particlePressureForce[k], 1e-12 * balance.pressureForceScale);
      }
      EXPECT_EQ(exchange.present().searched(), couplingStep == 0 ? scene.position.size() : 0u);
    }
  }
}

} // namespace

TEST(Exchange, VolumeImpulseAndPressureForceBalanceForScatteredSpheres) {
  checkBalances(scattered(400), false);
}
TEST(Exchange, VolumeImpulseAndPressureForceBalanceForClusters) {
  checkBalances(scattered(200), true);
}
TEST(Exchange, VolumeImpulseAndPressureForceBalanceForAPackedBedInThinCells) {
  checkBalances(packed(), false);
}

TEST(Exchange, EveryGuestLiesInItsCellOrBehindAWall) {
  Scene scene = scattered(500);
  // A second set of points, displaced by several cells, walks there from the first one's cells.
  for (int round = 0; round < 3; ++round) {
    particleExchange exchange(*sharedMesh, settingsOf(VoidFraction::centre));
    Foam::scalarField solid;
    exchange.deposit(scene.arrays(), 0, solid, nullptr, nullptr);
    int here = 0, inside = 0;
    for (const ParticlePoint& particlePoint : exchange.present().here()) {
      const Foam::point x(particlePoint.at.position[0], particlePoint.at.position[1], particlePoint.at.position[2]);
      const bool nearWall =
          std::hypot(x.x(), x.y()) > 0.99 * kHole || std::hypot(x.x(), x.y() + kOffset) < 1.02 * kPipe;
      ++here;
      inside += nearWall || sharedMesh->pointInCell(x, particlePoint.at.cell, Foam::polyMesh::FACE_PLANES);
    }
    EXPECT_EQ(inside, here);
    EXPECT_EQ(Foam::returnReduce(here, Foam::sumOp<int>()), 500);
    for (auto& x : scene.position) {
      const double angle = 0.4;
      x = {x[0] * std::cos(angle) - x[1] * std::sin(angle), x[0] * std::sin(angle) + x[1] * std::cos(angle),
           std::fmod(x[2] + 0.37 * kLength, kLength)};
      // Turning about the hole's axis may lead into the pipe: then to the other side of the hole.
      if (std::hypot(x[0], x[1] + kOffset) < kPipe)
        x[1] = 0.05;
    }
  }
}

// No message speaks of particles that did not leave their rank, nor of their total number.
TEST(Exchange, TrafficGrowsWithTheParticlesThatCrossBetweenRanks) {
  const auto bytes = [](Scene& scene) {
    ExchangeSettings settings;
    settings.method = VoidFraction::centre;
    particleExchange exchange(*sharedMesh, settings);
    Foam::scalarField solid;
    const auto couple = [&] {
      exchange.deposit(scene.arrays(), kElapsed, solid, nullptr, nullptr);
      exchange.sample({}, scene.arrays(), {});
      return exchange.present().traffic().bytes;
    };
    // At the first coupling step all are searched for.
    const double search = couple();
    return couple() - search;
  };
  constexpr double kRandom = 0.15;
  Scene few = scattered(400), many = scattered(1600);
  const double less = bytes(few), more = bytes(many);
  if (ranks() == 1) {
    EXPECT_EQ(more, 0);
    return;
  }
  EXPECT_GT(less, 100 * sizeof(ParticlePoint) / 2);
  EXPECT_NEAR(more / less, 4, 4 * kRandom);
  Scene at_home = scattered(0);
  for (std::size_t row = 0; row < many.position.size(); ++row)
    if (many.cell_hint[row].rank == rank()) {
      at_home.position.push_back(many.position[row]);
      at_home.impulse.push_back(many.impulse[row]);
      at_home.volume.push_back(many.volume[row]);
      at_home.drag.push_back(many.drag[row]);
    }
  ASSERT_GT(at_home.position.size(), 100u);
  EXPECT_EQ(bytes(at_home), 0);
}

TEST(Exchange, LinearFieldsAreSampledExactly) {
  Scene scene = scattered(300);
  particleExchange exchange(*sharedMesh, settingsOf(VoidFraction::centre));
  Foam::scalarField solid;
  const link::ParticleArrays particles = scene.arrays();
  exchange.deposit(particles, 0, solid, nullptr, nullptr);
  // Uniform along the periodic direction; curl = (0 0 b - a).
  const double a = 30, b = -70;
  const auto u =
      fieldOf([=](const Foam::point& x) { return Foam::vector(a * x.y() + 1, b * x.x() - 2, 5 * x.x() + x.y()); });
  FlowFields flow;
  flow.velocity = &u();
  link::FluidSamples samples = scene.samples();
  samples[link::kFraction] = nullptr;
  samples[link::kPressureGradient] = nullptr;
  scene.gradientSample.resize(scene.position.size());
  samples[link::kVelocityGradient] = reinterpret_cast<double*>(scene.gradientSample.data());
  exchange.sample(flow, particles, samples);
  int checked = 0;
  for (std::size_t i = 0; i < scene.position.size(); ++i) {
    const auto& x = scene.position[i];
    // The host's least-squares gradient sees only the part of a wall face's distance along its normal: not in wall
    // cells, which take a sixth of the gap.
    const double toHole = kHole - std::hypot(x[0], x[1]), toPipe = std::hypot(x[0], x[1] + kOffset) - kPipe;
    if (std::min(toHole, toPipe) < 0.25 * (toHole + toPipe))
      continue;
    ++checked;
    EXPECT_NEAR(scene.velocitySample[i][0], a * x[1] + 1, 1e-9);
    EXPECT_NEAR(scene.velocitySample[i][1], b * x[0] - 2, 1e-9);
    EXPECT_NEAR(scene.velocitySample[i][2], 5 * x[0] + x[1], 1e-9);
    EXPECT_NEAR(scene.vorticitySample[i][2], b - a, 1e-7);
    EXPECT_NEAR(scene.vorticitySample[i][0], 1, 1e-7);
    EXPECT_NEAR(scene.vorticitySample[i][1], -5, 1e-7);
    const std::array<double, 9> gradient{0, a, 0, b, 0, 0, 5, 1, 0}; // d u_r/d x_c by rows r
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(scene.gradientSample[i][k], gradient[k], 1e-7) << k;
  }
  EXPECT_GT(Foam::returnReduce(checked, Foam::sumOp<int>()), 100);
}

// The exchange works on the cells about the particles alone: what a particle receives and deposits does not depend on
// others far away, which make it work on all cells.
TEST(Exchange, OneParticleIsExchangedAsAmongManyFarAway) {
  const auto u = fieldOf([](const Foam::point& x) {
    return Foam::vector(std::sin(60 * x.x()), std::cos(50 * x.y()), std::sin(2 * M_PI * x.z() / kLength));
  });
  const Foam::vectorField gradient(u().primitiveField() * 1000.0);
  // Cells of 10 mm along the hole: with 8 mm each layer of cells is by itself, with 19 mm they are coupled.
  for (const double length : {8e-3, 3 * kDiameter}) {
    ExchangeSettings settings = settingsOf(VoidFraction::diffusion);
    settings.length = length;
    particleExchange exchange(*sharedMesh, settings);
    std::mt19937 random(5);
    Scene scenes[3]; // alone, the others, all
    scenes[0].add(0.001, 0.0335, 0.012, random);
    for (int k = 0; k < 40; ++k) {
      const double angle = 0.7 * k, z = 0.0025 * k;
      scenes[1].add(0.045 * std::cos(angle), 0.045 * std::sin(angle), z, random);
    }
    scenes[2] = scenes[0];
    scenes[2].dealt = ranks(); // each rank keeps its own
    for (std::size_t i = 0; i < scenes[1].position.size(); ++i) {
      const Scene& others = scenes[1];
      scenes[2].position.push_back(others.position[i]);
      scenes[2].impulse.push_back(others.impulse[i]);
      scenes[2].extent.push_back(others.extent[i]);
      scenes[2].volume.push_back(others.volume[i]);
      scenes[2].drag.push_back(others.drag[i]);
    }
    Foam::scalarField solid[3], drag[3];
    Foam::vectorField force[3];
    // The largest region first and last: what it leaves behind must not be read.
    for (const int k : {2, 0, 1, 2}) {
      exchange.deposit(scenes[k].arrays(), kElapsed, solid[k], &force[k], &drag[k]);
      FlowFields flow;
      flow.velocity = &u();
      flow.density[link::kPressureGradient] = &gradient;
      exchange.sample(flow, scenes[k].arrays(), scenes[k].samples());
    }
    const double largest = Foam::gMax(solid[2]), hardest = Foam::gMax(Foam::mag(force[2])());
    EXPECT_LT(Foam::gMax(Foam::mag(solid[0] + solid[1] - solid[2])()), 1e-13 * largest);
    EXPECT_LT(Foam::gMax(Foam::mag(drag[0] + drag[1] - drag[2])()), 1e-13 * Foam::gMax(drag[2]));
    EXPECT_LT(Foam::gMax(Foam::mag(force[0] + force[1] - force[2])()), 1e-13 * hardest);
    if (length < 0.01) {
      const Foam::scalarField z(sharedMesh->C().primitiveField().component(Foam::vector::Z));
      forAll(z, cell) {
        if (std::abs(z[cell] - 0.012) > 0.031) {
          EXPECT_EQ(solid[0][cell], 0) << z[cell];
        }
      }
    }
    for (std::size_t i = 0; i < scenes[0].position.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(scenes[0].velocitySample[i][k], scenes[2].velocitySample[i][k]);
        EXPECT_EQ(scenes[0].pressureSample[i][k], scenes[2].pressureSample[i][k]);
        EXPECT_NE(scenes[0].pressureSample[i][k], 0);
      }
  }
}

// Implicit steps over T in all spread a point with variance 2 T = length^2 / 2 per direction, as long as it meets no
// wall.
TEST(Exchange, DiffusionSpreadsByItsLengthAlongTheHole) {
  Scene scene;
  std::mt19937 random(3);
  scene.add(0.0, 0.0335, 0.5 * kLength, random);
  for (const int steps : {1, 2}) {
    ExchangeSettings settings = settingsOf(VoidFraction::diffusion);
    settings.diffusionSteps = steps;
    settings.length = 0.01;
    particleExchange exchange(*sharedMesh, settings);
    Foam::scalarField solid;
    exchange.deposit(scene.arrays(), 0, solid, nullptr, nullptr);
    const Foam::scalarField z(sharedMesh->C().primitiveField().component(Foam::vector::Z));
    const Foam::scalarField amount(solid * sharedMesh->V());
    const double cell = kLength / 10;
    const double mean = Foam::gSum(Foam::scalarField(z * amount)) / Foam::gSum(amount);
    const double variance = Foam::gSum(Foam::scalarField(Foam::sqr(z - mean) * amount)) / Foam::gSum(amount);
    // Along z the second moment of the discrete solution is exact, apart from the images of the periodic section: the
    // diffusion leaves out what cells spread by themselves, 0.4 cell^2 on the average, of which the shares of this
    // point in a plane of vertices are 0.25 cell^2.
    EXPECT_NEAR(variance, 0.5 * settings.length * settings.length - (0.4 - 0.25) * cell * cell,
                0.01 * settings.length * settings.length);
    EXPECT_NEAR(mean, 0.5 * kLength, 1e-6 * cell);
  }
}

/// Spreads over this length and checks against the equations of the implicit steps, put together by the host's own
/// operators.
void expect_implicit_steps(double kSpread) {
  using namespace Foam;
  constexpr double kTolerance = 1e-11;
  constexpr int kSteps = 2;
  const double step = 0.25 * kSpread * kSpread / kSteps, perSquaredCell = 0.2 / kSteps;
  conservativeDiffusion diffusion(*sharedMesh, kSpread, kSteps, kTolerance);
  FieldBundle<kWide> amounts(sharedMesh->nCells(), Bundled<kWide>{});
  forAll(sharedMesh->C(), cell) {
    const point& x = sharedMesh->C()[cell];
    amounts[cell].at[0] = sharedMesh->V()[cell] * (x.y() > 0.5 * kHole ? 1.0 : 0.0);
    amounts[cell].at[4] = sharedMesh->V()[cell] * std::sin(100 * x.x());
  }
  FieldBundle<kWide> spread(amounts);
  diffusion.spread(spread, 5);
  const surfaceScalarField diffusivity(
      max(dimensionedScalar("step", dimArea, step) - perSquaredCell / sqr(sharedMesh->nonOrthDeltaCoeffs()),
          dimensionedScalar("0", dimArea, 0)));
  for (const int lane : {0, 4}) {
    volScalarField value(IOobject("value", sharedMesh->time().timeName(), *sharedMesh), *sharedMesh,
                         dimensionedScalar("0", dimless, 0), "zeroGradient");
    forAll(value, cell) value[cell] = spread[cell].at[lane] / sharedMesh->V()[cell];
    // Backwards: what the steps were made of.
    for (int i = 0; i < kSteps; ++i) {
      value.correctBoundaryConditions();
      const surfaceScalarField flux(diffusivity * sharedMesh->magSf() *
                                    fv::uncorrectedSnGrad<scalar>(*sharedMesh).snGrad(value));
      value.primitiveFieldRef() -= fvc::surfaceIntegrate(flux)().primitiveField();
    }
    scalarField error(sharedMesh->nCells());
    forAll(error, cell) error[cell] = value[cell] - amounts[cell].at[lane] / sharedMesh->V()[cell];
    // Each step back enlarges the polynomial's error by the largest eigenvalue at most.
    EXPECT_LT(gMax(mag(error)()), 1e-5) << lane;
    scalarField before(error.size()), after(error.size());
    forAll(error, cell) {
      before[cell] = amounts[cell].at[lane];
      after[cell] = spread[cell].at[lane];
    }
    EXPECT_NEAR(gSum(after), gSum(before), 1e-13 * gSum(mag(before)()));
    EXPECT_GT(gMax(mag(scalarField(after - before))()), 0.01 * gMax(mag(before)()));
  }
}

TEST(Exchange, DiffusionIsThatOfImplicitSteps) {
  expect_implicit_steps(0.03); // by a polynomial
}

// Cells of 10 mm along the hole: each layer by itself.
TEST(Exchange, DiffusionInLayersIsThatOfImplicitSteps) {
  expect_implicit_steps(0.009);
}

// A particle that moves through faces changes what cells receive by no more than it moves, anywhere in a cell.
TEST(Exchange, DepositionIsContinuousAcrossFacesAndKeepsTheFirstMoment) {
  constexpr double step = 1e-7;
  const double cell = kLength / 10;
  for (const double height : {0.5, 0.502, 0.51}) {
    Foam::scalarField before;
    for (const double side : {-step, step}) {
      Scene scene;
      std::mt19937 random(3);
      // Through the plane of symmetry (a plane of faces) and, at half height, through a plane across the hole.
      scene.add(side, 0.0335, height * kLength + side, random);
      particleExchange exchange(*sharedMesh, settingsOf(VoidFraction::diffusion));
      Foam::scalarField solid;
      exchange.deposit(scene.arrays(), 0, solid, nullptr, nullptr);
      if (side < 0) {
        before = solid;
        continue;
      }
      const double largest = Foam::gMax(solid);
      EXPECT_LT(Foam::gMax(Foam::scalarField(mag(solid - before))), 100 * step / cell * largest) << height;
      const Foam::scalarField z(sharedMesh->C().primitiveField().component(Foam::vector::Z));
      const Foam::scalarField amount(solid * sharedMesh->V());
      EXPECT_NEAR(Foam::gSum(Foam::scalarField(z * amount)) / Foam::gSum(amount), height * kLength, 0.02 * cell);
    }
  }
}

TEST(Exchange, SettingsThatMakeNoSenseAreNamed) {
  const auto message = [](ExchangeSettings settings) -> std::string {
    try {
      particleExchange exchange(*sharedMesh, settings);
    } catch (const std::invalid_argument& problem) {
      return problem.what();
    }
    return "";
  };
  ExchangeSettings settings = settingsOf(VoidFraction::diffusion);
  settings.length = 0;
  EXPECT_NE(message(settings).find("length"), std::string::npos);
  settings = settingsOf(VoidFraction::centre);
  settings.maxSolid = 1.5;
  EXPECT_NE(message(settings).find("mostSolid is 1.5"), std::string::npos);
  settings = settingsOf(VoidFraction::centre);
  settings.fractionFloor = -0.1;
  EXPECT_NE(message(settings).find("fractionFloor is -0.1"), std::string::npos);
}
