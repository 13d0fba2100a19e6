// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// pair_style gran/cluster against stock: single spheres to round-off, two-body impacts of clusters (contacts parallel).
#include "styles/bodies/bodies_scene.h"

#include "fix_multisphere.h"

#include <gtest/gtest.h>

#include <random>

using namespace eccentra;
using namespace eccentra::test;

namespace {

struct State {
  std::vector<Eigen::Vector3d> position, velocity, omega;
};

State state_of(LiggghtsSession& session) {
  State s;
  for (int tag = 1; tag <= static_cast<int>(session.atom().natoms); ++tag) {
    const int i = session.local(tag);
    s.position.push_back(Eigen::Map<Eigen::Vector3d>(session.atom().x[i]));
    s.velocity.push_back(Eigen::Map<Eigen::Vector3d>(session.atom().v[i]));
    s.omega.push_back(Eigen::Map<Eigen::Vector3d>(session.atom().omega[i]));
  }
  return s;
}

/// Spheres on a lattice run through each other.
void add_spheres(LiggghtsSession& session, bool as_clusters) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto shape = shape_of("sphere", "1", 6e-3);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c) {
        Start start;
        start.position = Eigen::Vector3d(a - 1, b - 1, c - 1) * 7e-3;
        start.velocity = Eigen::Vector3d(u(random), u(random), u(random)) * 0.3 - 20 * start.position;
        start.omega = Eigen::Vector3d(u(random), u(random), u(random)) * 50;
        if (as_clusters)
          add_body(session, shape, start);
        else
          add_sphere(session, start, 3e-3);
      }
}

constexpr const char* run_spheres = "timestep 5e-6\nrun 4000\n";

State stock_spheres() {
  LiggghtsSession session;
  open_box(session, {});
  session.script("pair_style gran model hertz tangential history\npair_coeff * *\nfix integrate all nve/sphere\n");
  add_spheres(session, false);
  session.script(run_spheres);
  return state_of(session);
}

void expect_same(const State& ours, const State& stock, double tolerance) {
  ASSERT_EQ(ours.position.size(), stock.position.size());
  for (std::size_t i = 0; i < stock.position.size(); ++i) {
    EXPECT_LT((ours.position[i] - stock.position[i]).norm(), tolerance * 6e-3) << "position of " << i;
    EXPECT_LT((ours.velocity[i] - stock.velocity[i]).norm(), tolerance * 0.3) << "velocity of " << i;
    EXPECT_LT((ours.omega[i] - stock.omega[i]).norm(), tolerance * 50) << "spin of " << i;
  }
}

} // namespace

// Collisions amplify round-off about a hundredfold each: after some ten per sphere 1e-16 may have become 1e-9.
constexpr double grown_round_off = 1e-8;

TEST(AgainstStock, PlainSpheresAreTheSame) {
  const State stock = stock_spheres();
  LiggghtsSession session;
  open_box(session, {});
  use_clusters(session, "contacts parallel");
  add_spheres(session, false);
  session.script(run_spheres);
  expect_same(state_of(session), stock, grown_round_off);
}

TEST(AgainstStock, OneSphereClustersAreTheSame) {
  const State stock = stock_spheres();
  LiggghtsSession session;
  open_box(session, {});
  use_clusters(session, "contacts parallel");
  add_spheres(session, true);
  session.script(run_spheres);
  expect_same(state_of(session), stock, grown_round_off);
}

