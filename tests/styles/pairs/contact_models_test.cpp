// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters under each contact model that LIGGGHTS has: single spheres have stock's digits, several sub-spheres share
// dampers, and the tangential spring advances in time with its contact.
#include "styles/bodies/bodies_scene.h"
#include "styles/models/stock_contact.h"
#include "styles/pairs/all_materials.h"
#include "support/groove_scene.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

using namespace eccentra;
using namespace eccentra::test;

namespace {

struct Two {
  Eigen::Vector3d x[2], v[2], omega[2];
};

/// Two spheres of different size that meet obliquely, spinning.
Two meet(const std::string& models, bool as_clusters, double faster = 0) {
  LiggghtsSession session;
  open_box(session, {});
  give_materials(session);
  session.script("pair_style " + std::string(as_clusters ? "gran/cluster " : "gran ") + models +
                 (as_clusters ? " contacts parallel" : "") + "\npair_coeff * *\nfix integrate all " +
                 (as_clusters ? "nve/cluster" : "nve/sphere") + "\n");
  Start start[2];
  // Apart: in the set-up of a run stock's luding moves the history of what touches on by a step, and ours does not.
  start[0].position = Eigen::Vector3d(-2.85e-3, 0, 0);
  start[1].position = Eigen::Vector3d(2.85e-3, 1e-3, 5e-4);
  start[0].velocity = (1 + faster) * Eigen::Vector3d(0.3, 0.1, 0);
  start[1].velocity = Eigen::Vector3d(-0.2, 0, 0.05);
  start[0].omega = Eigen::Vector3d(20, -10, 30);
  start[1].omega = Eigen::Vector3d(-15, 25, 10);
  const double radius[2] = {2.5e-3, 3e-3};
  for (int k = 0; k < 2; ++k) {
    if (as_clusters)
      add_body(session, shape_of("sphere", "1", 2 * radius[k]), start[k]);
    else
      add_sphere(session, start[k], radius[k]);
  }
  session.script("timestep 2e-6\nrun 1500\n");
  Two after;
  for (int k = 0; k < 2; ++k) {
    const int i = session.local(k + 1);
    after.x[k] = Eigen::Map<Eigen::Vector3d>(session.atom().x[i]);
    after.v[k] = Eigen::Map<Eigen::Vector3d>(session.atom().v[i]);
    after.omega[k] = Eigen::Map<Eigen::Vector3d>(session.atom().omega[i]);
  }
  return after;
}

} // namespace

TEST(ContactModels, SingleSpheresHaveStocksDigits) {
  std::vector<std::string> combinations;
  const auto add = [&](const std::string& normal, const std::string& tangential, const std::string& cohesion,
                       const std::string& rolling) {
    combinations.push_back("model " + normal + " tangential " + tangential + " cohesion " + cohesion +
                           " rolling_friction " + rolling);
  };
  const auto adhesive = [](const std::string& normal) { // has what luding's models read
    return normal.find("edinburgh") == 0 || normal == "luding" || normal == "thornton_ning";
  };
  for (const std::string& normal : known("model")) {
    if (normal == "off")
      continue;
    for (const std::string& tangential : known("tangential"))
      if (tangential != "tan_luding" || adhesive(normal))
        add(normal, tangential, "off", "off");
    for (const std::string& rolling : known("rolling_friction"))
      if (rolling != "off" && rolling != "eccentric" && rolling != "shape" && (rolling != "luding" || adhesive(normal)))
        add(normal, "history", "off", rolling);
    for (const std::string& cohesion : known("cohesion"))
      if (cohesion != "off")
        add(normal, "history", cohesion, "off");
  }
  for (const char* form : {"directional", "epsd"})
    combinations.push_back("model hertz tangential history rolling_friction shape form " + std::string(form));
  EXPECT_GT(combinations.size(), 80u);
  for (const std::string& models : combinations) {
    // Some models turn round-off into another path: stock may differ from itself after a start that differs by 1e-12.
    const Two stock = meet(models, false), again = meet(models, false, 1e-12), ours = meet(models, true);
    double speed = 0;
    for (int k = 0; k < 2; ++k)
      speed = std::max({speed, stock.v[k].norm(), stock.omega[k].norm() * 3e-3});
    for (int k = 0; k < 2; ++k) {
      const auto allowed = [](const Eigen::Vector3d& one, const Eigen::Vector3d& other, double scale) {
        return std::max(1e-9 * scale, 10 * (one - other).norm());
      };
      EXPECT_LT((ours.x[k] - stock.x[k]).norm(), allowed(again.x[k], stock.x[k], 3e-3)) << models << ", body " << k;
      EXPECT_LT((ours.v[k] - stock.v[k]).norm(), allowed(again.v[k], stock.v[k], speed)) << models << ", body " << k;
      EXPECT_LT((ours.omega[k] - stock.omega[k]).norm(), allowed(again.omega[k], stock.omega[k], speed / 3e-3))
          << models << ", body " << k;
      EXPECT_LT((again.v[k] - stock.v[k]).norm(), 0.02 * speed) << models << ": no comparison is possible";
    }
    EXPECT_GT((stock.v[0] - Eigen::Vector3d(0.3, 0.1, 0)).norm(), 1e-2) << models << ": they must have met";
  }
  std::printf("%zu combinations of models\n", combinations.size());
}

namespace {

/// Linear springs of a body that lands on a wall with `touching` sub-spheres at once, and what they return.
struct Linear {
  double stiffness, damping_ratio, mass;
  int touching;

