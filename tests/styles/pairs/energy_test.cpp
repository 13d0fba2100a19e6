// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Random impacts of two clusters, hundreds of pairs side by side in one scene: none gains energy, momentum is kept.
#include "styles/bodies/bodies_scene.h"
#include "styles/pairs/all_materials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

using namespace eccentra;
using namespace eccentra::test;

namespace {

/// Pairs of one run; ECCENTRA_IMPACTS in the environment asks for more (the slow test).
int impacts_asked_for() {
  const char* text = std::getenv("ECCENTRA_IMPACTS");
  return text ? std::atoi(text) : 500;
}

/// Time step [s]; ECCENTRA_IMPACT_STEP asks for another one, to see impacts that do gain.
double impact_step() {
  const char* text = std::getenv("ECCENTRA_IMPACT_STEP");
  return text ? std::atof(text) : 5e-6;
}

const std::string kHertz = "model hertz tangential history ";

constexpr double impact_time = 0.04; // s until all pairs have parted

struct Pair {
  double before, after;
  Eigen::Vector3d momentum_before, momentum_after;
};

double energy_of(LiggghtsSession& session, styles::FixClusterBodies& bodies, int tag, Eigen::Vector3d& momentum) {
  const int i = session.local(tag);
  const Eigen::Map<Eigen::Vector3d> v(session.atom().v[i]), w(session.atom().omega[i]), l(bodies.angular_momentum(i));
  const double m = session.atom().rmass[i];
  momentum += m * v;
  return 0.5 * (m * v.squaredNorm() + l.dot(w));
}

std::vector<Pair> collide(const std::vector<shape::ClusterShape>& shapes, int count, const Material& material,
                          const std::string& arguments) {
  LiggghtsSession session;
  const int side = static_cast<int>(std::ceil(std::cbrt(count)));
  constexpr double cell = 0.06; // no pair reaches another before the end
  const std::string far = std::to_string(side * cell);
  session.script(
      "atom_style granular\natom_modify map array\nboundary p p p\nnewton off\ncommunicate single vel yes\n"
      "units si\nregion box block 0 " +
      far + " 0 " + far + " 0 " + far +
      " units box\ncreate_box 1 box\nneighbor 0.001 bin\nneigh_modify delay 0\n"
      "fix m1 all property/global youngsModulus peratomtype " +
      std::to_string(material.youngs) + "\nfix m2 all property/global poissonsRatio peratomtype 0.3\n" +
      "fix m3 all property/global coefficientRestitution peratomtypepair 1 " + std::to_string(material.restitution) +
      "\nfix m4 all property/global coefficientFriction peratomtypepair 1 " + std::to_string(material.friction) + "\n");
  give_materials(session);
  session.script("pair_style gran/cluster " + arguments + "\npair_coeff * *\nfix integrate all nve/cluster\n");
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, 1);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int n = 0; n < count; ++n) {
    const Eigen::Vector3d centre =
        cell * Eigen::Vector3d(n % side + 0.5, n / side % side + 0.5, n / (side * side) + 0.5);
    Eigen::Vector3d direction(normal(random), normal(random), normal(random));
    direction.normalize();
    const Eigen::Vector3d sideways = 2e-3 * Eigen::Vector3d(u(random), u(random), u(random));
    for (int k = 0; k < 2; ++k) {
      Start start;
      const double sign = k ? 1 : -1;
      start.position = centre + sign * 6e-3 * direction + (k ? sideways : -sideways) / 2;
      start.velocity = -sign * (0.3 + 0.1 * u(random)) * direction;
      start.omega = 30 * Eigen::Vector3d(u(random), u(random), u(random));
      start.orientation =
          Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
      add_body(session, shapes[(n + k) % shapes.size()], start);
    }
  }
  styles::FixClusterBodies& bodies = styles::FixClusterBodies::require(&session.lammps());
  session.script("timestep " + std::to_string(1e6 * impact_step()) + "e-6\nrun 0\n");
  std::vector<Pair> pairs(count, Pair{0, 0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  for (int n = 0; n < count; ++n)
    for (int k = 1; k <= 2; ++k)
      pairs[n].before += energy_of(session, bodies, 2 * n + k, pairs[n].momentum_before);
  session.command("run " + std::to_string(std::lround(impact_time / impact_step())));
  for (int n = 0; n < count; ++n)
    for (int k = 1; k <= 2; ++k)
      pairs[n].after += energy_of(session, bodies, 2 * n + k, pairs[n].momentum_after);
  return pairs;
}

void expect_no_gain(const std::vector<Pair>& pairs, double tolerance) {
  int met = 0;
  double worst = -1;
  for (const Pair& p : pairs) {
    worst = std::max(worst, p.after / p.before - 1);
    met += std::abs(p.after / p.before - 1) > 1e-4;
    EXPECT_LT((p.momentum_after - p.momentum_before).norm(), 1e-9 * std::sqrt(p.before * 3e-4));
  }
  EXPECT_LT(worst, tolerance);
  EXPECT_GT(met, static_cast<int>(pairs.size() / 3)) << "most pairs must have met";
  std::printf("%zu pairs, %d met, largest relative change of energy %.3g\n", pairs.size(), met, worst);
}

const std::vector<shape::ClusterShape>& mixed_shapes() {
  static const std::vector<shape::ClusterShape> shapes = {shape_of("cube", "8"), shape_of("cube", "27"),
                                                          shape_of("disk", "7"), shape_of("cube", "64"),
                                                          shape_of("disk", "48")};
  return shapes;
}

} // namespace

TEST(Energy, RandomImpactsNeverGainEnergy) {
  // Contacts open at all overlaps: what is left is the integrator's error, second order in the step.
  for (const char* arguments : {"contacts shared", "contacts parallel"})
    expect_no_gain(collide(mixed_shapes(), impacts_asked_for(), {}, kHertz + arguments), 1e-6);
}

// Rolling friction takes energy alone, in impacts that would else keep it: its springs give back at most what they
// took, and end with their contact.
TEST(Energy, RollingFrictionNeverAddsAny) {
  Material elastic;
  elastic.restitution = 1;
  elastic.friction = 0;
  std::vector<std::string> models = {"shape form limited", "shape form directional", "shape form epsd"};
  for (const std::string& rolling : known("rolling_friction"))
    if (rolling != "off" && rolling != "eccentric" && rolling != "shape")
      models.push_back(rolling);
  for (const std::string& rolling : models)
    for (const char* sharing : {" contacts shared", " contacts parallel"}) {
      std::printf("%s%s: ", rolling.c_str(), sharing);
      expect_no_gain(collide(mixed_shapes(), 150, elastic, kHertz + "rolling_friction " + rolling + sharing), 1e-4);
    }
}

TEST(Energy, FrictionlessElasticImpactsKeepIt) {
  Material elastic;
  elastic.restitution = 1;
  elastic.friction = 0;
  for (const Pair& p : collide(mixed_shapes(), 200, elastic, kHertz))
    EXPECT_NEAR(p.after / p.before, 1, 1e-4);
}
