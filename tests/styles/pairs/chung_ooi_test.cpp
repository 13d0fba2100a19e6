// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The eight benchmark impacts of spheres of Chung & Ooi (2011), with gran/cluster and wall/gran/cluster, against
// rigid-body and Hertz closed forms (physics.md, D1). One-sphere clusters, so that the clusters' own path is what is
// tested.
#include "styles/bodies/bodies_scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eccentra;
using namespace eccentra::test;

namespace {

/// A sphere's material and the contact's coefficients.
struct Stuff {
  double youngs, poisson, density, restitution = 1, friction = 0;
};

/// Scene of two materials: 1 the sphere's, 2 a wall so stiff that it is rigid. Lengths scale with the sphere's radius.
void open_scene(LiggghtsSession& session, const Stuff& s, double radius, double timestep,
                const std::string& arguments = "") {
  constexpr double rigid = 1e6;
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", value);
    return std::string(text);
  };
  const auto four = [&number](double value) {
    return number(value) + ' ' + number(value) + ' ' + number(value) + ' ' + number(value);
  };
  const std::string half = number(8 * radius);
  session.script("hard_particles yes\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\n"
                 "communicate single vel yes\nunits si\nregion box block -" +
                 half + " " + half + " -" + half + " " + half + " -" + half + " " + half +
                 " units box\ncreate_box 2 box\nneighbor " + number(0.2 * radius) +
                 " bin\nneigh_modify delay 0\nfix m1 all property/global youngsModulus peratomtype " +
                 number(s.youngs) + " " + number(rigid * s.youngs) +
                 "\nfix m2 all property/global poissonsRatio peratomtype " + number(s.poisson) + " " +
                 number(s.poisson) + "\nfix m3 all property/global coefficientRestitution peratomtypepair 2 " +
                 four(s.restitution) + "\nfix m4 all property/global coefficientFriction peratomtypepair 2 " +
                 four(s.friction) + "\ntimestep " + number(timestep) + "\n");
  use_clusters(session, arguments);
}

/// Creates a sphere as a body of one sub-sphere; its tag is the next free one.
void add_ball(LiggghtsSession& session, double radius, double density, const Eigen::Vector3d& x,
              const Eigen::Vector3d& v, const Eigen::Vector3d& omega = Eigen::Vector3d::Zero()) {
  Start start;
  start.position = x;
  start.velocity = v;
  start.omega = omega;
  add_body(session, shape_of("sphere", "1", 2 * radius), start, density);
}

struct Motion {
  Eigen::Vector3d velocity, omega;
};

Motion motion_of(LiggghtsSession& session, int tag) {
  const int i = session.local(tag);
  return {Eigen::Map<Eigen::Vector3d>(session.atom().v[i]), Eigen::Map<Eigen::Vector3d>(session.atom().omega[i])};
}

std::string floor_wall(const std::string& arguments = "") {
  return "fix floor all wall/gran/cluster model hertz tangential history " + arguments +
         " primitive type 2 zplane 0.0\n";
}

/// Duration, largest overlap and largest force of an impact along z, followed step by step.
struct Impact {
  double duration = 0, overlap = 0, force = 0;
};

/// `gap`: overlap of atom 1 with its partner, negative while they do not touch.
template <class Overlap> Impact follow(LiggghtsSession& session, double timestep, Overlap overlap) {
  Impact impact;
  session.command("run 0");
  for (int step = 0; step < 100000; ++step) {
    session.command("run 1 pre no post no");
    const double now = overlap();
    if (now > 0) {
      impact.duration += timestep;
      impact.overlap = std::max(impact.overlap, now);
      impact.force = std::max(impact.force, std::abs(session.atom().f[session.local(1)][2]));
    } else if (impact.duration > 0) {
      break;
    }
  }
  return impact;
}

} // namespace

TEST(ChungOoi, Test1TwoGlassSpheres) {
  const Stuff glass = {48e9, 0.2, 2800};
  constexpr double radius = 0.01, speed = 10, dt = 1e-8;
  LiggghtsSession session;
  open_scene(session, glass, radius, dt);
  add_ball(session, radius, glass.density, {0, 0, -radius - 1e-7}, {0, 0, speed});
  add_ball(session, radius, glass.density, {0, 0, radius + 1e-7}, {0, 0, -speed});
  const Impact impact = follow(session, dt, [&session] {
    return 2 * radius - (session.atom().x[session.local(2)][2] - session.atom().x[session.local(1)][2]);
  });
  EXPECT_NEAR(impact.overlap, 274.1127e-6, 1e-3 * 274e-6);
  EXPECT_NEAR(impact.force, 10.69689e3, 1e-3 * 10.7e3);
  EXPECT_NEAR(impact.duration, 40.339e-6, 2e-3 * 40e-6);
}

