// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Flow around a turning pipe: profile, torque, and the axial flow that it thins.
#include "flow/flow_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eccentra::test {
namespace {

constexpr double kPipe = 0.02413, kHole = 0.0635;
constexpr double kOmega = 5.235988; // 50 rpm
constexpr double kLength = 0.05;

/// Torque of the fluid on the hole per length, about the axis [N].
double torque_on_hole(Foam::averagedFlow& flow) {
  const Foam::label patch = flow.mesh().boundaryMesh().findPatchID("hole");
  const Foam::fvPatch& hole = flow.mesh().boundary()[patch];
  const Foam::vectorField traction(-flow.rho() * flow.rheology().nu(patch) * flow.U().boundaryField()[patch].snGrad());
  return Foam::gSum((hole.Cf() ^ traction)().component(2)() * hole.magSf()) / kLength;
}

/// Largest relative deviation of the azimuthal velocity from r omega(r), omega(r) of a fluid of flow index n.
double profile_error(Foam::averagedFlow& flow, double n) {
  const double a = std::pow(kPipe, -2 / n), b = std::pow(kHole, -2 / n);
  double worst = 0;
  forAll(flow.U(), celli) {
    const Foam::vector& c = flow.mesh().C()[celli];
    const double r = std::hypot(c.x(), c.y());
    const double azimuthal = (c.x() * flow.U()[celli].y() - c.y() * flow.U()[celli].x()) / r;
    const double exact = kOmega * r * (std::pow(r, -2 / n) - b) / (a - b);
    worst = std::max(worst, std::abs(azimuthal - exact) / (kOmega * kPipe));
  }
  return worst;
}

double torque_per_length(double n, double k) {
  const double a = std::pow(kPipe, -2 / n), b = std::pow(kHole, -2 / n);
  return 2 * M_PI * kPipe * kPipe * k * std::pow(2 / n * kOmega * a / (a - b), n);
}

void check(const std::string& name, double n, double k, int radial) {
  FlowCase flow_case(name);
  flow_case.control({{"deltaT", "1"}, {"endTime", "1e6"}});
  flow_case.annulus_mesh(0, radial, 48, 1, kLength, 4);
  flow_case.annulus_fields(0, kOmega);
  if (n == 1) {
    flow_case.newtonian(1000, k);
  } else {
    flow_case.fluid("HerschelBulkleyCapped", 1000,
                    "tau0 0; k " + std::to_string(k) + "; n " + std::to_string(n) + "; muY 100;");
  }
  const double torque = flow_case.steady([&] { return torque_on_hole(flow_case.flow()); }, 1e-6, 300);
  EXPECT_NEAR(torque, torque_per_length(n, k), 0.005 * torque);
  EXPECT_LT(profile_error(flow_case.flow(), n), 0.005);
}

TEST(RotatingPipe, NewtonianTorqueAndProfile) {
  ASSERT_NEAR(torque_per_length(1, 0.1), 4.47767279e-3, 1e-8);
  check("couette_newtonian", 1, 0.1, 24);
}

TEST(RotatingPipe, PowerLawTorqueAndProfile) {
  check("couette_power_law", 0.65, 0.28, 32);
}

TEST(RotatingPipe, TurningThinsTheAxialFlow) {
  double last = 1e30;
  for (const double rpm : {0.0, 150.0, 400.0}) {
    FlowCase flow_case("thinning");
    flow_case.control({{"deltaT", "4"}, {"endTime", "1e6"}});
    flow_case.annulus_mesh(0, 12, 32, 1, kLength);
    flow_case.annulus_fields(0, rpm * 2 * M_PI / 60);
    flow_case.fluid("HerschelBulkleyCapped", 1000, "tau0 0; k 0.28; n 0.65; muY 100;");
    flow_case.drive("type meanVelocity; Ubar 0.58;");
    const double G = flow_case.steady([&] { return flow_case.flow().drivingPressureGradient(); }, 1e-6, 600);
    EXPECT_LT(G, last * (rpm > 0 ? 0.998 : 1)) << rpm << " rpm";
    last = G;
  }
}

} // namespace
} // namespace eccentra::test
