// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The averaged equations with a moving fluid fraction: manufactured motion, mass, momentum, restart, the limit alpha
// = 1.
#include "flow/deferredConvection.H"
#include "flow/flow_case.h"

#include "fvCFD.H"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace eccentra::test {
namespace {

using Foam::averagedFlow;
constexpr double kLength = 0.1;
constexpr double kWave = 2 * M_PI / kLength;

/// alpha = mean + amplitude sin(k x) cos(w t); the flow that continuity asks for is
/// alpha u = Ubar - amplitude (w/k) cos(k x) sin(w t).
struct ManufacturedFraction {
  double mean = 0.7, amplitude = 0.2, omega = 5, Ubar = 0.05;
  double alpha(double x, double t) const { return mean + amplitude * std::sin(kWave * x) * std::cos(omega * t); }
  double flux(double x, double t) const {
    return Ubar - amplitude * omega / kWave * std::cos(kWave * x) * std::sin(omega * t);
  }
  /// Cell average, which keeps the sum over the box exactly constant.
  double cell_alpha(double x, double dx, double t) const {
    return mean + amplitude * (std::cos(kWave * (x - dx / 2)) - std::cos(kWave * (x + dx / 2))) / (kWave * dx) *
                      std::cos(omega * t);
  }
};

void set_fraction(FlowCase& flow_case, const ManufacturedFraction& exact, int cells, double t) {
  auto& alpha = flow_case.flow().alpha();
  auto& values = alpha.primitiveFieldRef();
  forAll(values, celli) {
    values[celli] = exact.cell_alpha(flow_case.mesh().C()[celli].x(), kLength / cells, t);
  }
  alpha.correctBoundaryConditions();
}

struct MotionResult {
  double velocity_error, mass_error;
};

MotionResult manufactured(int cells, double step, double end) {
  const ManufacturedFraction exact;
  FlowCase flow_case("manufactured");
  flow_case.control({{"deltaT", std::to_string(step)}, {"endTime", "1e6"}});
  flow_case.periodic_box_mesh(kLength, cells, 1, 1);
  const std::string all = "\".*\" { type cyclic; }";
  flow_case.fields("uniform (0.0714 0 0)", all, all);
  flow_case.newtonian(1000, 0.1);
  flow_case.drive("type meanVelocity; direction (1 0 0); Ubar 0.05;");
  flow_case.flow(averagedFlow::particles::coupled);
  set_fraction(flow_case, exact, cells, 0);
  flow_case.flow().resetFractionHistory();
  MotionResult result{0, 0};
  for (int i = 0; i < int(std::lround(end / step)); ++i) {
    flow_case.advance(1, [&](double t) { set_fraction(flow_case, exact, cells, t); });
    result.mass_error = std::max(result.mass_error, flow_case.flow().continuityError());
  }
  forAll(flow_case.flow().U(), celli) {
    const double x = flow_case.mesh().C()[celli].x(), t = flow_case.time().value();
    const double u = exact.flux(x, t) / exact.alpha(x, t);
    result.velocity_error = std::max(result.velocity_error, std::abs(flow_case.flow().U()[celli].x() - u));
  }
  return result;
}

TEST(MovingFraction, DrivesTheFlowThatContinuityAsksFor) {
  const MotionResult coarse = manufactured(20, 0.02, 0.4);
  const MotionResult middle = manufactured(40, 0.01, 0.4);
  const MotionResult fine = manufactured(80, 0.005, 0.4);
  // The largest velocity that the moving fraction alone makes is some 30 mm/s.
  EXPECT_LT(fine.velocity_error, 3e-4);
  EXPECT_GT(std::log2(coarse.velocity_error / middle.velocity_error), 1.6);
  EXPECT_GT(std::log2(middle.velocity_error / fine.velocity_error), 1.6);
  for (const MotionResult& r : {coarse, middle, fine}) {
    EXPECT_LT(r.mass_error, 1e-10) << "the tolerance of the pressure solver";
  }
}

TEST(MovingFraction, RefusesToSqueezeAClosedSection) {
  FlowCase flow_case("squeezed");
  flow_case.periodic_box_mesh(kLength, 4, 4, 4);
  const std::string all = "\".*\" { type cyclic; }";
  flow_case.fields("uniform (0 0 0)", all, all);
  flow_case.newtonian(1000, 0.1);
  flow_case.flow(averagedFlow::particles::coupled);
  const auto squeeze = [&](double) { flow_case.flow().alpha() = Foam::dimensionedScalar("a", Foam::dimless, 0.9); };
  try {
    flow_case.advance(1, squeeze);
    FAIL() << "the fluid cannot leave";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("incompressible"), std::string::npos) << error.what();
  }
}

