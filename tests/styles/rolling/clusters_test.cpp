// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rolling friction of clusters at walls and between each other, against closed forms: each body resists as one contact
// does, however many of its spheres touch.
#include "styles/rolling/cluster_scene.h"

#include <gtest/gtest.h>

#include <utility>

using namespace eccentra::test;

namespace {

long steps_for(const RollingScene& scene, double time) {
  return std::lround(time / scene.timestep);
}

std::string name_of(const ::testing::TestParamInfo<ClusterModel>& info) {
  return info.param.name;
}

/// Smallest of the series that `next` gives before it rises again, given that it falls at first.
template <class Next> double first_minimum(Next next) {
  double last = next(), least = last;
  for (int k = 0; k < 100000; ++k) {
    const double now = next();
    if (now > last && now < 0)
      return least;
    last = now;
    least = std::min(least, now);
  }
  ADD_FAILURE() << "no minimum was met";
  return least;
}

/// A damped oscillator that starts from rest position with velocity 1 comes back with minus this velocity at most.
double returned(double ratio) {
  return std::exp(-ratio * (kPi - 2 * std::asin(ratio)) / std::sqrt(1 - ratio * ratio));
}

} // namespace

class RollingModels : public ::testing::TestWithParam<ClusterModel> {};

// dv/dt = -5/7 mu g, for one sphere and for rows of them, and what is left of the way is 7 v^2 / (10 mu g). Stock's
// springs, whose dashpot nothing bounds, take more than that until they have given way: the first quarter is left out.
TEST_P(RollingModels, RollersRollToRest) {
  const double mu = 0.1, v0 = 0.1, slowing = 5. / 7 * mu * kGravity, time = v0 / slowing;
  for (const int count : {1, 2, 4}) {
    const RollingScene scene = scene_of(GetParam(), mu);
    LiggghtsSession session;
    open_cluster_scene(session, scene, "contacts shared");
    const int tag = add_roller_on_floor(session, scene, count);
    set_motion(session, tag, {v0, 0, 0}, {0, v0 / kRadius, 0});
    run(session, steps_for(scene, time / 4));
    const SphereState rolling = sphere(session, tag);
    run(session, steps_for(scene, time / 4));
    EXPECT_NEAR(sphere(session, tag).v[0], rolling.v[0] - slowing * time / 4, 0.003 * v0) << count;
    run(session, steps_for(scene, rolling.v[0] / slowing * 1.02 - time / 4));
    const SphereState end = sphere(session, tag);
    const double distance = 0.5 * rolling.v[0] * rolling.v[0] / slowing;
    EXPECT_NEAR(end.x[0] - rolling.x[0], distance, 0.01 * distance) << count;
    EXPECT_LT(std::abs(end.v[0]), 0.05 * v0) << count; // springs recoil
    EXPECT_LT(std::abs(end.x[1]), 1e-6 * distance) << count;
  }
}

// A slope of 10 degrees holds them where mu = 0.32, and they roll down as spheres do where mu = 0.1.
TEST_P(RollingModels, RollersRestOnASlopeThatIsNotSteep) {
  const double angle = 10 * kPi / 180;
  for (const int count : {1, 4}) {
    for (const double mu : {0.32, 0.1}) {
      RollingScene scene = scene_of(GetParam(), mu);
      scene.gravity = {std::sin(angle), 0, -std::cos(angle)};
      LiggghtsSession session;
      open_cluster_scene(session, scene, "contacts shared");
      const int tag = add_roller_on_floor(session, scene, count);
      run(session, steps_for(scene, 0.3));
      const SphereState before = sphere(session, tag);
      run(session, steps_for(scene, 0.2));
      const SphereState end = sphere(session, tag);
      if (mu < std::tan(angle)) {
        const double a = 5. / 7 * kGravity * (std::sin(angle) - mu * std::cos(angle));
        EXPECT_NEAR((end.v[0] - before.v[0]) / 0.2, a, 0.01 * a) << count;
      } else if (GetParam().rest == ClusterModel::holds) {
        EXPECT_LT(end.v.norm(), 1e-9) << count;
        EXPECT_LT((end.x - before.x).norm(), 1e-9) << count;
      } else { // springs swing by what they give under the load; others creep at the speed that a step of falling gives
        const bool creeps = GetParam().rest == ClusterModel::creeps;
        EXPECT_LT((end.x - before.x).norm(), creeps ? 0.2 * kGravity * scene.timestep : 1e-3 * kDiameter) << count;
      }
    }
  }
}