TEST(ChungOoi, Test2AluminiumSphereOnARigidPlane) {
  const Stuff alloy = {70e9, 0.3, 2699};
  constexpr double radius = 0.1, speed = 0.2, dt = 2e-7;
  LiggghtsSession session;
  open_scene(session, alloy, radius, dt);
  add_ball(session, radius, alloy.density, {0, 0, radius + 1e-8}, {0, 0, -speed});
  session.script(floor_wall());
  const Impact impact = follow(session, dt, [&session] { return radius - session.atom().x[session.local(1)][2]; });
  EXPECT_NEAR(impact.overlap, 49.717e-6, 1e-3 * 50e-6);
  EXPECT_NEAR(impact.force, 11.36986e3, 1e-3 * 11.4e3);
  EXPECT_NEAR(impact.duration, 731.66e-6, 2e-3 * 732e-6);
}

namespace {

constexpr double small_radius = 2.5e-3, resultant = 3.9;
/// Aluminium oxide; the contact lasts about 1e-5 s.
const Stuff oxide = {3.8e11, 0.23, 4000, 0.98, 0.092};

/// A sphere hits the rigid plane z = 0 and leaves it.
Motion rebound(const Stuff& s, double radius, const Eigen::Vector3d& velocity, const Eigen::Vector3d& omega,
               const std::string& arguments = "") {
  const double mass = s.density * 4 * M_PI / 3 * std::pow(radius, 3);
  const double kn = 4. / 3 * s.youngs / (1 - s.poisson * s.poisson) * std::sqrt(radius);
  const double vn = -velocity.z();
  const double duration = 2.94327 * std::pow(5 * mass * vn * vn / (4 * kn), 0.4) / vn;
  constexpr int steps = 2000;
  const double dt = duration / steps;
  LiggghtsSession session;
  open_scene(session, s, radius, dt, arguments);
  add_ball(session, radius, s.density, {0, 0, radius + vn * dt}, velocity, omega);
  session.script(floor_wall(arguments));
  session.command("run " + std::to_string(3 * steps));
  EXPECT_GT(session.atom().x[session.local(1)][2], radius) << "it must have left";
  return motion_of(session, 1);
}

} // namespace

TEST(ChungOoi, Test3RestitutionFrom20To100Percent) {
  for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    Stuff s = oxide;
    s.restitution = e;
    const Motion m = rebound(s, small_radius, {0, 0, -resultant}, Eigen::Vector3d::Zero());
    EXPECT_NEAR(m.velocity.z(), e * resultant, 1e-3 * resultant) << "e " << e;
  }
}

TEST(ChungOoi, Test4ObliqueImpactsAtOneSpeed) {
  // Angles from the normal; below 32.5 degrees the contact sticks in part, which depends on the tangential stiffness.
  for (const double angle : {35., 45., 60., 75.}) {
    const double vn = resultant * std::cos(angle * M_PI / 180), vt = resultant * std::sin(angle * M_PI / 180);
    const Motion m = rebound(oxide, small_radius, {vt, 0, -vn}, Eigen::Vector3d::Zero());
    const double impulse = oxide.friction * (1 + oxide.restitution) * vn; // tangential, over the mass
    EXPECT_NEAR(m.velocity.x(), vt - impulse, 2e-3 * resultant) << angle;
    EXPECT_NEAR(m.omega.y(), 2.5 * impulse / small_radius, 5e-3 * 2.5 * impulse / small_radius) << angle;
    if (angle == 45.) { // computed once in high precision
      EXPECT_NEAR(m.velocity.x(), 2.255370819, 2e-3 * resultant);
      EXPECT_NEAR(m.omega.y(), 502.345628, 2.5);
    }
  }
}