/// Closed periodic box, force and exchange that vary in space and time.
struct MomentumBalance {
  double momentum_error; ///< relative to the impulse put in
  double impulse;
};

MomentumBalance momentum_balance(double exchange, int steps) {
  FlowCase flow_case("momentum");
  const double step = 5e-3;
  flow_case.control({{"deltaT", std::to_string(step)}, {"endTime", "1e6"}});
  flow_case.numerics("Euler", "nCorrectors 2; consistent yes;");
  flow_case.periodic_box_mesh(kLength, 8, 4, 4);
  const std::string all = "\".*\" { type cyclic; }";
  flow_case.fields("uniform (0 0 0)", all, all);
  flow_case.newtonian(1000, 0.1);
  averagedFlow& flow = flow_case.flow(averagedFlow::particles::coupled);
  const Foam::scalarField& V = flow_case.mesh().V().field();
  double impulse = 0;
  flow_case.advance(steps, [&](double t) {
    auto& force = flow.particleForce().primitiveFieldRef();
    forAll(force, celli) {
      const Foam::vector& c = flow_case.mesh().C()[celli];
      force[celli] = Foam::vector(t < 0.5 * steps * step ? 1 + std::sin(kWave * c.x()) : 0, 0, 0);
    }
    flow.exchange() = Foam::dimensionedScalar("K", Foam::dimless / Foam::dimTime, exchange);
    impulse += step * Foam::gSum((force.component(0) * V)());
  });
  const double momentum = Foam::gSum((flow.alpha().primitiveField() * flow.U().primitiveField().component(0) * V)());
  const double withheld = step * Foam::gSum((flow.withheldForce().primitiveField().component(0) * V)());
  return {(momentum + withheld - impulse) / impulse, impulse};
}

TEST(Momentum, SemiImplicitExchangeReturnsWhatItHeldBack) {
  for (const double exchange : {0.0, 100.0, 1e4}) {
    const MomentumBalance balance = momentum_balance(exchange, 40);
    EXPECT_GT(balance.impulse, 0);
    EXPECT_LT(std::abs(balance.momentum_error), 1e-10) << "K = " << exchange << " 1/s";
  }
}

TEST(DeferredConvection, KeepsTheSchemeAndTheMomentumAndMakesTheDiagonalDominant) {
  FlowCase flow_case("deferred");
  flow_case.control({{"deltaT", "0.1"}});
  flow_case.periodic_box_mesh(kLength, 6, 5, 4);
  const std::string all = "\".*\" { type cyclic; }";
  flow_case.fields("uniform (0 0 0)", all, all);
  flow_case.newtonian(1000, 0.001);
  averagedFlow& flow = flow_case.flow();
  const Foam::fvMesh& mesh = flow_case.mesh();
  forAll(flow.U(), celli) {
    const Foam::vector& c = mesh.C()[celli];
    flow.U()[celli] = Foam::vector(3 + std::sin(kWave * c.y()), std::cos(kWave * c.z()), std::sin(kWave * c.x()));
  }
  flow.U().correctBoundaryConditions();
  const Foam::surfaceScalarField flux(fvc::flux(flow.U()));
  const Foam::surfaceScalarField nu("nu", fvc::interpolate(flow.rheology().nu()));
  const Foam::fvVectorMatrix plain(fvm::div(flux, flow.U(), "div(phi,U)"));
  Foam::fvVectorMatrix deferred(plain);
  deferCentralDifferences(deferred, flow.U(), nu);
  const Foam::vectorField same((plain & flow.U())().primitiveField() - (deferred & flow.U())().primitiveField());
  EXPECT_LT(Foam::gMax(mag(same)()), 1e-10) << "the scheme at the last iterate";
  forAll(flow.U(), celli) {
    flow.U()[celli] += Foam::vector(celli % 3, celli % 5, celli % 7);
  }
  flow.U().correctBoundaryConditions();
  const Foam::vectorField change((plain & flow.U())().primitiveField() - (deferred & flow.U())().primitiveField());
  EXPECT_GT(Foam::gMax(mag(change)()), 1) << "nothing was deferred";
  EXPECT_LT(mag(Foam::gSum((change * mesh.V().field())())), 1e-12 * Foam::gSum((mag(change) * mesh.V().field())()));

  for (const bool dominant : {false, true}) {
    const Foam::fvVectorMatrix& matrix = dominant ? deferred : plain;
    // Row by row with the time derivative; the coupled patches add their share to both sides.
    Foam::scalarField slack(matrix.diag() + mesh.V().field() / mesh.time().deltaTValue());
    forAll(matrix.upper(), facei) {
      slack[mesh.owner()[facei]] -= std::abs(matrix.upper()[facei]);
      slack[mesh.neighbour()[facei]] -= std::abs(matrix.lower()[facei]);
    }
    forAll(mesh.boundary(), patchi) {
      const Foam::labelUList& cells = mesh.boundary()[patchi].faceCells();
      forAll(cells, i) {
        slack[cells[i]] += matrix.internalCoeffs()[patchi][i].x() - std::abs(matrix.boundaryCoeffs()[patchi][i].x());
      }
    }
    // 100 times the viscous coefficients, small here, may be counted on.
    const Foam::scalar viscous = 0.5 * Foam::gMin(mesh.V().field()) / mesh.time().deltaTValue();
    EXPECT_EQ(Foam::gMin(slack) >= -viscous, dominant) << Foam::gMin(slack);
  }
}