// |r_ij| of eq (19): the contacts of a row of four lie at y = +-R and +-3 R, sqrt(1 + y^2 / R^2) R from its centre.
TEST_P(RollingModels, RadiusOfTheBodyIsTheDistanceFromItsCentre) {
  const double mu = 0.1, v0 = 0.1;
  const double farther = (std::sqrt(2) + std::sqrt(10)) / 2;
  const double slowing = 5. / 7 * mu * farther * kGravity, time = v0 / slowing / 4;
  const RollingScene scene = scene_of(GetParam(), mu);
  LiggghtsSession session;
  open_cluster_scene(session, scene, "contacts shared rolling_radius body");
  const int tag = add_roller_on_floor(session, scene, 4);
  set_motion(session, tag, {v0, 0, 0}, {0, v0 / kRadius, 0});
  run(session, steps_for(scene, time));
  const double rolling = sphere(session, tag).v[0];
  run(session, steps_for(scene, time));
  EXPECT_NEAR(sphere(session, tag).v[0], rolling - slowing * time, 0.003 * v0);
}

INSTANTIATE_TEST_SUITE_P(Clusters, RollingModels, ::testing::ValuesIn(cluster_models()), name_of);

// Eq (19) resists torsion: a cube that turns on a face of 4, 9 or 16 spheres loses mu R m g / I, and with
// `torsionTorque off` nothing.
TEST(RollingFaces, TorsionIsThatOfOneContact) {
  const double mu = 0.2, spin = 20, time = 0.01;
  for (const char* form : {"limited", "epsd", "directional"})
    for (const char* sharing : {"shared", "parallel friction_bound elastic"}) // stock's bound leaves the damper alone
      for (const char* torsion : {"", " torsionTorque off"})
        for (const char* count : {"8", "27", "64"}) {
          RollingScene scene;
          scene.mu_shape = mu;
          scene.mu_s = 0;
          scene.arguments = std::string("form ") + form + torsion;
          LiggghtsSession session;
          open_cluster_scene(session, scene, std::string("contacts ") + sharing);
          std::size_t used = 0;
          const auto cube = eccentra::shape::make_shape({"cube", count}, 0, used, kDiameter);
          double lowest = 0;
          int touching = 0;
          for (const auto& s : cube.spheres())
            lowest = std::min(lowest, s.centre.z() - s.radius);
          for (const auto& s : cube.spheres())
            touching += s.centre.z() - s.radius < lowest + 1e-9;
          const double radius = cube.smallest_radius();
          const double weight = kDensity * cube.volume() * kGravity;
          const double overlap = resting_overlap(scene, weight / touching) * std::cbrt(kRadius / radius);
          const int tag = add_cluster(session, cube, {0, 0, -lowest - overlap});
          set_motion(session, tag, {0, 0, 0}, {0, 0, spin});
          run(session, steps_for(scene, time));
          const double inertia = kDensity * cube.volume() * cube.inertia_per_mass()[2];
          const double lost = *torsion ? 0 : mu * radius * weight / inertia * time;
          EXPECT_NEAR(sphere(session, tag).omega[2], spin - lost, 0.01 * lost + 1e-9)
              << form << " " << sharing << " C" << count << torsion;
        }
}

// Below the bound spring and damper of epsd make a roller an oscillator about its line of contact, with the given
// damping ratio however many spheres it has. With a damper for each contact the ratio is sqrt(N) times the given one.
TEST(RollingDampers, FloorsShareThem) {
  const double ratio = 0.3;
  for (const ClusterModel& model : cluster_models()) {
    const std::string name = model.name;
    if (name != "spring" && name != "epsd" && name != "epsd3")
      continue;
    for (const int count : {1, 2, 4})
      for (const bool shared : {true, false}) {
        RollingScene scene = scene_of(model, 0.1);
        scene.timestep = 2e-6;
        LiggghtsSession session;
        open_cluster_scene(session, scene, shared ? "contacts shared" : "contacts parallel", ratio);
        const int tag = add_roller_on_floor(session, scene, count);
        const double v0 = 1e-5;
        set_motion(session, tag, {v0, 0, 0}, {0, v0 / kRadius, 0});
        const double least = first_minimum([&] {
          run(session, 20);
          return sphere(session, tag).omega[1] * kRadius / v0;
        });
        const double expected = returned(shared ? ratio : ratio * std::sqrt(count));
        EXPECT_NEAR(-least, expected, 0.01) << name << ", " << count << (shared ? " shared" : " parallel");
      }
  }
}