TEST(ChungOoi, Test5ObliqueImpactsOfATinySphereAtOneNormalSpeed) {
  const Stuff steel = {208e9, 0.3, 7850, 1, 0.3};
  constexpr double radius = 1e-5, vn = 5;
  for (const double vt : {12., 20., 40.}) { // gross sliding beyond 3.5 mu (1 + e) v_n = 10.5 m/s
    const Motion m = rebound(steel, radius, {vt, 0, -vn}, Eigen::Vector3d::Zero());
    const double impulse = steel.friction * 2 * vn;
    EXPECT_NEAR(m.velocity.z(), vn, 1e-3 * vn) << vt;
    EXPECT_NEAR(m.velocity.x(), vt - impulse, 5e-3 * vt) << vt;
    EXPECT_NEAR(m.omega.y(), 2.5 * impulse / radius, 5e-3 * 2.5 * impulse / radius) << vt;
  }
}

namespace {

/// Tests 6 to 8: an aluminium alloy, e = 0.5. Stock's law cuts friction at mu |F_n| of the whole normal force; at this
/// e its damper pulls at the end of a contact, and friction counts that pull, too (last test). Cut at the elastic
/// force, as in the paper's law, the impulse of friction is mu (1 + e) m v_n exactly. That law returns more than the e
/// typed (2 beta instead of sqrt(5) beta): this e returns 0.5.
constexpr const char* elastic_cap = "damping paper tangential_damping off";

double typed_for(double e) {
  const double beta = std::sqrt(5.) / 2 * -std::log(e) / std::hypot(M_PI, std::log(e));
  return std::exp(-M_PI * beta / std::sqrt(1 - beta * beta));
}

constexpr double returned = 0.5;
const Stuff alloy = {70e9, 0.33, 2700, typed_for(returned), 0.4};
constexpr double big_radius = 0.1, normal_speed = 0.2;
struct Spin {
  double before, velocity, after;
};
/// Sliding beyond w0 R = 3.5 mu (1 + e) v_n = 0.42 m/s.
constexpr Spin spins[] = {{5, 0.12, 2}, {8, 0.12, 5}, {12, 0.12, 9}};

} // namespace

TEST(ChungOoi, Test6SpinningSphereOnARigidPlane) {
  for (const Spin& spin : spins) {
    const Motion m = rebound(alloy, big_radius, {0, 0, -normal_speed}, {0, spin.before, 0}, elastic_cap);
    EXPECT_NEAR(m.velocity.z(), returned * normal_speed, 1e-3 * normal_speed);
    EXPECT_NEAR(m.velocity.x(), spin.velocity, 5e-3 * spin.velocity) << spin.before;
    EXPECT_NEAR(m.omega.y(), spin.after, 5e-3 * spin.before) << spin.before;
  }
}

namespace {

/// Two spheres run into each other along z at +-normal_speed, both with this spin about y.
std::array<Motion, 2> meet(double radius_1, double radius_2, const Eigen::Vector3d& spin_1,
                           const Eigen::Vector3d& spin_2) {
  constexpr double dt = 2e-7;
  LiggghtsSession session;
  open_scene(session, alloy, big_radius, dt, elastic_cap);
  add_ball(session, radius_1, alloy.density, {0, 0, -radius_1 - 1e-7}, {0, 0, normal_speed}, spin_1);
  add_ball(session, radius_2, alloy.density, {0, 0, radius_2 + 1e-7}, {0, 0, -normal_speed}, spin_2);
  session.command("run 12000");
  EXPECT_GT(session.atom().x[session.local(2)][2] - session.atom().x[session.local(1)][2], radius_1 + radius_2)
      << "they must have parted";
  return {motion_of(session, 1), motion_of(session, 2)};
}

} // namespace

TEST(ChungOoi, Test7TwoEqualSpinningSpheres) {
  for (const Spin& spin : spins) {
    // Spins of one sense rub against each other: the plane between the spheres is a wall to both.
    const auto after = meet(big_radius, big_radius, {0, spin.before, 0}, {0, spin.before, 0});
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(std::abs(after[k].velocity.z()), returned * normal_speed, 1e-3 * normal_speed);
      EXPECT_NEAR(std::abs(after[k].velocity.x()), spin.velocity, 5e-3 * spin.velocity) << spin.before;
      EXPECT_NEAR(after[k].omega.y(), spin.after, 5e-3 * spin.before) << spin.before;
    }
    EXPECT_LT(after[0].velocity.x() * after[1].velocity.x(), 0);
  }
}