  double frequency() const { return std::sqrt(touching * stiffness / mass); }
  double root() const { return std::sqrt(1 - damping_ratio * damping_ratio); }
  /// A contact that ends with the overlap, and one that ends where its force would pull (Schwager & Poeschel 2007).
  double restitution() const { return std::exp(-M_PI * damping_ratio / root()); }
  double without_tension() const { return std::exp(-damping_ratio / root() * (M_PI - 2 * std::asin(damping_ratio))); }
  /// Relative error of the restitution for steps of dt [s]. Half-step velocities in the damper: with a = zeta w dt a
  /// step scales amplitudes by sqrt(1 - 2 a) instead of exp(-a) and turns the phase by a factor 1 + a / (2 (1 -
  /// zeta^2)) too much, which over pi / (w dt root) steps is at most 3/2 pi zeta^2 w dt / root^3. The damper, which
  /// acts at once when bodies touch, misses up to a step at either end: 2 a each.
  double error(double dt) const {
    const double z = damping_ratio, step = frequency() * dt;
    return step * (4 * z + 1.5 * M_PI * z * z / (root() * root() * root()));
  }
};

/// A body falls on a plane on its face and leaves it; velocity over that before.
double returned(const shape::ClusterShape& shape, const std::string& words, const std::string& keywords, double dt) {
  LiggghtsSession session;
  open_box(session, {});
  give_materials(session, {{"gamman", "3500"}, {"kn", "2e4"}});
  session.script("pair_style gran/cluster " + words + " " + keywords +
                 "\npair_coeff * *\nfix floor all wall/gran/cluster " + words + " primitive type 1 zplane 0.0 " +
                 keywords + "\nfix integrate all nve/cluster\n");
  double lowest = 0;
  for (const auto& s : shape.spheres())
    lowest = std::min(lowest, s.centre.z() - s.radius);
  Start start;
  start.position.z() = 1e-6 - lowest;
  start.velocity.z() = -0.3;
  add_body(session, shape, start);
  session.command("timestep " + std::to_string(1e6 * dt) + "e-6");
  session.command("run " + std::to_string(std::lround(6e-3 / dt)));
  return session.atom().v[session.local(1)][2] / 0.3;
}

int touching(const shape::ClusterShape& shape) {
  double lowest = 0;
  for (const auto& s : shape.spheres())
    lowest = std::min(lowest, s.centre.z() - s.radius);
  int count = 0;
  for (const auto& s : shape.spheres())
    count += s.centre.z() - s.radius < lowest + 1e-9;
  return count;
}

} // namespace

// One sub-sphere, or a face of four, nine or 16 at once: linear damped springs return e to within the error of the
// step, and so do they together, with and without tension. The models /stiffness have the damping ratio that one
// contact of the same body has.
TEST(ContactModels, LinearSpringsReturnTheRestitutionToTheErrorOfTheStep) {
  constexpr double e = 0.9, youngs = 5e6 / (2 * (1 - 0.3 * 0.3)), characteristic = 0.5, density = 2619;
  for (const char* model : {"hooke", "hooke/stiffness"})
    for (const bool tension : {true, false})
      for (const char* count : {"1", "8", "27", "64"}) {
        const auto shape = shape_of(std::string(count) == "1" ? "sphere" : "cube", count);
        const double radius = shape.smallest_radius(), mass = density * shape.volume();
        Linear law = {2e4, 3500 * std::sqrt(mass) / (2 * std::sqrt(2e4)), mass, touching(shape)};
        if (std::string(model) == "hooke") {
          law.damping_ratio = -std::log(e) / std::hypot(M_PI, std::log(e));
          law.stiffness =
              16. / 15 * std::sqrt(radius) * youngs *
              std::pow(15 * mass * characteristic * characteristic / (16 * std::sqrt(radius) * youngs), 0.2);
        }
        const double expected = tension ? law.restitution() : law.without_tension();
        const std::string keywords = tension ? "" : "limitForce on",
                          words = std::string("model ") + model + " tangential history";
        for (const double dt : {4e-6, 1e-6}) {
          const double now = returned(shape, words + " contacts shared", keywords, dt);
          std::printf("%s, %s spheres, %s, dt %.0f us: %.5f of %.5f, error %.1e of at most %.1e\n", model, count,
                      tension ? "tension" : "no tension", 1e6 * dt, now, expected, now / expected - 1, law.error(dt));
          EXPECT_NEAR(now, expected, law.error(dt) * expected) << model << " C" << count << " dt " << dt;
        }
        if (law.touching > 1) {
          // Each contact with a damper of its own: sqrt(N) times the damping ratio.
          Linear each = law;
          each.damping_ratio *= std::sqrt(law.touching);
          const double parallel = tension ? each.restitution() : each.without_tension();
          EXPECT_NEAR(returned(shape, words + " contacts parallel", keywords, 1e-6), parallel,
                      each.error(1e-6) * parallel)
              << model << " C" << count << " parallel";
        }
      }
}

TEST(ContactModels, AGrainInAGrooveRollsOutOfIt) {
  // Vyas et al. (2025): between two held spheres 20 times as large, one degree off the top. It
  // rolls about the line through its two contacts and falls off at 0.148 s; with the spring of stock it clings.
  const auto height_after = [](const std::string& arguments, double time) {
    LiggghtsSession session;
    session.script(groove_scene(arguments, "0.005 2.7937481665e-5 0.0016005372526", {"0.01 0 0", "0 0 0"}) +
                   groove_motion);
    session.command("run " + std::to_string(static_cast<int>(time / 5e-7)));
    return session.atom().x[session.local(1)][2];
  };
  constexpr double end = 0.185;
  const double ours = height_after("", end), stock = height_after("tangential_update stock", end);
  std::printf("height of the grain after %.2f s: %.5f m, with the spring of stock %.5f m\n", end, ours, stock);
  EXPECT_LT(ours, -0.005) << "it has fallen freely";
  EXPECT_GT(stock, -0.002)
      << "on the circle about the line between the spheres' centres; this test sees the difference";
}
