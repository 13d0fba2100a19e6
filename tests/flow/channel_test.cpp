// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Plane channel: Herschel-Bulkley profile and plug, and the order of the time scheme.
#include "flow/flow_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eccentra::test {
namespace {

constexpr double kHalfGap = 0.019685, kConsistency = 0.28, kIndex = 0.65;

struct ChannelFlow {
  double tau0, gradient;
  double velocity(double from_middle) const {
    const double y0 = tau0 / gradient, m = 1 + 1 / kIndex;
    const double shear = std::max(from_middle - y0, 0.0);
    return kIndex / (kIndex + 1) * std::pow(gradient / kConsistency, 1 / kIndex) *
           (std::pow(kHalfGap - y0, m) - std::pow(shear, m));
  }
};

TEST(Channel, HerschelBulkleyProfileAndPlug) {
  const struct {
    ChannelFlow flow;
    double peak, mean;
  } references[] = {
      {{0, 100}, .155814176, .111779735}, {{1, 200}, .215120448, .169767477}, {{2, 300}, .295653254, .240396146}};
  for (const auto& r : references) {
    ASSERT_NEAR(r.flow.velocity(0), r.peak, 1e-9);
    FlowCase flow_case("channel");
    flow_case.control({{"deltaT", "1000"}, {"endTime", "1e7"}});
    flow_case.channel_mesh(2 * kHalfGap, 1, 40);
    flow_case.channel_fields();
    flow_case.fluid("HerschelBulkleyCapped", 1000,
                    "tau0 " + std::to_string(r.flow.tau0) + "; k 0.28; n 0.65; muY 100;");
    flow_case.drive("type pressureGradient; direction (1 0 0); gradient " + std::to_string(r.flow.gradient) + ";");
    const double mean = flow_case.steady([&] { return mean_velocity(flow_case.flow(), 0); }, 1e-7, 400);
    EXPECT_NEAR(mean, r.mean, 0.005 * r.mean) << "tau0 " << r.flow.tau0;
    const double plug = r.flow.tau0 / r.flow.gradient, cell = kHalfGap / 20;
    forAll(flow_case.flow().U(), celli) {
      const double y = std::abs(flow_case.mesh().C()[celli].y() - kHalfGap);
      EXPECT_NEAR(flow_case.flow().U()[celli].x(), r.flow.velocity(y), 0.005 * r.peak) << "y " << y;
      const double mu = 1000 * flow_case.flow().rheology().nu()()[celli];
      if (r.flow.tau0 > 0 && std::abs(y - plug) > cell) {
        EXPECT_EQ(mu > 0.999 * 100, y < plug) << "plug of half-width " << plug << " at y " << y << ", mu " << mu;
      }
    }
  }
}

/// Mean velocity at t = 0.4 s of a fluid that a gradient growing as t^2 sets in motion.
double started(double step, const std::string& model, const std::string& coefficients, int outer) {
  FlowCase flow_case("started");
  flow_case.control({{"deltaT", std::to_string(step)}, {"endTime", "1e6"}});
  flow_case.numerics("backward", "nCorrectors 2; consistent yes; nOuterCorrectors " + std::to_string(outer) + ";");
  flow_case.channel_mesh(2 * kHalfGap, 1, 20);
  flow_case.channel_fields();
  flow_case.fluid(model, 1000, coefficients);
  flow_case.drive("type pressureGradient; direction (1 0 0); gradient polynomial ((1000 2));");
  flow_case.advance(int(std::lround(0.4 / step)));
  return mean_velocity(flow_case.flow(), 0);
}

double order_in_time(const std::string& model, const std::string& coefficients, int outer) {
  const double coarse = started(0.02, model, coefficients, outer);
  const double middle = started(0.01, model, coefficients, outer);
  const double fine = started(0.005, model, coefficients, outer);
  return std::log2((coarse - middle) / (middle - fine));
}

TEST(Refinement, SecondOrderInTime) {
  EXPECT_NEAR(order_in_time("Newtonian", "nu 1e-3;", 1), 2, 0.25);
  // The viscosity of a step is that of the extrapolated velocity; further outer correctors find the same order.
  for (const int outer : {1, 6}) {
    for (const char* fluid :
         {"tau0 0; k 3; n 0.65; muY 10;", "tau0 0.3; k 3; n 0.65; muY 10;", "tau0 0; k 3; n 1.4; muY 1000;"}) {
      EXPECT_NEAR(order_in_time("HerschelBulkleyCapped", fluid, outer), 2, 0.35)
          << fluid << " outer correctors " << outer;
    }
  }
}

/// Periodic channel, two cells along it, whose fluid shears at 18,600 1/s at the wall: its Courant number is 3e6.
struct FastChannel {
  FlowCase flow_case{"fast"};
  static constexpr double kGap = 0.02, kGradient = 400;
  explicit FastChannel(const std::string& pimple) {
    flow_case.control({{"deltaT", "1000"}, {"endTime", "1e7"}});
    flow_case.numerics("backward", pimple);
    flow_case.channel_mesh(kGap, 2, 80);
    flow_case.channel_fields();
    flow_case.fluid("HerschelBulkleyCapped", 1000, "tau0 2; k 0.28; n 0.2; muY 2800;");
    flow_case.drive("type pressureGradient; direction (1 0 0); gradient " + std::to_string(kGradient) + ";");
  }
};

TEST(HugeSteps, ConvergeWithCentralDifferencesWhereConvectionOutweighsViscosity) {
  FastChannel channel("nCorrectors 1; consistent yes;");
  const double wall = FastChannel::kGradient * FastChannel::kGap / 2, n = 0.2, rest = 1 - 2 / wall;
  const double mean = n / (n + 1) * FastChannel::kGap / 2 * std::pow(wall / 0.28, 1 / n) * std::pow(rest, 1 + 1 / n) *
                      (1 - n / (2 * n + 1) * rest);
  ASSERT_NEAR(mean, 14.4, 0.1);
  channel.flow_case.advance(200);
  EXPECT_NEAR(mean_velocity(channel.flow_case.flow(), 0), mean, 0.03 * mean);
}

TEST(HugeSteps, ABlownUpFlowEndsWithOneSentence) {
  // PISO without the consistent correction is no method for such steps.
  FastChannel channel("nCorrectors 1; consistent no;");
  try {
    channel.flow_case.advance(200);
    FAIL() << "expected to blow up";
  } catch (const std::exception& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("blown up at t = "), std::string::npos) << text;
    EXPECT_NE(text.find("reduce deltaT"), std::string::npos) << text;
  }
}

} // namespace
} // namespace eccentra::test
