// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix sleep/cluster: a bed asleep is the bed awake within the tolerance, and whatever disturbs it wakes it.
#include "styles/bodies/bodies_scene.h"
#include "styles/bodies/body_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr double diameter = 6.35e-3, gravity = 9.81, tolerance = 0.01;
constexpr int rows = 4, layers = 6, bodies = rows * rows * layers;
/// A bed falls into place within these steps of 50 us.
constexpr int settling_steps = 16000;
constexpr const char* head = R"(
  atom_style granular
  atom_modify map array
  boundary p p f
  newton off
  communicate single vel yes
  units si
)";
constexpr const char* world = R"(
  neighbor 0.001 bin
  neigh_modify delay 0
  fix m1 all property/global youngsModulus peratomtype 5e6
  fix m2 all property/global poissonsRatio peratomtype 0.3
  fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5
  fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
  pair_style gran/cluster model hertz tangential history rolling_friction off
  pair_coeff * *
  fix weight all gravity 9.81 vector 0 0 -1
  fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0
  fix integrate all nve/cluster
  timestep 2e-5
)";
const std::string sleeping = "fix sleep all sleep/cluster tolerance " + std::to_string(tolerance) + "\n";

double output(LiggghtsSession& session, const char* fix, int n) {
  return session.lammps().modify->find_fix_id(fix)->compute_vector(n);
}
int asleep(LiggghtsSession& session) {
  return static_cast<int>(output(session, "sleep", 0));
}
void run(LiggghtsSession& session, int steps) {
  session.command("run " + std::to_string(steps));
}

/// Cubes, disks and plain spheres, as they fall.
void fill(LiggghtsSession& session) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1);
  const std::vector<shape::ClusterShape> shapes = {shape_of("cube", "8"), shape_of("disk", "7"),
                                                   shape_of("cube", "27")};
  constexpr double spacing = 9e-3;
  for (int n = 0; n < bodies; ++n) {
    Start start;
    const int column = n / rows % rows, layer = n / (rows * rows);
    start.position = spacing * Eigen::Vector3d(n % rows + 0.5, column + 0.5, layer + 0.7);
    start.velocity = 0.1 * Eigen::Vector3d(normal(random), normal(random), 0);
    start.orientation = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    if (n % 4 == 3)
      add_sphere(session, start, diameter / 2);
    else
      add_body(session, shapes[n % 4], start);
  }
}

/// The file of a settled bed, made once per program and number of ranks.
const std::string& settled_bed() {
  static std::string file;
  if (!file.empty())
    return file;
  file = "settled.restart";
  LiggghtsSession session;
  session.script(head);
  session.script("region box block 0 0.036 0 0.036 -0.01 0.09 units box\ncreate_box 1 box\n");
  session.script(world);
  fill(session);
  session.script("timestep 5e-5\n");
  run(session, settling_steps);
  session.command("write_restart " + file);
  MPI_Barrier(MPI_COMM_WORLD);
  return file;
}

void open_bed(LiggghtsSession& session, const std::string& file, const std::string& more) {
  session.script(head);
  session.command("read_restart " + file);
  session.script(world);
  session.script(more);
}

