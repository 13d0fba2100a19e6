// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock fix multisphere, fed by particletemplate/multisphere/shape, carries the exact mass and inertia of our shapes.
#include "shape/cluster_shape.h"
#include "support/granular_script.h"
#include "support/liggghts_session.h"

#include "fix_multisphere.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace eccentra::test;

namespace {

constexpr double kDensity = 2619.0;
constexpr double kDiameter = 6.35e-3;

void expect_exact(const std::string& family, const std::string& count) {
  LiggghtsSession session;
  session.script(granular_box() + granular_material({}, "0.002") + sphere_contacts() + R"(
    timestep 1e-6
    fix pts all particletemplate/multisphere/shape 15485863 atom_type 1 density constant 2619 shape )" +
                 family + " " + count + R"( diameter 6.35e-3
    fix pdd all particledistribution/discrete 32452843 1 pts 1.0
    fix ins all insert/pack seed 49979687 distributiontemplate pdd maxattempt 100 insert_every once overlapcheck yes &
      orientation random all_in yes region box particles_in_region 5 ntry_mc 1000
    fix integrate all multisphere
    run 1
  )");
  std::size_t used = 0;
  const auto shape = eccentra::shape::make_shape({family, count}, 0, used, kDiameter);
  const double mass = kDensity * shape.volume();
  auto* bodies = dynamic_cast<LAMMPS_NS::FixMultisphere*>(session.lammps().modify->find_fix_id("integrate"));
  ASSERT_NE(bodies, nullptr);
  ASSERT_EQ(bodies->data().n_body(), 5);
  EXPECT_EQ(session.atom().nlocal, 5 * static_cast<int>(shape.spheres().size()));
  Eigen::Vector3d expected = mass * shape.inertia_per_mass();
  std::sort(expected.data(), expected.data() + 3);
  for (int b = 0; b < 5; ++b) {
    EXPECT_NEAR(bodies->data().mass(b), mass, 1e-14 * mass);
    int rows = 0;
    int columns = 0;
    auto** all = static_cast<double**>(bodies->extract("inertia", rows, columns));
    ASSERT_NE(all, nullptr);
    ASSERT_EQ(columns, 3);
    double* inertia = all[b];
    std::sort(inertia, inertia + 3);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(inertia[k], expected[k], 1e-12 * expected[2]);
  }
}

} // namespace

TEST(MultisphereShape, MassAndInertiaAreExact) {
  expect_exact("cube", "8");
  expect_exact("disk", "48");
}