TEST(Momentum, BalancesWhileTheFractionMoves) {
  // Impulse: of the particles, and of the pressure on the fluid's share of each cell. Iterated to convergence, so that
  // what is left is what the lagged fluxes withheld, and that is accounted for.
  FlowCase flow_case("momentum_moving");
  const double step = 5e-3;
  flow_case.control({{"deltaT", std::to_string(step)}, {"endTime", "1e6"}});
  flow_case.numerics("Euler", "nCorrectors 2; consistent yes; nOuterCorrectors 12;");
  flow_case.periodic_box_mesh(kLength, 8, 4, 4);
  const std::string all = "\".*\" { type cyclic; }";
  flow_case.fields("uniform (0 0 0)", all, all);
  flow_case.newtonian(1000, 0.1);
  averagedFlow& flow = flow_case.flow(averagedFlow::particles::coupled);
  const Foam::scalarField& V = flow_case.mesh().V().field();
  const ManufacturedFraction motion;
  set_fraction(flow_case, motion, 8, 0);
  flow.resetFractionHistory();
  double impulse = 0;
  for (int i = 0; i < 30; ++i) {
    flow_case.advance(1, [&](double t) {
      set_fraction(flow_case, motion, 8, t);
      auto& force = flow.particleForce().primitiveFieldRef();
      forAll(force, celli) {
        force[celli] = Foam::vector(1 + std::sin(kWave * flow_case.mesh().C()[celli].x()), 0, 0);
      }
      flow.exchange() = Foam::dimensionedScalar("K", Foam::dimless / Foam::dimTime, 50);
      impulse += step * Foam::gSum((force.component(0) * V)());
    });
    const auto gradient = flow.pressureGradient();
    impulse -= step / flow.rho() *
               Foam::gSum((gradient().primitiveField().component(0) * flow.alpha().primitiveField() * V)());
  }
  const double momentum = Foam::gSum((flow.alpha().primitiveField() * flow.U().primitiveField().component(0) * V)()) +
                          step * Foam::gSum((flow.withheldForce().primitiveField().component(0) * V)());
  EXPECT_NEAR(momentum, impulse, 1e-8 * impulse);
}

void annulus(FlowCase& flow_case, double eccentricity, const std::string& drive) {
  flow_case.annulus_mesh(eccentricity, 6, 24, 4, 0.05);
  flow_case.annulus_fields(eccentricity, 5.235988);
  flow_case.newtonian(1000, 0.1);
  flow_case.drive(drive);
}

double largest_difference(const Foam::vectorField& a, const Foam::vectorField& b) {
  return Foam::gMax(mag(a - b)());
}

TEST(Restart, ContinuesTheStraightRun) {
  const auto motion = [](FlowCase& c, double t) {
    averagedFlow& flow = c.flow();
    auto& alpha = flow.alpha().primitiveFieldRef();
    auto& force = flow.particleForce().primitiveFieldRef();
    forAll(alpha, celli) {
      const Foam::vector& x = c.mesh().C()[celli];
      alpha[celli] = 0.8 + 0.1 * std::sin(2 * M_PI * x.z() / 0.05 + 3 * t);
      force[celli] = Foam::vector(0, -0.2, -0.1 * std::cos(40 * x.y() + t));
    }
    // The mean of the sampled sine is zero only up to the grid; the volume must stay as it was.
    const Foam::scalarField& V = c.mesh().V().field();
    alpha += 0.8 - Foam::gSum((alpha * V)()) / Foam::gSum(V);
    flow.alpha().correctBoundaryConditions();
    flow.exchange() = Foam::dimensionedScalar("K", Foam::dimless / Foam::dimTime, 20);
  };
  FlowCase flow_case("restart");
  flow_case.control({{"deltaT", "0.01"}, {"endTime", "1e6"}, {"writeInterval", "10"}});
  annulus(flow_case, 0.5, "type meanVelocity; Ubar 0.3;");
  flow_case.fluid("HerschelBulkleyCapped", 1000, "tau0 1; k 0.28; n 0.65; muY 100;");
  const auto run = [&](int steps) {
    flow_case.flow(averagedFlow::particles::coupled);
    for (int i = 0; i < steps; ++i) {
      flow_case.advance(1, [&](double t) { motion(flow_case, t); });
      flow_case.time().write();
    }
  };
  flow_case.flow(averagedFlow::particles::coupled);
  motion(flow_case, 0);
  flow_case.flow().resetFractionHistory();
  run(20);
  const Foam::vectorField straight(flow_case.flow().U().primitiveField());
  const double G = flow_case.flow().drivingPressureGradient();
  ASSERT_EQ(run_program(flow_case.folder(), "rm -r 0.2").exit_code, 0);
  flow_case.reopen();
  run(10);
  ASSERT_NEAR(flow_case.time().value(), 0.2, 1e-12);
  EXPECT_LT(largest_difference(flow_case.flow().U().primitiveField(), straight), 1e-9);
  EXPECT_NEAR(flow_case.flow().drivingPressureGradient(), G, 1e-6 * G);
}