double sum_over_ranks(double mine) {
  double all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

/// Sum of m w(i) over all bodies.
template <class Weight> double weighed(LiggghtsSession& session, Weight weight) {
  double sum = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    sum += session.atom().rmass[i] * weight(i);
  return sum_over_ranks(sum);
}
double mass(LiggghtsSession& session) {
  return weighed(session, [](int) { return 1.; });
}
double height(LiggghtsSession& session) {
  return weighed(session, [&](int i) { return session.atom().x[i][2]; }) / mass(session);
}
double mean_speed(LiggghtsSession& session, int k) {
  return weighed(session, [&](int i) { return session.atom().v[i][k]; }) / mass(session);
}

/// Sum over the one body that was added to the bed.
template <class Value> double of_ball(LiggghtsSession& session, Value value) {
  double sum = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    if (session.atom().tag[i] > bodies)
      sum += value(i);
  return sum_over_ranks(sum);
}

/// A ball above the bed, on its way down.
constexpr double ball_speed = 0.5;
void drop_ball(LiggghtsSession& session) {
  double top = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    top = std::max(top, session.atom().x[i][2]);
  MPI_Allreduce(MPI_IN_PLACE, &top, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  Start start;
  start.position = Eigen::Vector3d(0.018, 0.018, top + 1.5 * diameter);
  start.velocity.z() = -ball_speed;
  add_sphere(session, start, diameter / 2);
}

void tilt(LiggghtsSession& session, double degrees) {
  const double angle = degrees * M_PI / 180;
  session.script("unfix weight\nfix weight all gravity 9.81 vector " + std::to_string(std::sin(angle)) + " 0 " +
                 std::to_string(-std::cos(angle)) + "\n");
}

} // namespace

TEST(Sleep, BedAsleepCarriesItsWeightWithinTheTolerance) {
  const std::string file = settled_bed();
  LiggghtsSession awake;
  open_bed(awake, file, "");
  run(awake, 3000);
  LiggghtsSession session;
  open_bed(session, file, sleeping);
  run(session, 3000);
  EXPECT_EQ(asleep(session), bodies);
  EXPECT_EQ(kinetic_energy(session), 0);
  const double weight = mass(session) * gravity;
  EXPECT_NEAR(-output(session, "floor", 2), weight, tolerance * weight);
  EXPECT_NEAR(output(session, "floor", 2), output(awake, "floor", 2), tolerance * weight);
  EXPECT_LE(output(session, "sleep", 3), tolerance);
  // The floor carries exactly what the sleepers do not.
  const double on_floor[3] = {output(session, "floor", 0), output(session, "floor", 1),
                              output(session, "floor", 2) + weight};
  EXPECT_NEAR(std::sqrt(on_floor[0] * on_floor[0] + on_floor[1] * on_floor[1] + on_floor[2] * on_floor[2]),
              output(session, "sleep", 4) * weight, 1e-9 * weight);
  EXPECT_NEAR(height(session), height(awake), 1e-4 * diameter);
  // Nothing happens while all are asleep.
  const std::vector<BodyRow> before = body_rows(session, bodies);
  run(session, 500);
  EXPECT_EQ(body_rows(session, bodies), before);
}

TEST(Sleep, BallReboundsFromABedAsleepAsFromOneAwake) {
  const std::string file = settled_bed();
  struct Impact {
    double rebound = 0, lowest = 1, bed = 0;
  };
  const auto impact = [&](const std::string& more) {
    LiggghtsSession session;
    open_bed(session, file, more);
    run(session, 3000);
    drop_ball(session);
    if (!more.empty()) {
      EXPECT_EQ(asleep(session), bodies);
    }
    Impact found;
    double wake_ups = 0;
    for (int n = 0; n < 60; ++n) {
      run(session, 20);
      found.rebound = std::max(found.rebound, of_ball(session, [&](int i) { return session.atom().v[i][2]; }));
      found.lowest = std::min(found.lowest, of_ball(session, [&](int i) { return session.atom().x[i][2]; }));
      if (!more.empty())
        wake_ups += output(session, "sleep", 2);
    }
    if (!more.empty()) {
      EXPECT_GT(wake_ups, bodies / 10) << "the ball wakes the bed";
    }
    found.bed = height(session);
    return found;
  };
  const Impact awake = impact(""), asleep_before = impact(sleeping);
  EXPECT_GT(awake.rebound, 0.02 * ball_speed);
  EXPECT_NEAR(asleep_before.rebound, awake.rebound, 0.02 * ball_speed);
  EXPECT_NEAR(asleep_before.lowest, awake.lowest, 0.01 * diameter);
  EXPECT_NEAR(asleep_before.bed, awake.bed, 1e-3 * diameter);
}

TEST(Sleep, SphereThatSleepsOnTheFloorReboundsLikeOneThatIsAwake) {
  const auto rebound = [&](const std::string& more) {
    LiggghtsSession session;
    session.script(head);
    session.script("region box block 0 0.036 0 0.036 -0.01 0.09 units box\ncreate_box 1 box\n");
    session.script(world);
    session.script(more);
    Start start;
    start.position = Eigen::Vector3d(0.018, 0.018, diameter / 2);
    add_sphere(session, start, diameter / 2);
    run(session, 10000);
    if (!more.empty()) {
      EXPECT_EQ(asleep(session), 1);
    }
    start.position.z() = 1.6 * diameter;
    start.velocity.z() = -0.2;
    add_sphere(session, start, diameter / 2);
    run(session, 500);
    double speed = 0;
    for (int i = 0; i < session.atom().nlocal; ++i)
      if (session.atom().tag[i] == 2)
        speed = session.atom().v[i][2];
    return sum_over_ranks(speed);
  };
  const double awake = rebound("");
  EXPECT_GT(awake, 0.01);
  EXPECT_NEAR(rebound(sleeping), awake, tolerance * awake);
}

TEST(Sleep, TiltedGravityWakesAll) {
  const std::string file = settled_bed();
  const auto slide = [&](const std::string& more) {
    LiggghtsSession session;
    open_bed(session, file, more);
    run(session, 3000);
    if (!more.empty()) {
      EXPECT_EQ(asleep(session), bodies);
    }
    tilt(session, 40);
    run(session, 1);
    if (!more.empty()) {
      EXPECT_EQ(asleep(session), 0);
    }
    run(session, 2500);
    return mean_speed(session, 0);
  };
  const double awake = slide("");
  EXPECT_GT(awake, 0.05) << "at 40 degrees a bed on a floor with friction 0.5 slides";
  EXPECT_NEAR(slide(sleeping), awake, 0.02 * awake);
}

TEST(Sleep, AvalancheStartsAtTheSameAngle) {
  constexpr double lowest = 10;
  const std::string file = settled_bed();
  const auto angle_of_start = [&](const std::string& more) {
    LiggghtsSession session;
    open_bed(session, file, more);
    run(session, 3000);
    for (double degrees = lowest; degrees < 40; degrees += 1) {
      tilt(session, degrees);
      run(session, 1000);
      if (mean_speed(session, 0) > 0.01)
        return degrees;
    }
    return 90.;
  };
  const double awake = angle_of_start("");
  EXPECT_GT(awake, lowest) << "the bed stands when the tilting begins";
  EXPECT_LT(awake, 35);
  EXPECT_NEAR(angle_of_start(sleeping), awake, 1);
}

TEST(Sleep, FloorThatStartsToSlideWakesTheBed) {
  const std::string file = settled_bed();
  const auto dragged = [&](const std::string& more) {
    LiggghtsSession session;
    open_bed(session, file, more);
    run(session, 3000);
    session.script(
        "unfix floor\nfix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane "
        "0.0 velocity 0.1 0 0\n");
    run(session, 1500);
    return mean_speed(session, 0);
  };
  const double awake = dragged("");
  EXPECT_GT(awake, 0.02);
  EXPECT_NEAR(dragged(sleeping), awake, 0.02 * awake);
}

TEST(Sleep, RisingFlowWakesTheBed) {
  const std::string file = settled_bed();
  const auto lifted = [&](double speed, const std::string& more) {
    LiggghtsSession session;
    open_bed(session, file, more);
    run(session, 3000);
    session.script("fix water all fluid/force rheology newtonian 1e-3 density 1000 drag di_felice\n"
                   "fix flow all fluid/uniform velocity 0 0 " +
                   std::to_string(speed) + " fraction 0.45\n");
    run(session, speed > 0.1 ? 3000 : 8000);
    if (!more.empty()) {
      if (speed > 0.1) {
        EXPECT_EQ(asleep(session), 0);
      } else {
        EXPECT_GE(asleep(session), bodies - 5);
      }
    }
    return std::array<double, 2>{mean_speed(session, 2), -output(session, "floor", 2)};
  };
  // Far below the onset the bed stays, lighter by buoyancy and drag; above it it rises.
  const auto calm = lifted(0.02, ""), calm_asleep = lifted(0.02, sleeping);
  EXPECT_GT(calm[1], 0);
  EXPECT_NEAR(calm_asleep[1], calm[1], 2 * tolerance * calm[1]);
  const auto rising = lifted(0.3, ""), rising_asleep = lifted(0.3, sleeping);
  EXPECT_GT(rising[0], 0.02);
  EXPECT_NEAR(rising_asleep[0], rising[0], 0.02 * rising[0]);
}

TEST(Sleep, RestartGivesTheSameDigitsOnAnyNumberOfRanks) {
  const std::string file = settled_bed();
  constexpr int before = 2000, after = 1600, middle = settling_steps + before + 900;
  // A ball wakes a part of the bed; the file is written while others sleep.
  const auto straight = [&](MPI_Comm ranks, const std::string& more) {
    LiggghtsSession session(ranks);
    open_bed(session, file, sleeping);
    run(session, before);
    drop_ball(session);
    session.script(more);
    run(session, after);
    return std::make_pair(body_rows(session, bodies + 1, ranks), asleep(session));
  };
  const auto [reference, sleepers] = straight(MPI_COMM_SELF, "");
  EXPECT_LT(sleepers, bodies);
  const auto [on_all_ranks, same_sleepers] =
      straight(MPI_COMM_WORLD, "restart " + std::to_string(middle) + " half.restart\n");
  EXPECT_EQ(same_sleepers, sleepers);
  EXPECT_EQ(on_all_ranks, reference);
  MPI_Barrier(MPI_COMM_WORLD);
  for (MPI_Comm ranks : {MPI_COMM_SELF, MPI_COMM_WORLD}) {
    LiggghtsSession session(ranks);
    open_bed(session, "half.restart." + std::to_string(middle), sleeping);
    run(session, settling_steps + before + after - middle);
    EXPECT_EQ(body_rows(session, bodies + 1, ranks), reference);
  }
}

TEST(Sleep, RecheckWakesAll) {
  LiggghtsSession session;
  open_bed(session, settled_bed(), "fix sleep all sleep/cluster recheck 500\n");
  const int steps = 3000;
  run(session, steps);
  EXPECT_GT(output(session, "sleep", 2), bodies) << "wake-ups";
}
