// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters come into a scene through stock insertion: exact counts, mass of the union, uniform orientations; free
// flight keeps momentum and energy on any number of ranks.
#include "styles/bodies/fix_cluster_bodies.h"
#include "support/granular_script.h"
#include "support/liggghts_session.h"

#include "modify.h"

#include <gtest/gtest.h>

#include <mpi.h>

#include <cmath>

using eccentra::styles::FixClusterBodies;
using namespace eccentra::test;

namespace {

constexpr int count = 800;

void fill(LiggghtsSession& session) {
  session.script(granular_box("0 0.2 0 0.2 0 0.2", "p p p") + granular_material({}, "0.002") +
                 cluster_contacts("rolling_friction off") + R"(
    timestep 1e-5
    fix cubes all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube 8 diameter 6.35e-3
    fix disks all particletemplate/cluster 15485867 atom_type 1 shape disk 7 diameter 6.35e-3 density constant 1000
    fix both all particledistribution/discrete/numberbased 32452843 2 cubes 0.5 disks 0.5
    fix ins all insert/pack seed 86028121 distributiontemplate both insert_every once overlapcheck yes all_in no &
      verbose no vel constant 0.1 0 0 omega constant 0 30 5 particles_in_region 800 region box
    fix integrate all nve/cluster
    run 1
  )");
}

double sum(double local) {
  double all = 0;
  MPI_Allreduce(&local, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

} // namespace

TEST(ParticleTemplateCluster, InsertsBodiesOfTheUnionsMassWithUniformOrientations) {
  LiggghtsSession session;
  fill(session);
  auto& atom = session.atom();
  EXPECT_EQ(atom.natoms, count);
  FixClusterBodies& bodies = *FixClusterBodies::find(&session.lammps());
  ASSERT_EQ(bodies.shapes().size(), 2);
  const double solid = M_PI / 6 * std::pow(6.35e-3, 3);
  double axis[3] = {0, 0, 0}, square[3] = {0, 0, 0}, of_first = 0;
  for (int i = 0; i < atom.nlocal; ++i) {
    const int shape = bodies.shape_id(i);
    ASSERT_GE(shape, 0);
    ASSERT_LT(shape, 2);
    of_first += shape == 0;
    EXPECT_NEAR(atom.rmass[i], (shape == 0 ? 2619 : 1000) * solid, 1e-9 * atom.rmass[i]);
    EXPECT_DOUBLE_EQ(atom.radius[i], bodies.shapes()[shape].bounding_radius());
    // Body axis x in world.
    for (int k = 0; k < 3; ++k) {
      const double component = bodies.rotation(i)[3 * k];
      axis[k] += component;
      square[k] += component * component;
    }
    // The angular momentum means the angular velocity that was asked for.
    EXPECT_NEAR(atom.omega[i][1], 30, 0.5);
  }
  // The stock distribution rounds each rank's part.
  EXPECT_NEAR(sum(of_first), count / 2, session.ranks() - 1);
  // Means of a uniform direction: 0 +- 1/sqrt(3 n), and 1/3 +- sqrt(4/45 / n); 4 standard errors.
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(sum(axis[k]) / count, 0, 4 / std::sqrt(3. * count));
    EXPECT_NEAR(sum(square[k]) / count, 1. / 3, 4 * std::sqrt(4. / 45 / count));
  }
}

TEST(NveCluster, FreeFlightKeepsMomentumAndEnergy) {
  LiggghtsSession session;
  fill(session);
  LAMMPS_NS::Fix* motion = session.lammps().modify->find_fix_id("integrate");
  const int i = session.local(1);
  FixClusterBodies& bodies = *FixClusterBodies::find(&session.lammps());
  double before[3] = {0, 0, 0};
  if (i >= 0)
    std::copy(bodies.angular_momentum(i), bodies.angular_momentum(i) + 3, before);
  // Contacts would exchange angular momentum: fly through each other.
  session.script("neigh_modify exclude group all all\n");
  double quantity[8];
  for (int k = 0; k < 8; ++k)
    quantity[k] = motion->compute_vector(k);
  session.command("run 2000");
  for (int k = 0; k < 8; ++k) {
    const double scale = k < 2 ? quantity[k] : k < 5 ? quantity[2] : quantity[6];
    EXPECT_NEAR(motion->compute_vector(k), quantity[k], (k == 1 ? 1e-6 : 1e-10) * scale) << "quantity " << k;
  }
  const int now = session.local(1);
  for (int k = 0; k < 3 && i >= 0 && now >= 0; ++k)
    EXPECT_DOUBLE_EQ(bodies.angular_momentum(now)[k], before[k]);
}
