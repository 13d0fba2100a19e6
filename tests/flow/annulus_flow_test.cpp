// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Developed flow through concentric and eccentric annuli against closed forms and semi-analytic values.
#include "flow/flow_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eccentra::test {
namespace {

// A step so long that each one is a Picard iteration of the steady problem.
const char* const kLongStep = "1000";
constexpr double kSteady = 5e-6;

std::string herschel_bulkley(double tau0, double mu_y) {
  return "tau0 " + std::to_string(tau0) + "; k 0.28; n 0.65; muY " + std::to_string(mu_y) + ";";
}

struct AnnulusCase {
  double eccentricity;
  int radial, around;
  std::string drive;
  double tau0 = 0;
  double mu_y = 100;
};

/// Makes the case; Newtonian of 0.1 Pa s if tau0 < 0.
std::unique_ptr<FlowCase> make(const std::string& name, const AnnulusCase& annulus) {
  auto flow_case = std::make_unique<FlowCase>(name);
  flow_case->control({{"deltaT", kLongStep}, {"endTime", "1e6"}});
  flow_case->annulus_mesh(annulus.eccentricity, annulus.radial, annulus.around, 1);
  flow_case->annulus_fields(annulus.eccentricity);
  if (annulus.tau0 < 0) {
    flow_case->newtonian(1000, 0.1);
  } else {
    flow_case->fluid("HerschelBulkleyCapped", 1000, herschel_bulkley(annulus.tau0, annulus.mu_y));
  }
  flow_case->drive(annulus.drive);
  return flow_case;
}

double mean_at_gradient(const std::string& name, AnnulusCase annulus, double gradient) {
  annulus.drive = "type pressureGradient; gradient " + std::to_string(gradient) + ";";
  auto flow_case = make(name, annulus);
  return flow_case->steady([&] { return mean_velocity(flow_case->flow()); }, kSteady, 400);
}

double gradient_at_mean(const std::string& name, AnnulusCase annulus, double mean) {
  annulus.drive = "type meanVelocity; Ubar " + std::to_string(mean) + ";";
  auto flow_case = make(name, annulus);
  const double G = flow_case->steady([&] { return flow_case->flow().drivingPressureGradient(); }, kSteady, 400);
  EXPECT_NEAR(mean_velocity(flow_case->flow()), mean, 1e-10);
  return G;
}

TEST(ConcentricAnnulus, PressureGradientAtGivenMeanVelocity) {
  // Semi-analytic: tau(r) = G/2 (r - L2/r).
  const struct {
    double tau0, mean, gradient;
  } references[] = {{0, 0.58, 287.398291}, {0, 1.165, 452.238818}, {1, 0.58, 356.700191}, {1, 1.165, 521.874884}};
  for (const auto& r : references) {
    const double G = gradient_at_mean("concentric", {0, 20, 48, "", r.tau0}, r.mean);
    EXPECT_NEAR(G, r.gradient, 0.01 * r.gradient) << "tau0 " << r.tau0 << ", mean " << r.mean;
  }
}

TEST(EccentricAnnulus, NewtonianIsPiercysSolution) {
  const double mean = mean_at_gradient("piercy", {0.5, 20, 64, "", -1}, 100);
  EXPECT_NEAR(mean, 0.173849229, 0.005 * 0.173849229);
}

TEST(EccentricAnnulus, PowerLawAndYieldStressRatios) {
  // Ratio to the concentric annulus at the same gradient (Richardson-extrapolated, semi-analytic), and that annulus'
  // exact mean.
  const struct {
    const char* name;
    double tau0, gradient, ratio, concentric;
  } references[] = {{"power_law", 0, 227.2, 1.4354, 0.404006}, {"yield", 1, 200, 1.559, 0.174667}};
  for (const auto& r : references) {
    const double mean = mean_at_gradient(r.name, {0.5, 20, 64, "", r.tau0}, r.gradient);
    EXPECT_NEAR(mean / r.concentric, r.ratio, 0.015 * r.ratio) << r.name;
  }
}

TEST(YieldOnset, FlowStartsWhereTheWallStressReachesTheYieldStress) {
  // At G = 2 tau0/(Ro - Ri) = 50.80 tau0 both walls of the concentric annulus yield; at three quarters of it none does,
  // and the mud creeps as a Newtonian fluid of muY (U = 0.131116528122 m/s at 0.1 Pa s and 100 Pa/m).
  const double tau0 = 1, onset = 50.80, mu_y = 100;
  const double gradient = 0.75 * onset;
  const double creep = mean_at_gradient("below", {0, 20, 32, "", tau0, mu_y}, gradient);
  EXPECT_NEAR(creep, 0.131116528122 * (0.1 / mu_y) * (gradient / 100), 0.01 * creep);
  EXPECT_LT(mean_at_gradient("onset", {0, 20, 32, "", tau0, mu_y}, 0.98 * onset), 3 * creep);
  EXPECT_GT(mean_at_gradient("above", {0, 20, 32, "", tau0, mu_y}, 1.3 * onset), 30 * creep);
}

TEST(ViscosityRatio, ConvergesFromAHundredToAMillion) {
  const double exact = 0.58, gradient = 356.700191;
  for (const double ratio : {1e2, 1e4, 1e6}) {
    const double mean = mean_at_gradient("ratio", {0, 20, 32, "", 1, ratio * 0.28}, gradient);
    EXPECT_NEAR(mean, exact, 0.01 * exact) << "mu_y/k = " << ratio;
  }
}

TEST(Refinement, SecondOrderInSpace) {
  const double exact = 0.173849229; // Piercy
  double error[3];
  for (int level = 0; level < 3; ++level) {
    const int factor = 1 << level;
    error[level] = mean_at_gradient("refined", {0.5, 5 * factor, 16 * factor, "", -1}, 100) - exact;
  }
  for (int level = 0; level < 2; ++level) {
    const double order = std::log2(std::abs(error[level] / error[level + 1]));
    EXPECT_GT(order, 1.8);
    EXPECT_LT(order, 2.3);
  }
}

} // namespace
} // namespace eccentra::test
