// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Effects are composed at set-up: what is off is not there, and composing changes no number.
#include "closures/fluid_options.h"
#include "link/flow_quantities.h"

#include "hand_written_drag.h"
#include "particle_arrays.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace eccentra::closures;
using namespace eccentra::link;
using eccentra::test::ParticleArrays;

namespace {

EffectList effects_of(const std::string& arguments) {
  std::istringstream stream("rheology herschel_bulkley 1 0.28 0.65 density 1000 " + arguments);
  std::vector<std::string> list;
  for (std::string word; stream >> word;)
    list.push_back(word);
  return make_effects(read_fluid_options(list, 1));
}

unsigned needs_of(const EffectList& effects) {
  unsigned needs = 0;
  for (const auto& effect : effects)
    needs |= effect->needs();
  return needs;
}

TEST(Composition, WhatIsOffDoesNotExist) {
  EXPECT_TRUE(effects_of("buoyancy off").empty());
  EXPECT_EQ(effects_of("").size(), 1U); // buoyancy
  EXPECT_EQ(needs_of(effects_of("")), 0U);
  EXPECT_EQ(effects_of("drag none shear_lift none rotational_lift none drag_torque none buoyancy off").size(), 0U);
}

TEST(Composition, AsksTheFluidForWhatItReadsAndNoMore) {
  EXPECT_EQ(needs_of(effects_of("drag chien")), unsigned(kVelocity | kFraction));
  EXPECT_EQ(needs_of(effects_of("pressure_gradient on")), unsigned(kPressureGradient));
  EXPECT_EQ(needs_of(effects_of("viscous_stress on")), unsigned(kStressDivergence));
  EXPECT_EQ(needs_of(effects_of("shear_lift saffman_mei")), unsigned(kVelocity | kVorticity));
  EXPECT_EQ(needs_of(effects_of("rotational_lift oesterle_bui_dinh")), unsigned(kVelocity | kVorticity));
  EXPECT_EQ(needs_of(effects_of("drag_torque dennis")), unsigned(kVelocity | kVorticity));
  EXPECT_EQ(needs_of(effects_of("drag_torque dennis rheology newtonian 1")), unsigned(kVorticity));
}

/// As the sources give them; what a run warns by.
TEST(Composition, StatesTheRangesOfTheSources) {
  struct Range {
    const char* arguments;
    Number number;
    double low, high;
  };
  const Range ranges[] = {{"drag chien", kReynolds, 1e-3, 1e4},
                          {"drag schiller_naumann", kReynolds, 0, 2e5},
                          {"drag haider_levenspiel", kReynolds, 0, 2.5e4},
                          {"drag ganser", kReynolds, 0, 1e5},
                          {"drag holzer_sommerfeld", kReynolds, 0, 1e5},
                          {"shear_lift saffman_mei", kReynolds, 0, 100},
                          {"shear_lift saffman_mei", kShearParameter, .005, .4},
                          {"rotational_lift oesterle_bui_dinh", kReynolds, 10, 140},
                          {"rotational_lift oesterle_bui_dinh", kSpinParameter, 1, 6},
                          {"drag_torque dennis", kSpinReynolds, 0, 1000}};
  for (const Range& range : ranges) {
    bool stated = false;
    for (const auto& effect : effects_of(std::string("buoyancy off ") + range.arguments))
      for (const Validity& validity : effect->validity())
        stated =
            stated || (validity.number == range.number && validity.low == range.low && validity.high == range.high);
    EXPECT_TRUE(stated) << range.arguments << ": " << kNumberNames[range.number];
  }
}

TEST(Composition, DragIsTheHandWrittenLoop) {
  ParticleArrays composed(500), by_hand(500);
  const EffectList effects = effects_of("drag chien buoyancy off");
  ASSERT_EQ(effects.size(), 1U);
  effects[0]->prepare(composed);
  effects[0]->apply(composed.half_step());
  eccentra::test::hand_written_drag(by_hand.half_step(), {1.0, 0.28, 0.65, 1000.0});
  for (std::size_t k = 0; k < composed.forces().size(); ++k)
    EXPECT_NEAR(composed.forces()[k], by_hand.forces()[k], 1e-12 * std::abs(by_hand.forces()[k]));
}

} // namespace
