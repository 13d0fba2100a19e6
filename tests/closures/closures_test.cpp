// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Closures as pure functions: reference values, limits, slopes, signs and invariances.
#include "closures/drag_laws.h"
#include "closures/implicit_step.h"
#include "closures/lift_laws.h"
#include "closures/rotational_drag.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace eccentra::closures;
using namespace eccentra::link;
using namespace eccentra::base;
using Eigen::Vector3d;

namespace {

constexpr double kD = 6.35e-3;
constexpr double kReference = 1e-9; ///< relative, of values computed in high precision

void expect_relative(double value, double reference, double tolerance = kReference) {
  EXPECT_NEAR(value, reference, tolerance * std::abs(reference));
}

Rheology paper_fluid(double yield_stress) {
  return {yield_stress, 0.28, 0.65, 1000.0};
}

template <class Law> double drag_coefficient(double re, double phi, double fraction = 1.0, double crosswise = 1.0) {
  return Law(ShapeFactors{phi}).in(DragPlace{fraction, crosswise})(re).value / re;
}

template <class Law> double drag_force(const Rheology& fluid, double speed, double phi, double fraction) {
  const auto law = Law(ShapeFactors{phi}).in(DragPlace{fraction, 1.0});
  const Resistance<HerschelBulkleyStress, std::decay_t<decltype(law)>> drag{
      HerschelBulkleyStress(fluid), law, kPi / 8.0 * kD * kD, 1.0 / kD, fluid.density};
  return speed > 0.0 ? drag(speed).value : drag.at_rest();
}

TEST(Reynolds, HerschelBulkleyReferences) {
  const Rheology fluid = paper_fluid(1.0);
  expect_relative(reynolds_power_law(fluid, .1, kD), 5.95175287078);
  expect_relative(bingham(fluid, .1, kD), .595175287078);
  expect_relative(reynolds_herschel_bulkley(fluid, .1, kD), 3.85137520625);
  expect_relative(reynolds_power_law(fluid, .3, kD), 26.2276019565);
  expect_relative(bingham(fluid, .3, kD), .291417799517);
  expect_relative(reynolds_herschel_bulkley(fluid, .3, kD), 20.7001373274);
  expect_relative(reynolds_power_law(fluid, 1e-3, kD), .0118753082111);
  expect_relative(bingham(fluid, 1e-3, kD), 11.8753082111);
  expect_relative(reynolds_herschel_bulkley(fluid, 1e-3, kD), 9.99494058e-4, 1e-8);
  EXPECT_EQ(reynolds_herschel_bulkley(fluid, 0.0, kD), 0.0);
}

TEST(Reynolds, ViscosityOfTheParticleIsThatOfTheNumber) {
  for (const double speed : {1e-3, .1, .3}) {
    const Rheology fluid = paper_fluid(1.0);
    expect_relative(particle_viscosity(fluid, speed, kD),
                    fluid.density * speed * kD / reynolds_herschel_bulkley(fluid, speed, kD), 1e-14);
  }
}

TEST(Rheology, IsNewtonianWithoutYieldAndWithIndexOneOnly) {
  EXPECT_TRUE((Rheology{0.0, 0.28, 1.0, 1000.0}.newtonian()));
  EXPECT_FALSE((Rheology{1.0, 0.28, 1.0, 1000.0}.newtonian()));
  EXPECT_FALSE((Rheology{0.0, 0.28, 0.65, 1000.0}.newtonian()));
}

TEST(Sphere, VolumeReference) {
  expect_relative(sphere_volume(kD / 2), 1.34066353845e-7);
}

TEST(Chien, References) {
  using Law = Suspended<Chien>;
  expect_relative(drag_coefficient<Law>(1, 1), 30.4399900245);
  expect_relative(drag_coefficient<Law>(10, 1), 3.43999002448);
  expect_relative(drag_coefficient<Law>(100, 1), .739990024482);
  expect_relative(drag_coefficient<Law>(1000, 1), .469990024482);
  expect_relative(drag_coefficient<Law>(100, .98), .786556025353);
  expect_relative(drag_coefficient<Law>(100, .85), 1.23565989932);
  expect_relative(drag_coefficient<Law>(100, .79), 1.56528421906);
  expect_relative(drag_force<Law>(paper_fluid(0), .1, 1, 1), 8.67819197171e-4);
  expect_relative(drag_force<Law>(paper_fluid(0), .1, 1, .7), 1.56321058444e-3);
  expect_relative(drag_force<Law>(paper_fluid(0), .1, 1, .4), 3.93577504117e-3);
}

TEST(Chien, YieldForceAtRestIsFinite) {
  // F(U -> 0) = 30 (7 pi/24) (pi/8) tau0 d^2
  expect_relative(drag_force<Suspended<Chien>>(paper_fluid(2.0), 0.0, 1, 1), 10.7948798137 * 2.0 * kD * kD);
  expect_relative(drag_force<Suspended<SchillerNaumann>>(paper_fluid(2.0), 0.0, 1, 1), 8.63590 * 2.0 * kD * kD, 1e-6);
  const double near = drag_force<Suspended<Chien>>(paper_fluid(2.0), 1e-30, 1, 1);
  expect_relative(near, drag_force<Suspended<Chien>>(paper_fluid(2.0), 0.0, 1, 1), 1e-12);
  EXPECT_EQ(drag_force<Suspended<Chien>>(paper_fluid(0.0), 0.0, 1, 1), 0.0);
}

TEST(Chien, IsOneAndAQuarterTimesStokesAtLowReynolds) {
  const Rheology oil{0.0, 10.0, 1.0, 1000.0};
  const double stokes = 3.0 * kPi * 10.0 * kD * 1e-6;
  expect_relative(drag_force<Suspended<Chien>>(oil, 1e-6, 1, 1), 1.25 * stokes, 1e-7);
}

TEST(DragLaws, StokesLimits) {
  constexpr double re = 1e-9;
  EXPECT_NEAR(drag_coefficient<Suspended<SchillerNaumann>>(re, 1) * re, 24.0, 1e-4);
  EXPECT_NEAR(drag_coefficient<Suspended<HaiderLevenspiel>>(re, 0.8) * re, 24.0, 1e-3);
  EXPECT_NEAR(drag_coefficient<Suspended<Ganser>>(re, 1) * re, 24.0, 1e-3);
  EXPECT_NEAR(drag_coefficient<Suspended<HoelzerSommerfeld>>(re, 1) * re, 24.0, 1e-3);
  EXPECT_NEAR(drag_coefficient<DiFelice>(re, 1) * re, 4.8 * 4.8, 1e-3);
}

// Published formulas at one point each, worked out by hand from the printed coefficients in plain C_D form.
TEST(DragLaws, PublishedFormulas) {
  const double re = 57.0;
  expect_relative(drag_coefficient<Suspended<SchillerNaumann>>(re, 1), 24 / re * (1 + .15 * std::pow(re, .687)));
  EXPECT_DOUBLE_EQ(drag_coefficient<Suspended<SchillerNaumann>>(5000, 1), .44);
  const double phi = .79;
  const double a = std::exp(2.3288 - 6.4581 * phi + 2.4486 * phi * phi), b = .0964 + .5565 * phi;
  const double c = std::exp(4.905 - 13.8944 * phi + 18.4222 * phi * phi - 10.2599 * phi * phi * phi);
  const double d = std::exp(1.4681 + 12.2584 * phi - 20.7322 * phi * phi + 15.8855 * phi * phi * phi);
  expect_relative(drag_coefficient<Suspended<HaiderLevenspiel>>(re, phi),
                  24 / re * (1 + a * std::pow(re, b)) + c / (1 + d / re));
  const double k1 = 1 / (1. / 3 + 2. / 3 / std::sqrt(phi)),
               k2 = std::pow(10, 1.8148 * std::pow(-std::log10(phi), .5743));
  const double r = re * k1 * k2;
  expect_relative(drag_coefficient<Suspended<Ganser>>(re, phi),
                  k2 * (24 / r * (1 + .1118 * std::pow(r, .6567)) + .4305 / (1 + 3305 / r)));
  const double perp = .7;
  expect_relative(drag_coefficient<Suspended<HoelzerSommerfeld>>(re, phi, 1, perp),
                  8 / re / std::sqrt(perp) + 16 / re / std::sqrt(phi) + 3 / std::sqrt(re) / std::pow(phi, .75) +
                      .42 * std::pow(10, .4 * std::pow(-std::log10(phi), .2)) / perp);
}

TEST(DragLaws, SuspensionsInModelA) {
  const double re = 57.0, f = .7;
  const double wen_yu = 24 / (f * re) * (1 + .15 * std::pow(f * re, .687)) * std::pow(f, -1.65);
  expect_relative(drag_coefficient<Suspended<SchillerNaumann, true>>(re, 1, f), wen_yu);
  expect_relative(drag_coefficient<Gidaspow>(re, 1, .81),
                  drag_coefficient<Suspended<SchillerNaumann, true>>(re, 1, .81));
  // Ergun, beta Vp/(1-a) U = (pi/8) C_D rho d^2 U^2 with mu = rho U d/Re
  expect_relative(drag_coefficient<Gidaspow>(re, 1, .45), 4. / 3 * (150 * .55 / .45 / re + 1.75));
  const double cd = std::pow(.63 + 4.8 / std::sqrt(f * re), 2);
  const double chi = 3.7 - .65 * std::exp(-std::pow(1.5 - std::log10(f * re), 2) / 2);
  expect_relative(drag_coefficient<DiFelice>(re, 1, f), cd * f * f * std::pow(f, -chi));
}

template <class Law> void expect_true_slope(double fraction) {
  const auto law = Law(ShapeFactors{.8}).in(DragPlace{fraction, .9});
  for (const double re : {1e-3, .1, 3., 40., 700., 4000.}) {
    const double h = 1e-5 * re;
    const double slope = (law(re + h).value - law(re - h).value) / (2 * h);
    EXPECT_NEAR(law(re).slope, slope, 1e-5 * std::abs(slope) + 1e-12 * law(re).value / h) << "Re " << re;
  }
}

TEST(DragLaws, SlopesAreDerivatives) {
  for (const double fraction : {1.0, .6}) {
    expect_true_slope<Suspended<Chien>>(fraction);
    expect_true_slope<Suspended<Chien, true>>(fraction);
    expect_true_slope<Suspended<SchillerNaumann, true>>(fraction);
    expect_true_slope<Suspended<HaiderLevenspiel>>(fraction);
    expect_true_slope<Suspended<Ganser>>(fraction);
    expect_true_slope<Suspended<HoelzerSommerfeld>>(fraction);
    expect_true_slope<Gidaspow>(fraction);
    expect_true_slope<DiFelice>(fraction);
  }
}

TEST(Resistance, SlopeIsTheDerivative) {
  const Rheology fluid = paper_fluid(1.0);
  const auto law = Suspended<Chien>(ShapeFactors{.85}).in(DragPlace{.7, 1.0});
  const Resistance<HerschelBulkleyStress, std::decay_t<decltype(law)>> drag{HerschelBulkleyStress(fluid), law,
                                                                            kPi / 8 * kD * kD, 1.0 / kD, 1000.0};
  const Resistance<SpinStress<HerschelBulkleyStress>, Dennis> torque{
      {HerschelBulkleyStress(fluid), 3.0}, Dennis(), kD * kD * kD / 64, 1.0, 1000 * kD * kD};
  for (const double u : {1e-6, 1e-3, .1, 2.}) {
    const double h = 1e-5 * u;
    expect_relative(drag(u).slope, (drag(u + h).value - drag(u - h).value) / (2 * h), 1e-4);
    expect_relative(torque(100 * u).slope, (torque(100 * (u + h)).value - torque(100 * (u - h)).value) / (200 * h),
                    1e-4);
  }
}

TEST(ImplicitSlip, SolvesTheStepForAnyStiffness) {
  for (const double yield : {0.0, 1.0})
    for (const double index : {0.3, 0.65, 1.0, 1.5})
      for (const double compliance : {1e-8, 1e-3, 1.0, 1e3, 1e9})
        for (const double free : {1e-12, 1e-5, .3, 40.0})
          for (const double guess : {0.0, 1e-9, .3}) {
            const Rheology fluid{yield, 0.28, index, 1000.0};
            const auto law = Suspended<Chien>(ShapeFactors{}).in(DragPlace{});
            const Resistance<HerschelBulkleyStress, std::decay_t<decltype(law)>> drag{
                HerschelBulkleyStress(fluid), law, kPi / 8 * kD * kD, 1.0 / kD, 1000.0};
            const ImplicitSlip step = implicit_slip(drag, free, compliance, guess);
            EXPECT_GE(step.speed, 0.0);
            EXPECT_LE(step.speed, free);
            EXPECT_NEAR(step.speed + compliance * step.resistance, free, 1e-12 * free);
            if (step.speed > 0.0)
              expect_relative(step.resistance, drag(step.speed).value, 1e-6);
            else
              EXPECT_LE(step.resistance, std::max(drag.at_rest(), drag(1e-100).value) * (1 + 1e-12));
          }
}

TEST(Dennis, References) {
  expect_relative(Dennis::coefficient(1), 201.06192983);
  expect_relative(Dennis::coefficient(10), 20.106192983);
  expect_relative(Dennis::coefficient(std::nextafter(32.0, 0.0)), 6.28318530718);
  expect_relative(Dennis::coefficient(32), 6.29291936933);
  expect_relative(Dennis::coefficient(100), 2.574);
  EXPECT_DOUBLE_EQ(Dennis::coefficient(5000), Dennis::coefficient(1000));
}

TEST(Dennis, IsKirchhoffsTorqueAtLowSpin) {
  const Rheology oil{0.0, .1, 1.0, 1000.0};
  const Resistance<SpinStress<NewtonianStress>, Dennis> torque{
      {NewtonianStress(oil), 0.0}, Dennis(), kD * kD * kD / 64, 1.0, 1000 * kD * kD};
  expect_relative(torque(10.0).value, 8.04398123067e-7);
  expect_relative(torque(10.0).value, kPi * .1 * kD * kD * kD * 10.0, 1e-12);
}

TEST(SpinStress, YieldHoldsTheSpinOnlyWhereNothingSlips) {
  const HerschelBulkleyStress stress(paper_fluid(1.0));
  EXPECT_EQ((SpinStress<HerschelBulkleyStress>{stress, 0.0}.at_rest()), kAnsleySmith);
  EXPECT_EQ((SpinStress<HerschelBulkleyStress>{stress, 0.1}.at_rest()), 0.0);
}

TEST(Mei, References) {
  // (Re_p, Re_s)
  expect_relative(Mei::factor(.2, 1), .914810255039);
  expect_relative(saffman_mei_coefficient(.2, 1), 8.41264374055);
  expect_relative(Mei::factor(2, 10), .434124336689);
  expect_relative(saffman_mei_coefficient(2, 10), 1.26245412614);
  expect_relative(Mei::factor(8, 40), .12119408039);
  EXPECT_NEAR(Mei::factor(8, std::nextafter(40.0, 50.0)), .1048, 1e-9);
  expect_relative(Mei::factor(20, 100), .165703349393);
  EXPECT_NEAR(saffman_mei_coefficient(20, 100), .152381681, 1e-9);
  EXPECT_DOUBLE_EQ(Mei::factor(1e9, 1), Mei::factor(2 * Mei::kHighestBeta, 1));
}

TEST(Mei, TendsToSaffman) {
  const double mu = 10.0, rho = 1000.0, w = 2.0;
  const double slip[3] = {1e-9, 0, 0}, vorticity[3] = {0, 0, -w};
  double f[3];
  shear_lift_force(rho, mu, 1e-3, slip, vorticity, f);
  expect_relative(f[1], kPi / 8 * 4.1126 * 1e-6 * std::sqrt(rho * mu / w) * 1e-9 * w, 1e-6);
}

TEST(OesterleBuiDinh, References) {
  // (Re_r, Re_p)
  expect_relative(OesterleBuiDinh::coefficient(1, 10), .13752563166);
  expect_relative(OesterleBuiDinh::coefficient(10, 10), .863659617059);
  expect_relative(OesterleBuiDinh::coefficient(100, 100), .581915561271);
  expect_relative(OesterleBuiDinh::coefficient(1e-4, 1e-3), .100062904698);
}

TEST(OesterleBuiDinh, TendsToRubinowAndKeller) {
  const double mu = 1e3, rho = 1000.0, d = 1e-3;
  const double slip[3] = {1e-6, 0, 0}, spin[3] = {0, 0, .01};
  double f[3];
  rotational_lift_force(rho, mu, d, slip, spin, f);
  expect_relative(f[1], kPi / 8 * rho * d * d * d * .01 * 1e-6, 1e-3);
}

TEST(Lift, IsZeroWithoutShearSpinOrSlip) {
  const double zero[3] = {0, 0, 0}, some[3] = {.1, .2, .3};
  for (auto* law : {&shear_lift_force, &rotational_lift_force}) {
    double f[3] = {1, 1, 1};
    (*law)(1000, .1, kD, zero, some, f);
    EXPECT_EQ(norm(f), 0.0);
    (*law)(1000, .1, kD, some, zero, f);
    EXPECT_EQ(norm(f), 0.0);
  }
}

TEST(Lift, LaggingParticleIsDrivenToTheFasterSide) {
  // u_f = (G y, 0, 0): vorticity (0, 0, -G), the faster side is +y.
  const double slip[3] = {.1, 0, 0}, vorticity[3] = {0, 0, -5};
  double f[3];
  shear_lift_force(1000, .1, kD, slip, vorticity, f);
  EXPECT_GT(f[1], 0.0);
  // omega_p = +5 about z, moving to +x through fluid at rest: Magnus lift omega_p x v is along +y.
  const double still[3] = {-.1, 0, 0}, spin[3] = {0, 0, -5};
  rotational_lift_force(1000, .1, kD, still, spin, f);
  EXPECT_GT(f[1], 0.0);
}

TEST(Lift, TurnsWithTheFrame) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vector3d(1, -2, .5).normalized()));
  const Vector3d slip(.1, -.05, .2), vorticity(3, 1, -2);
  for (auto* law : {&shear_lift_force, &rotational_lift_force}) {
    Vector3d f, turned;
    (*law)(1000, .1, kD, slip.data(), vorticity.data(), f.data());
    const Vector3d turned_slip = turn * slip, turned_vorticity = turn * vorticity;
    (*law)(1000, .1, kD, turned_slip.data(), turned_vorticity.data(), turned.data());
    EXPECT_NEAR((turned - turn * f).norm(), 0.0, 1e-13 * f.norm());
  }
}

} // namespace
