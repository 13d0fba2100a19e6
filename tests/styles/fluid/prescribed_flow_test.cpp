// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One particle in a prescribed flow, in LIGGGHTS: terminal velocity, rest above the yield limit, momentum exchange.
#include "fluid_scene.h"

#include <gtest/gtest.h>

using namespace eccentra::test;
using eccentra::styles::FixFluidForce;

namespace {

struct Settling {
  const char* rheology;
  double sphericity;
  double terminal; ///< [m/s], physics of eq (20)-(23) in closed form
};

class TerminalVelocity : public ::testing::TestWithParam<Settling> {};

TEST_P(TerminalVelocity, IsReachedWithinAThousandth) {
  const Settling& c = GetParam();
  LiggghtsSession session;
  session.script(scene_head() + one_sphere() + gravity() + "timestep 1e-4\nfix integrate all nve/sphere\n" +
                 "fix flow all fluid/force rheology " + c.rheology + " density 1000 drag chien sphericity " +
                 std::to_string(c.sphericity) + "\nfix still all fluid/uniform velocity 0 0 0\nrun 5000\n");
  EXPECT_NEAR(-velocity_of(session, 1, 2), c.terminal, 1e-3 * c.terminal);
}

INSTANTIATE_TEST_SUITE_P(Chien, TerminalVelocity,
                         ::testing::Values(Settling{"herschel_bulkley 0 0.28 0.65", 1.0, .283247422422},
                                           Settling{"herschel_bulkley 0 0.28 0.65", .98, .27578509572},
                                           Settling{"herschel_bulkley 0 0.28 0.65", .91, .249634022766},
                                           Settling{"herschel_bulkley 0 0.28 0.65", .85, .227561833356},
                                           Settling{"power_law 0.28 0.65", .79, .206191422634},
                                           Settling{"herschel_bulkley 1 0.28 0.65", 1.0, .223469099117},
                                           Settling{"herschel_bulkley 2 0.28 0.65", 1.0, .159555286524},
                                           Settling{"newtonian 1e-3", 1.0, .547488752614}));

TEST(YieldStress, HoldsAParticleExactly) {
  LiggghtsSession session;
  session.script(scene_head() + one_sphere() +
                 "fix flow all fluid/force rheology herschel_bulkley 4.9 0.28 0.65 density 1000 drag chien\n" +
                 "fix still all fluid/uniform velocity 0 0 0\n" + gravity() +
                 "timestep 1e-4\nfix integrate all nve/sphere\nrun 1000\n");
  EXPECT_LE(std::abs(velocity_of(session, 1, 2)), 1e-15);
}

} // namespace