namespace {

/// Centres of mass and velocities of two bodies after an impact of stock fix multisphere; `starts` tells how they
/// began.
struct Impact {
  Eigen::Vector3d position[2], velocity[2];
};

constexpr int impact_steps = 6000;
constexpr const char* impact_timestep = "timestep 1e-6\n";

/// Right-handed orthonormal frame of three points, as columns.
Eigen::Matrix3d frame(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Eigen::Matrix3d f;
  f.col(0) = (b - a).normalized();
  f.col(2) = f.col(0).cross(c - a).normalized();
  f.col(1) = f.col(2).cross(f.col(0));
  return f;
}

/// What the models below read beside the materials of open_box.
constexpr const char* more_materials =
    "fix p1 all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
    "fix p2 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.3\n"
    "fix p3 all property/global characteristicVelocity scalar 0.5\n"
    "fix p4 all property/global cohesionEnergyDensity peratomtypepair 1 2e3\n";

Impact stock_impact(const std::string& family, const std::string& count, double offset, Start starts[2],
                    const std::string& models) {
  LiggghtsSession session;
  open_box(session, {});
  session.script(more_materials + ("pair_style gran " + models + "\npair_coeff * *\n"));
  session.script(impact_timestep);
  session.script("fix pts all particletemplate/multisphere/shape 15485863 atom_type 1 density constant 2619 shape " +
                 family + " " + count +
                 " diameter 6.35e-3\nfix pdd all particledistribution/discrete 32452843 1 pts 1.0\n");
  const std::string place[2] = {"-0.0005 0.0005 -0.0005 0.0005 -0.0005 0.0005", std::to_string(offset) + " " +
                                                                                    std::to_string(offset + 1e-3) +
                                                                                    " -0.0005 0.0005 0.0100 0.0110"};
  const std::string motion[2] = {"vel constant 0.02 0.1 0.5 omega constant 20 -30 10",
                                 "vel constant 0.01 0 -0.6 omega constant -5 40 15"};
  const std::string seed[2] = {"49979687", "67867967"};
  for (int k = 0; k < 2; ++k) {
    const std::string n = std::to_string(k);
    session.script("region r" + n + " block " + place[k] + " volume_limit 1e-12 units box\nfix ins" + n +
                   " all insert/pack seed " + seed[k] +
                   " distributiontemplate pdd maxattempt 100 insert_every once overlapcheck no verbose no " +
                   "orientation random all_in no " + motion[k] + " particles_in_region 1 region r" + n + "\n");
  }
  session.script("fix integrate all multisphere\nrun 1\n");
  auto* fix = dynamic_cast<LAMMPS_NS::FixMultisphere*>(session.lammps().modify->find_fix_id("integrate"));
  auto& data = fix->data();
  const shape::ClusterShape shape = shape_of(family, count);
  const int spheres = static_cast<int>(shape.spheres().size());
  // Sub-spheres of one body lie one after the other: their places give position and orientation to all digits.
  for (int body = 0; body < 2; ++body) {
    std::vector<Eigen::Vector3d> from, to;
    for (int n = 0; n < spheres; ++n) {
      from.push_back(shape.spheres()[n].centre);
      to.emplace_back(Eigen::Map<Eigen::Vector3d>(session.atom().x[session.local(body * spheres + 1 + n)]));
    }
    int third = 2;
    while ((from[1] - from[0]).cross(from[third] - from[0]).norm() < 1e-3 * (from[1] - from[0]).squaredNorm())
      ++third;
    const Eigen::Matrix3d turn = frame(to[0], to[1], to[third]) * frame(from[0], from[1], from[third]).transpose();
    Start& s = starts[body];
    s.orientation = Eigen::Quaterniond(turn);
    s.position = to[0] - turn * from[0];
    double v[3];
    data.vcm(v, body);
    s.velocity = Eigen::Map<Eigen::Vector3d>(v);
    s.omega = Eigen::Map<Eigen::Vector3d>(session.atom().omega[session.local(body * spheres + 1)]);
  }
  session.command("run " + std::to_string(impact_steps));
  Impact result;
  for (int body = 0; body < 2; ++body) {
    double x[3], v[3];
    data.xcm(x, body);
    data.vcm(v, body);
    result.position[body] = Eigen::Map<Eigen::Vector3d>(x);
    result.velocity[body] = Eigen::Map<Eigen::Vector3d>(v);
  }
  return result;
}

void expect_same_impact(const std::string& family, const std::string& count, double offset,
                        const std::string& models = "model hertz tangential history") {
  SCOPED_TRACE(family + " " + count + " offset " + std::to_string(offset) + " " + models);
  Start starts[2];
  const Impact stock = stock_impact(family, count, offset, starts, models);
  LiggghtsSession session;
  open_box(session, {});
  session.script(more_materials + ("pair_style gran/cluster " + models +
                                   " contacts parallel\npair_coeff * *\nfix integrate all nve/cluster\n"));
  session.script(impact_timestep);
  for (const Start& start : starts)
    add_body(session, shape_of(family, count), start);
  session.command("run " + std::to_string(impact_steps));
  double change = 0;
  for (int body = 0; body < 2; ++body) {
    const int i = session.local(body + 1);
    const Eigen::Vector3d x = Eigen::Map<Eigen::Vector3d>(session.atom().x[i]);
    const Eigen::Vector3d v = Eigen::Map<Eigen::Vector3d>(session.atom().v[i]);
    EXPECT_LT((v - stock.velocity[body]).norm(), 1e-6 * 0.6);
    EXPECT_LT((x - stock.position[body]).norm(), 1e-6 * 6.35e-3);
    change += (stock.velocity[body] - starts[body].velocity).norm();
  }
  EXPECT_GT(change, 0.1) << "they must have met";
}

} // namespace

TEST(AgainstStock, TwoBodyImpactsOfClustersAreTheSame) {
  expect_same_impact("cube", "8", 0);
  expect_same_impact("cube", "27", 0.002);
  expect_same_impact("disk", "7", 0.001);
  expect_same_impact("cube", "64", 0.001);
}

TEST(AgainstStock, TwoBodyImpactsUnderOtherModelsAreTheSame) {
  for (const char* models :
       {"model hooke tangential history", "model hertz tangential no_history", "model hertz",
        "model hertz tangential history rolling_friction cdt", "model hertz tangential history rolling_friction epsd2",
        "model hooke tangential history rolling_friction epsd", "model hertz tangential history cohesion sjkr"})
    expect_same_impact("cube", "8", 0.001, models);
}
