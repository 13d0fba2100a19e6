// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Effects are composed at set-up: what is off is not there, and composing changes no number.
#include "fluid/fluid_options.h"
#include "fluid/fluid_quantities.h"

#include "hand_written_drag.h"
#include "particle_arrays.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace eccentra::fluid;
using eccentra::test::ParticleArrays;

namespace {

EffectList effects_of(const std::string& words) {
  std::istringstream stream("rheology herschel_bulkley 1 0.28 0.65 density 1000 " + words);
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

TEST(Composition, DragIsTheHandWrittenLoop) {
  ParticleArrays composed(500), by_hand(500);
  const EffectList effects = effects_of("drag chien buoyancy off");
  ASSERT_EQ(effects.size(), 1U);
  effects[0]->prepare(composed);
  effects[0]->apply(composed.kick());
  eccentra::test::hand_written_drag(by_hand.kick(), {1.0, 0.28, 0.65, 1000.0});
  for (std::size_t k = 0; k < composed.forces().size(); ++k)
    EXPECT_NEAR(composed.forces()[k], by_hand.forces()[k], 1e-12 * std::abs(by_hand.forces()[k]));
}

} // namespace
