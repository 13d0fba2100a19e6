// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One template with a distribution of sizes: numbers, masses and settling velocities of its classes, beside spheres.
#include "shape/size_classes.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "support/granular_script.h"
#include "support/liggghts_session.h"

#include "modify.h"

#include <gtest/gtest.h>

#include <mpi.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace {

using eccentra::shape::SizeBasis;
using eccentra::shape::SizeClass;
using eccentra::styles::FixClusterBodies;
using eccentra::test::LiggghtsSession;

constexpr int kCount = 600;
constexpr double kDensity = 2619, kRadius = 3e-3; // of the plain spheres
const std::string kCubes =
    "fix t all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube 8 diameter ";

/// Half of the bodies are clusters of these diameters, the others spheres; no two bodies touch each other.
void fill(LiggghtsSession& session, const std::string& diameter) {
  session.script(eccentra::test::granular_box("0 0.2 0 0.2 0 0.2", "p p p") +
                 eccentra::test::granular_material({}, "0.002") +
                 eccentra::test::cluster_contacts("rolling_friction off") + "timestep 1e-5\n" + kCubes + diameter +
                 R"(
    fix s all particletemplate/sphere 15485867 atom_type 1 density constant 2619 radius constant 3e-3
    fix both all particledistribution/discrete/numberbased 32452843 2 t 0.5 s 0.5
    fix ins all insert/pack seed 86028121 distributiontemplate both insert_every once overlapcheck yes all_in no &
      verbose no vel constant 0 0 0 particles_in_region 600 region box
    fix integrate all nve/cluster
    run 1
    neigh_modify exclude group all all
  )");
}

double sum(double local) {
  double all = 0;
  MPI_Allreduce(&local, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

/// Of each shape, then of the spheres: number, mean mass [kg], mean downward velocity [m/s].
struct Found {
  double number, mass, velocity;
};
std::vector<Found> found(LiggghtsSession& session) {
  auto& atom = session.atom();
  FixClusterBodies& bodies = *FixClusterBodies::find(&session.lammps());
  std::vector<Found> all(bodies.shapes().size() + 1, Found{0, 0, 0});
  for (int i = 0; i < atom.nlocal; ++i) {
    const int shape = bodies.shape_id(i);
    Found& of = shape < 0 ? all.back() : all[shape];
    ++of.number;
    of.mass += atom.rmass[i];
    of.velocity -= atom.v[i][2];
  }
  for (Found& of : all) {
    const double number = sum(of.number);
    of = {number, sum(of.mass) / number, sum(of.velocity) / number};
  }
  return all;
}

void expect_classes(const std::vector<Found>& all, const std::vector<SizeClass>& classes) {
  ASSERT_EQ(all.size(), classes.size() + 1);
  double clusters = 0;
  for (std::size_t k = 0; k < classes.size(); ++k)
    clusters += all[k].number;
  EXPECT_NEAR(clusters, kCount / 2, 2);
  EXPECT_NEAR(all.back().number, kCount / 2, 2);
  for (std::size_t k = 0; k < classes.size(); ++k) {
    // Binomial: four standard errors.
    EXPECT_NEAR(all[k].number / clusters, classes[k].number,
                4 * std::sqrt(classes[k].number * (1 - classes[k].number) / clusters))
        << k;
    const double mass = kDensity * M_PI / 6 * std::pow(classes[k].diameter, 3);
    EXPECT_NEAR(all[k].mass, mass, 1e-6 * mass) << k;
  }
}

TEST(SizeDistribution, LognormalClustersBesideSpheres) {
  LiggghtsSession session;
  fill(session, "lognormal number 5e-3 0.25 classes 6");
  expect_classes(found(session), eccentra::shape::lognormal_sizes(SizeBasis::number, 5e-3, 0.25, 6));
  // In honey each class falls at its own velocity, (rho_p - rho) g d^2/(18 mu), clusters and spheres alike.
  session.script("fix weight all gravity 9.81 vector 0 0 -1\n"
                 "fix honey all fluid/force rheology newtonian 10 density 1000 drag schiller_naumann\n"
                 "fix flow all fluid/uniform velocity 0 0 0\nrun 600\n");
  for (const Found& of : found(session)) {
    const double diameter = std::cbrt(6 / M_PI * of.mass / kDensity);
    const double stokes = (kDensity - 1000) * 9.81 * diameter * diameter / (18 * 10);
    EXPECT_NEAR(of.velocity, stokes, 0.02 * stokes) << diameter;
  }
}

TEST(SizeDistribution, SieveByMass) {
  const std::string text = "# aperture [m], passing [%]\n2e-3 0\n4e-3 40\n6e-3 100\n";
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
    std::ofstream("sizes.sieve") << text;
  LiggghtsSession session;
  fill(session, "sieve sizes.sieve");
  expect_classes(found(session), eccentra::shape::sieve_sizes(text, "sizes.sieve"));
}

// The expected mass of a body decides how many an insertion by mass brings.
TEST(SizeDistribution, InsertsAsMuchMassAsIsAskedFor) {
  LiggghtsSession session;
  fill(session, "uniform mass 3e-3 6e-3");
  const double before = sum(found(session).front().number);
  session.script(
      "fix by_mass all particledistribution/discrete 32452867 1 t 1.0\n"
      "region fresh block 0 0.2 0 0.2 0 0.2 units box\n"
      "fix more all insert/pack seed 86028157 distributiontemplate by_mass insert_every once overlapcheck no "
      "all_in no verbose no vel constant 0 0 0 mass_in_region 0.2 region fresh\n");
  double mass = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    mass += session.atom().rmass[i];
  const double there = sum(mass);
  EXPECT_GT(before, 0);
  EXPECT_LT(there, 0.2);
  session.command("run 1");
  mass = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    mass += session.atom().rmass[i];
  EXPECT_NEAR(sum(mass), 0.2, 0.05 * 0.2);
}

} // namespace
