// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Settled beds at steps below and above the critical step of fix timestep/limit: quiet below, heating above 1.5 times
// it.
#include "styles/walls/wall_scene.h"

#include "fix.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using eccentra::test::LiggghtsSession;

namespace {

constexpr int kBodies = 60;

class Bed {
 public:
  Bed(const std::string& shape, const std::string& youngs, double settling_step, int settling_steps) {
    const bool spheres = shape == "sphere 1";
    session_.script(R"(
      atom_style granular
      atom_modify map array
      boundary f f f
      newton off
      communicate single vel yes
      units si
      region box block -0.017 0.017 -0.017 0.017 0 0.2 units box
      create_box 1 box
      neighbor 0.002 bin
      neigh_modify delay 0
      fix m2 all property/global poissonsRatio peratomtype 0.3
      fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9
      fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
      fix gravity all gravity 9.81 vector 0 0 -1
    )");
    session_.script("fix m1 all property/global youngsModulus peratomtype " + youngs);
    session_.script(std::string("pair_style ") + (spheres ? "gran" : "gran/cluster") +
                    " model hertz tangential history\npair_coeff * *");
    for (const char* wall : {"zplane 0.0", "xplane -0.016", "xplane 0.016", "yplane -0.016", "yplane 0.016"}) {
      const std::string id = "w" + std::to_string(walls_++);
      session_.script("fix " + id + " all wall/gran/cluster model hertz tangential history primitive type 1 " + wall);
    }
    session_.script(std::string("fix pts all particletemplate/") +
                    (spheres
                         ? "sphere 15485863 atom_type 1 density constant 2619 radius constant 3.175e-3"
                         : "cluster 15485863 atom_type 1 density constant 2619 shape " + shape + " diameter 6.35e-3"));
    session_.script(R"(
      region ins block -0.0155 0.0155 -0.0155 0.0155 0.006 0.195 units box
      fix pdd all particledistribution/discrete 32452843 1 pts 1.0
      fix ins all insert/pack seed 49979687 distributiontemplate pdd maxattempt 200 insert_every once overlapcheck yes &
        all_in yes vel constant 0 0 -0.5 region ins particles_in_region )" +
                    std::to_string(kBodies));
    session_.script(std::string("fix integrate all nve/") + (spheres ? "sphere" : "cluster"));
    session_.script("fix limit all timestep/limit every 1000");
    session_.script("timestep " + std::to_string(settling_step * 1e6) + "e-6\nrun 1\nunfix ins\nrun " +
                    std::to_string(settling_steps));
  }

  double critical_step() {
    return session_.lammps().modify->fix[session_.lammps().modify->find_fix("limit")]->compute_scalar();
  }
  /// Largest speed after `steps` more at this step [m/s].
  double speed_after(double step, int steps) {
    session_.script("timestep " + std::to_string(step * 1e6) + "e-6\nrun " + std::to_string(steps));
    return speed();
  }
  /// Largest speed now [m/s].
  double speed() {
    double fastest = 0;
    for (int i = 0; i < session_.atom().nlocal; ++i) {
      const double* v = session_.atom().v[i];
      fastest = std::max(fastest, std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    }
    return fastest;
  }
  int bodies() { return session_.atom().nlocal; }

 private:
  LiggghtsSession session_;
  int walls_ = 0;
};

void expect_heating_within_a_factor(const std::string& shape, const std::string& youngs, double settling_step,
                                    int settling_steps) {
  Bed bed(shape, youngs, settling_step, settling_steps);
  EXPECT_EQ(bed.bodies(), kBodies);
  const double critical = bed.critical_step();
  ASSERT_TRUE(std::isfinite(critical));
  // Dies down faster than at the small step; a disk may rock for a while.
  for (int burst = 0; burst < 10 && (burst < 2 || bed.speed() > 3e-4); ++burst)
    bed.speed_after(0.8 * critical, 4000);
  const double quiet = bed.speed_after(0.95 * critical, 4000);
  // Stop as soon as heating shows: a bed of disks flies apart within ten steps, one of cubes grows slowly at the onset.
  const double heating = std::max(10 * quiet, 1e-5);
  constexpr int kFastSteps = 600, kAllSteps = 20000;
  double heated = 0;
  for (int steps = 0; steps < kAllSteps && heated <= heating;) {
    const int burst = steps < kFastSteps ? 1 : 10;
    heated = bed.speed_after(1.5 * critical, burst);
    steps += burst;
  }
  // A loose sphere may still roll.
  EXPECT_LT(quiet, 1e-3) << shape << " " << youngs;
  EXPECT_GT(heated, heating) << shape << " " << youngs << ": critical step " << critical << " s";
}

} // namespace

TEST(SettledBed, SpheresSoft) {
  expect_heating_within_a_factor("sphere 1", "5e6", 2e-5, 60000);
}
TEST(SettledBed, SpheresStiff) {
  expect_heating_within_a_factor("sphere 1", "5e8", 4e-6, 130000);
}
TEST(SettledBed, C8Soft) {
  expect_heating_within_a_factor("cube 8", "5e6", 2e-5, 30000);
}
TEST(SettledBed, C8Stiff) {
  expect_heating_within_a_factor("cube 8", "5e8", 4e-6, 130000);
}
TEST(SettledBed, C64Soft) {
  expect_heating_within_a_factor("cube 64", "5e6", 2e-5, 30000);
}
TEST(SettledBed, C64Stiff) {
  expect_heating_within_a_factor("cube 64", "5e8", 4e-6, 130000);
}
TEST(SettledBed, D48Soft) {
  expect_heating_within_a_factor("disk 48", "5e6", 2e-5, 30000);
}
TEST(SettledBed, D48Stiff) {
  expect_heating_within_a_factor("disk 48", "5e8", 4e-6, 130000);
}
