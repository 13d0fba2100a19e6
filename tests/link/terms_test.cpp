// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two sides that fit agree; each way of not fitting is refused with a sentence that names both values.
#include "link/terms.h"

#include "link/flow_quantities.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace eccentra::link;

struct Sides {
  DemTerms dem;
  FluidTerms fluid;

  Sides() {
    dem.time_step = 7.8125e-5;
    dem.interval = 64;
    dem.particles = 1000;
    dem.needed = eccentra::link::kVelocity;
    dem.fluid_density = 1000;
    fluid.time_step = 5e-3;
    fluid.offered = eccentra::link::kVelocity | eccentra::link::kFraction;
    fluid.fluid_density = 1000;
    for (int k = 0; k < 3; ++k) {
      dem.domain.low[k] = -0.065;
      dem.domain.high[k] = 0.065;
      fluid.domain.low[k] = -0.0635;
      fluid.domain.high[k] = 0.0635;
    }
    dem.domain.low[2] = fluid.domain.low[2] = 0;
    dem.domain.high[2] = fluid.domain.high[2] = 0.3;
    dem.domain.periodic[2] = fluid.domain.periodic[2] = true;
  }
  void expectRefusal(const char* part) const {
    const std::string text = disagreement(dem, fluid);
    EXPECT_NE(text.find(part), std::string::npos) << "said: '" << text << "'";
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
};

} // namespace

TEST(Terms, SidesThatFitAgree) {
  EXPECT_EQ(disagreement(Sides().dem, Sides().fluid), "");
}

TEST(Terms, RoundOffOfTheStepsIsNoDisagreement) {
  Sides sides;
  sides.fluid.time_step = 5e-3 * (1 + 1e-9);
  EXPECT_EQ(disagreement(sides.dem, sides.fluid), "");
}

TEST(Terms, OtherProtocolVersionIsRefused) {
  Sides sides;
  sides.dem.protocol = kProtocolVersion + 1;
  sides.expectRefusal("same release");
}

TEST(Terms, OtherLengthUnitIsRefused) {
  Sides sides;
  sides.dem.length_unit = 1e-2;
  sides.expectRefusal("one unit of length is 0.01 m in the DEM script but 1 m");
}

TEST(Terms, IntervalThatDoesNotMakeTheFluidStepIsRefused) {
  Sides sides;
  sides.dem.interval = 60;
  sides.expectRefusal("60 DEM steps of 7.8125e-05 s make 0.0046875 s but the fluid step (deltaT) is 0.005 s");
}

TEST(Terms, StepsThatAreNotPositiveNumbersAreRefused) {
  Sides sides;
  sides.dem.time_step = std::numeric_limits<double>::quiet_NaN();
  sides.expectRefusal("must be positive");
  sides = Sides();
  sides.fluid.time_step = 0;
  sides.expectRefusal("must be positive");
}

TEST(Terms, PeriodicOnOneSideOnlyIsRefused) {
  Sides sides;
  sides.fluid.domain.periodic[2] = false;
  sides.expectRefusal("direction z is periodic in the DEM script but not periodic in the mesh");
}

TEST(Terms, OtherPeriodicLengthIsRefused) {
  Sides sides;
  sides.fluid.domain.high[2] = 0.31;
  sides.expectRefusal("the periodic direction z spans 0 to 0.3 m in the DEM script but 0 to 0.31 m in the mesh");
}

TEST(Terms, MillimetresForMetresAreRefused) {
  Sides sides;
  for (int k = 0; k < 2; ++k) {
    sides.dem.domain.low[k] *= 1000;
    sides.dem.domain.high[k] *= 1000;
  }
  sides.expectRefusal("another place or another length unit");
}

TEST(Terms, QuantityThatNobodyOffersIsRefused) {
  Sides sides;
  sides.dem.needed |= eccentra::link::kVorticity;
  sides.expectRefusal("does not offer");
}

TEST(Terms, OtherFluidDensityIsRefused) {
  Sides sides;
  sides.fluid.fluid_density = 1030;
  sides.expectRefusal("1000 kg/m3 in fix fluid/force but 1030 kg/m3");
}

TEST(Terms, OtherRheologyIsRefused) {
  Sides sides;
  sides.dem.rheology = {1, 0.28, 0.65};
  sides.fluid.rheology = {1, 0.28, 0.56};
  sides.expectRefusal("tau0 1 Pa, k 0.28 Pa s^n, n 0.65 in fix fluid/force but tau0 1, k 0.28, n 0.56");
  sides.fluid.rheology = {2, 0.28, 0.65};
  sides.expectRefusal("tau0 2");
  sides.fluid.rheology = {1, 0.3, 0.65};
  sides.expectRefusal("k 0.3");
}

TEST(Terms, RheologyThatOneSideCannotStateIsNotCompared) {
  Sides sides;
  sides.dem.rheology = {1, 0.28, 0.65};
  EXPECT_EQ(disagreement(sides.dem, sides.fluid), "");
}

TEST(Terms, OtherGravityIsRefused) {
  Sides sides;
  sides.fluid.has_gravity = true;
  sides.fluid.gravity[1] = -9.81;
  sides.expectRefusal("gravity is (0 0 0) m/s2 in the DEM script (fix gravity) but (0 -9.81 0) in constant/g");
  sides.dem.gravity[2] = -9.81;
  sides.expectRefusal("gravity is (0 0 -9.81)");
  sides.fluid.has_gravity = false;
  EXPECT_EQ(disagreement(sides.dem, sides.fluid), "");
}

TEST(Terms, GravityTypedWithFewDigitsAgrees) {
  Sides sides;
  sides.fluid.has_gravity = true;
  sides.fluid.gravity[1] = -9.81 * 0.98480775;
  sides.fluid.gravity[2] = -9.81 * 0.17364818;
  sides.dem.gravity[1] = -9.66;
  sides.dem.gravity[2] = -1.703;
  EXPECT_EQ(disagreement(sides.dem, sides.fluid), "");
}