/// What stock pimpleFoam computes after some steps.
Foam::vectorField stock(FlowCase& flow_case, const std::string& last) {
  flow_case.dictionary("constant/turbulenceProperties", "simulationType laminar;\n");
  const Outcome outcome = run_program(flow_case.folder(), stock_solver("pimpleFoam"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const Foam::volVectorField U(Foam::IOobject("U", Foam::word(last), flow_case.mesh(), Foam::IOobject::MUST_READ,
                                              Foam::IOobject::NO_WRITE, false),
                               flow_case.mesh());
  return U.primitiveField();
}

TEST(FractionOne, IsStockPimpleFoamWithAHerschelBulkleyFluid) {
  // Both average the viscosities of the cells, those of the last step.
  for (const std::string scheme : {"Euler", "backward"}) {
    for (const bool coupled : {false, true}) {
      FlowCase flow_case("stock_mud_" + scheme + (coupled ? "_coupled" : ""));
      flow_case.control({{"deltaT", "0.002"},
                         {"endTime", "0.04"},
                         {"writeInterval", "20"},
                         {"libs", "(\"libeccentraRheology.so\")"}});
      flow_case.numerics(scheme, "nCorrectors 2; consistent yes; pRefCell 0; pRefValue 0;");
      annulus(flow_case, 0.5, "type none;");
      flow_case.fluid("HerschelBulkleyCapped", 1000, "tau0 1; k 0.28; n 0.65; muY 1;", "faceViscosity interpolated;");
      flow_case.flow(coupled ? averagedFlow::particles::coupled : averagedFlow::particles::none);
      flow_case.advance(20);
      const Foam::vectorField ours(flow_case.flow().U().primitiveField());
      const double speed = Foam::gMax(mag(ours)());
      EXPECT_GT(speed, 0.01);
      EXPECT_LT(largest_difference(ours, stock(flow_case, "0.04")), 1e-8 * speed) << scheme << ", coupled " << coupled;
    }
  }
}

TEST(FractionOne, IsStockPimpleFoam) {
  // Flow around a turning eccentric pipe; the time step keeps the stock solver's floor on its row sum inactive.
  for (const std::string scheme : {"Euler", "backward"}) {
    for (const bool coupled : {false, true}) {
      FlowCase flow_case("stock_" + scheme + (coupled ? "_coupled" : ""));
      flow_case.control({{"deltaT", "0.005"}, {"endTime", "0.1"}, {"writeInterval", "20"}});
      flow_case.numerics(scheme, "nCorrectors 2; consistent yes; pRefCell 0; pRefValue 0;");
      annulus(flow_case, 0.5, "type none;");
      flow_case.flow(coupled ? averagedFlow::particles::coupled : averagedFlow::particles::none);
      flow_case.advance(20);
      const Foam::vectorField ours(flow_case.flow().U().primitiveField());
      const double speed = Foam::gMax(mag(ours)());
      EXPECT_GT(speed, 0.05);
      EXPECT_LT(largest_difference(ours, stock(flow_case, "0.1")), 1e-8 * speed) << scheme << ", coupled " << coupled;
    }
  }
}

TEST(SinglePhase, CarriesNoFieldOfTheParticles) {
  FlowCase flow_case("single");
  annulus(flow_case, 0.5, "type none;");
  flow_case.flow();
  for (const char* name : {"alpha", "withheldForce", "particleForce", "exchange"}) {
    EXPECT_FALSE(flow_case.mesh().foundObject<Foam::regIOobject>(name)) << name;
  }
  EXPECT_THROW(flow_case.flow().alpha(), std::exception);
}

} // namespace
} // namespace eccentra::test