// Two rollers run against each other like gears, each about an axle that stands still: 0.4 m R^2 each, where the model
// reckons with 1.4 m R^2. The damping ratio is sqrt(1.4 / 0.4) times the given one, for each number of contacts.
TEST(RollingDampers, PairsShareThem) {
  const double ratio = 0.16, push = 1e-2; // N for each sphere
  for (const char* model : {"epsd", "epsd3"})
    for (const int count : {1, 2, 4})
      for (const bool shared : {true, false}) {
        RollingScene scene;
        scene.model = model;
        scene.mu_r = 0.1;
        scene.walls = "";
        scene.gravity = {0, 0, 0};
        scene.timestep = 2e-6;
        scene.mu_s = 0.5;
        LiggghtsSession session;
        open_cluster_scene(session, scene, shared ? "contacts shared" : "contacts parallel", ratio);
        // Hertz between two spheres has half the radius.
        const double half = 0.5 * resting_overlap(scene, push) * std::cbrt(2.);
        const int left = add_roller(session, count, {-kRadius + half, 0, 0.05});
        const int right = add_roller(session, count, {kRadius - half, 0, 0.05});
        session.script("group left id " + std::to_string(left) + "\ngroup right id " + std::to_string(right) +
                       "\nfix p1 left addforce " + number(push * count) + " 0 0\nfix p2 right addforce " +
                       number(-push * count) + " 0 0\n");
        const double spin = 1e-3;
        set_motion(session, left, {0, 0, 0}, {0, spin, 0});
        set_motion(session, right, {0, 0, 0}, {0, -spin, 0});
        const double least = first_minimum([&] {
          run(session, 20);
          return sphere(session, left).omega[1] / spin;
        });
        const double expected = returned(std::sqrt(1.4 / 0.4) * ratio * (shared ? 1 : std::sqrt(count)));
        EXPECT_NEAR(-least, expected, 0.01) << model << ", " << count << (shared ? " shared" : " parallel");
        EXPECT_NEAR(sphere(session, left).omega[1], -sphere(session, right).omega[1], 1e-9 * spin);
      }
}

// A roller that slides through an impact loses mu (1 + e) v_n, whatever e and however many spheres it has; with the
// bound of stock, which counts the pull of the damper and leaves the tangential damper free, up to 1.45 times as much.
TEST(RollersThatSlide, ObeyCoulombAtAnyRestitution) {
  const double mu = 0.3, vn = 0.2, vt = 2;
  for (const std::string model : {"", " cohesion sjkr"}) // in blocks, and through LIGGGHTS's own classes
    for (const auto& [e, with_stocks_bound] : {std::pair(0.3, 1.449), std::pair(0.5, 1.168), std::pair(0.9, 1.004)})
      for (const bool stock : {false, true})
        for (const int count : {1, 2, 4}) {
          RollingScene scene;
          scene.model = "off";
          scene.mu_r = scene.mu_shape = 0;
          scene.mu_s = mu;
          scene.restitution = e;
          scene.gravity = {0, 0, 0};
          scene.timestep = 2e-7;
          LiggghtsSession session;
          open_cluster_scene(session, scene, "contacts shared" + model + (stock ? " friction_bound stock" : ""));
          session.command("fix s4 all property/global cohesionEnergyDensity peratomtypepair 1 0");
          const int tag = add_roller(session, count, {0, 0, kRadius + vn * scene.timestep});
          set_motion(session, tag, {vt, 0, -vn}, {0, 0, 0});
          run(session, 10000);
          const SphereState end = sphere(session, tag);
          EXPECT_NEAR(end.v[2], e * vn, 2e-3 * vn) << model << " e " << e << ", " << count;
          const double lost = (vt - end.v[0]) / (mu * (1 + e) * vn);
          std::printf("hertz%s, e %.1f, %d: %.4f of mu (1 + e) v_n%s\n", model.c_str(), e, count, lost,
                      stock ? ", bound of stock" : "");
          EXPECT_NEAR(end.omega[1] * kRadius, 2.5 * (vt - end.v[0]), 0.01 * 2.5 * (vt - end.v[0]));
          EXPECT_NEAR(lost, stock ? with_stocks_bound : 1, 3e-3) << model << " e " << e << ", " << count;
        }
}