TEST(ChungOoi, Test8SpinningSphereMeetsASmallOne) {
  constexpr double small = 0.02;
  const auto mass = [](double r) { return alloy.density * 4 * M_PI / 3 * r * r * r; };
  const double effective = 1 / (1 / mass(big_radius) + 1 / mass(small));
  const double impulse = alloy.friction * (1 + returned) * effective * 2 * normal_speed;
  for (const double spin : {12., 20.}) {
    ASSERT_GT(spin * big_radius, 3.5 * impulse / effective) << "it must slide to the end";
    const auto after = meet(big_radius, small, {0, spin, 0}, Eigen::Vector3d::Zero());
    const auto spin_change = [&](double r) { return impulse * r / (0.4 * mass(r) * r * r); };
    EXPECT_NEAR(after[1].velocity.z() - after[0].velocity.z(), returned * 2 * normal_speed, 2e-3 * normal_speed);
    // The top of the big sphere moves along +x: it drags the small one with it, and is held back.
    EXPECT_NEAR(after[1].velocity.x(), impulse / mass(small), 5e-3 * impulse / mass(small)) << spin;
    EXPECT_NEAR(after[0].velocity.x(), -impulse / mass(big_radius), 5e-3 * impulse / mass(big_radius)) << spin;
    EXPECT_NEAR(after[0].omega.y(), spin - spin_change(big_radius), 5e-3 * spin) << spin;
    EXPECT_NEAR(after[1].omega.y(), -spin_change(small), 5e-3 * spin_change(small)) << spin;
  }
}

TEST(ChungOoi, SlidingImpactsObeyCoulombAtAnyRestitution) {
  // The bound on the elastic force, for spring and damper together: over an impact the dampers' part of F_n sums up to
  // 0, so that the impulse of friction is mu (1 + e) m v_n.
  for (const double e : {0.3, 0.5, 0.9}) {
    Stuff s = alloy;
    s.restitution = e;
    const Motion m = rebound(s, big_radius, {0, 0, -normal_speed}, {0, 12, 0});
    const double coulomb = s.friction * (1 + e) * normal_speed;
    EXPECT_NEAR(m.velocity.z(), e * normal_speed, 1e-3 * normal_speed) << e;
    EXPECT_NEAR(m.velocity.x(), coulomb, 5e-3 * coulomb) << "e " << e;
  }
}

TEST(ChungOoi, StocksCapOnTheWholeNormalForceCountsThePullOfItsDamper) {
  // The normal motion d'' = -d^1.5 - gamma d^0.25 d' of a contact with kn = m = v_n = 1, by the midpoint rule.
  for (const double e : {0.5, 0.9}) {
    const double beta = -std::log(e) / std::hypot(M_PI, std::log(e));
    const double gamma = 2 * std::sqrt(5. / 6) * beta * std::sqrt(1.5); // S = 3/2 kn d^0.5
    double d = 0, v = 1, absolute = 0;
    constexpr double h = 1e-5;
    const auto force = [gamma](double at, double speed) {
      const double depth = std::max(at, 0.);
      return -std::pow(depth, 1.5) - gamma * std::pow(depth, 0.25) * speed;
    };
    while (d >= 0) {
      const double middle = v + h / 2 * force(d, v), half = d + h / 2 * v;
      const double f = force(half, middle);
      absolute += h * std::abs(f);
      d += h * middle;
      v += h * f;
    }
    EXPECT_NEAR(-v, e, 1e-3);
    Stuff s = alloy;
    s.restitution = e;
    const Motion m =
        rebound(s, big_radius, {0, 0, -normal_speed}, {0, 12, 0}, "friction_bound stock tangential_damping off");
    EXPECT_NEAR(m.velocity.x(), s.friction * absolute * normal_speed, 5e-3 * m.velocity.x()) << "e " << e;
    const Motion damped = rebound(s, big_radius, {0, 0, -normal_speed}, {0, 12, 0}, "friction_bound stock");
    const double coulomb = s.friction * (1 + e) * normal_speed;
    std::printf("e %.1f: impulse of friction over mu (1 + e) m v_n: %.3f, with stock's tangential damping %.3f\n", e,
                m.velocity.x() / coulomb, damped.velocity.x() / coulomb);
    EXPECT_GT(damped.velocity.x(), m.velocity.x());
  }
}
