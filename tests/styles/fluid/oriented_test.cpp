// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of real shape in a prescribed flow: attitude, drift, Jeffery's period, rest in mud, momentum.
#include "closures/pitching_laws.h"
#include "shape/resistance_cache.h"
#include "styles/bodies/fix_cluster_bodies.h"

#include "fluid_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

using namespace eccentra::test;
using eccentra::closures::PitchingLaw;
using eccentra::shape::Resistance;
using eccentra::styles::FixClusterBodies;
using eccentra::styles::FixFluidForce;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double kWeight = M_PI / 6 * kDiameter * kDiameter * kDiameter * (kSolidDensity - kFluidDensity) * kGravity;

/// One cluster at rest in the middle of a periodic box, its body frame turned about y by `angle`.
class Scene {
 public:
  Scene(const std::string& shape, double angle, const std::string& density, const std::string& more) {
    std::string head = scene_head();
    const std::string stock = "pair_style gran model";
    head.replace(head.find(stock), stock.size(), "pair_style gran/cluster model");
    session_.script(
        head + one_sphere() + "timestep 1e-3\nfix shape all particletemplate/cluster 15485863 atom_type 1 " +
        "density constant " + density + " shape " + shape + " diameter 6.35e-3\nfix integrate all nve/cluster\n");
    const Quaterniond turn(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
    const double q[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
    const int i = session_.local(1);
    if (i >= 0)
      bodies().make_body(i, 0, std::stod(density), q);
    session_.script(more);
  }
  void run(int steps) { session_.script("run " + std::to_string(steps) + " post no\n"); }
  FixClusterBodies& bodies() { return *FixClusterBodies::find(&session_.lammps()); }
  LiggghtsSession& session() { return session_; }

  Resistance resistance() { return eccentra::shape::cached_resistance(bodies().shapes()[0]); }
  Vector3d velocity() {
    return {velocity_of(session_, 1, 0), velocity_of(session_, 1, 1), velocity_of(session_, 1, 2)};
  }
  /// The body's z axis in the world, the same on every rank.
  Vector3d axis() {
    std::array<double, 3> mine{0, 0, 0}, all{};
    const int i = session_.local(1);
    if (i >= 0) {
      const double* q = bodies().quaternion(i);
      const Vector3d axis = Quaterniond(q[0], q[1], q[2], q[3]) * Vector3d::UnitZ();
      mine = {axis[0], axis[1], axis[2]};
    }
    MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return {all[0], all[1], all[2]};
  }
  /// Angle of the axis from z towards x.
  double tilt() {
    const Vector3d a = axis();
    return std::atan2(a.x(), a.z());
  }

 private:
  LiggghtsSession session_;
};

const char* const kTorques = " drag_torque dennis oriented on pitching_torque dabade";

/// Quasi-steady fall of the disk at this tilt under Schiller & Naumann's inertia: speed, and the rate of its turning.
struct Falling {
  double speed, rate;
};
Falling falling(const Resistance& r, double tilt, double viscosity) {
  // Along the body's x and z: W_i = (pi/8) d^2 X G_i u_i/U = 3 pi mu d (K_i + .15 Re^.687) u_i.
  const double along[2] = {kWeight * std::sin(tilt), kWeight * std::cos(tilt)};
  double u[2] = {0, 0}, speed = 0;
  for (int n = 0; n < 200; ++n) {
    const double inertial = .15 * std::pow(kFluidDensity * speed * kDiameter / viscosity, .687);
    for (int k = 0; k < 2; ++k)
      u[k] = along[k] / (3 * M_PI * viscosity * kDiameter * (r.translation(2 * k, 2 * k) + inertial));
    speed = std::hypot(u[0], u[1]);
  }
  const double b = std::abs(r.bretherton()[1]), ratio = std::sqrt((1 - b) / (1 + b));
  const double c = PitchingLaw(ratio)(kFluidDensity * speed * kDiameter / viscosity);
  const double torque = M_PI / 16 * kFluidDensity * std::pow(kDiameter, 3) * c * u[0] * u[1];
  return {speed, -torque / (M_PI * viscosity * std::pow(kDiameter, 3) * r.rotation(1, 1))};
}

/// The turning of a disk whose spin relaxes far faster than it turns: in the time that theory says, from any angle.
TEST(Oriented, ADiskFallsBroadsideFromAnyAngle) {
  constexpr double viscosity = .5; // Re near 1
  for (const double degrees : {75.0, 40.0, -60.0}) {
    Scene scene("disk 48", degrees * M_PI / 180, "2619",
                gravity() + "fix mud all fluid/force rheology newtonian 0.5 density 1000 drag schiller_naumann" +
                    kTorques + "\nfix flow all fluid/uniform velocity 0 0 0\n");
    const Resistance r = scene.resistance();
    scene.run(100); // to the terminal velocity
    double tilt = scene.tilt();
    for (int n = 0; n < 5; ++n) {
      constexpr int steps = 200;
      for (int k = 0; k < 1000; ++k)
        tilt += steps * 1e-3 / 1000 * falling(r, tilt, viscosity).rate;
      scene.run(steps);
      EXPECT_NEAR(std::tan(scene.tilt()), std::tan(tilt), .02 * std::abs(std::tan(tilt))) << degrees;
    }
    EXPECT_NEAR(scene.velocity().norm(), falling(r, scene.tilt(), viscosity).speed, 2e-3 * scene.velocity().norm());
    scene.run(8000);
    EXPECT_LT(std::abs(std::sin(scene.tilt())), 5e-3) << degrees; // exponentially
  }
}

/// In creeping flow nothing turns it, and it drifts by K alone.
TEST(Oriented, ADiskDriftsInCreepingFlowAndKeepsItsAngle) {
  constexpr double degrees = 50, f = degrees * M_PI / 180;
  Scene scene("disk 19", f, "2619",
              gravity() +
                  "fix mud all fluid/force rheology newtonian 100 density 1000 drag schiller_naumann oriented on\n"
                  "fix flow all fluid/uniform velocity 0 0 0\n");
  scene.run(50);
  const Resistance r = scene.resistance();
  const double k_x = r.translation(0, 0), k_z = r.translation(2, 2);
  const Vector3d v = scene.velocity();
  const double expected =
      (k_z - k_x) * std::sin(f) * std::cos(f) / (k_x * std::cos(f) * std::cos(f) + k_z * std::sin(f) * std::sin(f));
  const double measured = std::abs(v.x() / v.z());
  EXPECT_NEAR(measured, expected, 1e-3 * expected); // Re near 1e-4 has its own share
  EXPECT_NEAR(scene.tilt(), f, 1e-12);
  EXPECT_LT(std::abs(v.y()), 1e-12 * v.norm());
}

/// A free disk in shear turns once in 4 pi/(rate sqrt(1 - B^2)): longer than a sphere, and not the ellipsoid's period.
TEST(Oriented, ADiskTumblesWithJefferysPeriod) {
  constexpr double rate = 10;
  Scene scene(
      "disk 48", 0, "1000",
      "timestep 2e-4\nfix mud all fluid/force rheology newtonian 2 density 1000 drag chien drag_torque dennis "
      "oriented on strain_torque jeffery buoyancy off\nfix flow all fluid/uniform velocity 0 0 0 velocity_gradient "
      "0 0 10 0 0 0 0 0 0 origin 0.05 0.05 0.2\n");
  const double period = scene.resistance().jeffery_period(1) / rate;
  EXPECT_NEAR(period * rate, 18.06, .05);
  // Over one period the angle changes by 2 pi; slowest where the disk lies in the flow.
  double before = scene.tilt(), turned = 0;
  int steps = 0;
  while (std::abs(turned) < 2 * M_PI && steps < 20000) {
    scene.run(20);
    steps += 20;
    double change = scene.tilt() - before;
    before = scene.tilt();
    change -= 2 * M_PI * std::round(change / (2 * M_PI));
    turned += change;
    if (std::abs(turned) > 2 * M_PI) { // the last stretch in part
      const double over = (std::abs(turned) - 2 * M_PI) / std::abs(change);
      EXPECT_NEAR((steps - 20 * over) * 2e-4, period, 3e-3 * period);
    }
  }
  EXPECT_GT(std::abs(turned), 2 * M_PI);
  EXPECT_LT(std::abs(scene.axis().y()), 1e-9); // it stays in the plane of shear
}

/// Above S = rho U^2 C'/(16 mu K_rot rate) of about 1 the pitching holds a disk that settles in a shear; below it
/// tumbles.
TEST(Oriented, SettlingHoldsADiskInShear) {
  for (const bool holds : {false, true}) {
    const double rate = holds ? .2 : 20;
    Scene scene("disk 48", .3, "2619",
                gravity() + "fix mud all fluid/force rheology newtonian 0.5 density 1000 drag schiller_naumann" +
                    kTorques +
                    " strain_torque jeffery\nvariable height atom z\nfix flow all fluid/uniform velocity 0 0 0 "
                    "velocity_gradient 0 0 " +
                    std::to_string(rate) + " 0 0 0 0 0 0 origin 0 0 v_height\n");
    double before = scene.tilt(), turned = 0;
    for (int n = 0; n < 60; ++n) {
      scene.run(50);
      double change = scene.tilt() - before;
      before = scene.tilt();
      turned += change - 2 * M_PI * std::round(change / (2 * M_PI));
    }
    EXPECT_EQ(std::abs(turned) < M_PI / 2, holds) << "rate " << rate << " turned " << turned;
  }
}

TEST(Oriented, ABodyInMudThatDoesNotYieldNeitherMovesNorTurns) {
  Scene scene("disk 19", .7, "2619",
              gravity() + "fix mud all fluid/force rheology herschel_bulkley 20 0.28 0.65 density 1000 drag chien" +
                  kTorques + " strain_torque jeffery\nfix flow all fluid/uniform velocity 0 0 0\n");
  const double tilt = scene.tilt();
  scene.run(200);
  EXPECT_EQ(scene.velocity(), Vector3d::Zero());
  EXPECT_EQ(scene.tilt(), tilt);
}

/// What the fluid receives is what the body lost, to the last digits, whatever the axes.
TEST(Oriented, MomentumIsExchangedExactly) {
  Scene scene("disk 48", .5, "2619",
              std::string("fix mud all fluid/force rheology herschel_bulkley 0.5 0.28 0.65 density 1000 drag "
                          "holzer_sommerfeld") +
                  kTorques + "\nfix flow all fluid/uniform velocity 0.3 0.1 0.2\n");
  scene.run(50);
  const int i = scene.session().local(1);
  if (i >= 0) {
    const auto received = FixFluidForce::find(&scene.session().lammps())->received(i);
    const double mass = scene.session().atom().rmass[i];
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(received[k], mass * scene.session().atom().v[i][k], 1e-12 * mass);
  }
  EXPECT_GT(scene.velocity().norm(), 1e-2);
}

/// One cluster of one sphere is a sphere: every bit.
TEST(Oriented, AClusterOfOneSphereIsASphere) {
  Vector3d speed[2];
  for (const bool oriented : {false, true}) {
    Scene scene("sphere 1", .4, "2619",
                gravity() + "fix mud all fluid/force rheology herschel_bulkley 0.5 0.28 0.65 density 1000 drag chien " +
                    (oriented ? "oriented on" : "") + "\nfix flow all fluid/uniform velocity 0.3 0.1 0.2\n");
    scene.run(100);
    speed[oriented] = scene.velocity();
  }
  EXPECT_EQ(speed[0], speed[1]);
}

} // namespace
