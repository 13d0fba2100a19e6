// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Duration and peak force of flat drops: contacts shared, contacts parallel and stock fix multisphere against the
// closed form of N Hertz contacts side by side. Sharing scales damping alone, so elastic impacts are the same in all
// three.
#include "base/linear_algebra.h"
#include "styles/bodies/bodies_scene.h"

#include "fix_multisphere.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr double diameter = 6.35e-3, density = 2619, speed = 0.3, timestep = 5e-7, youngs = 5e6, poisson = 0.3;

struct Level {
  std::string family, count;
  int contacts; ///< of its face with a plane
};
const Level levels[] = {
    {"sphere", "1", 1}, {"cube", "8", 4}, {"cube", "27", 9}, {"cube", "64", 16}, {"disk", "48", 48}};

/// What an impact does, and what Hertz says.
struct Contact {
  double duration, peak_force, restitution;
};

/// Face down, in a frame that carries body axes to world.
Eigen::Quaterniond face_down(const shape::ClusterShape& shape) {
  int axis = 0;
  const double largest = shape.inertia_per_mass().maxCoeff(&axis), smallest = shape.inertia_per_mass().minCoeff();
  return largest > 1.5 * smallest
             ? eccentra::base::rotation_between(Eigen::Vector3d::Unit(axis), Eigen::Vector3d::UnitZ())
             : Eigen::Quaterniond::Identity();
}

double depth_of(const shape::ClusterShape& shape) {
  double depth = 0;
  for (const auto& s : shape.spheres())
    depth = std::max(depth, s.radius - (face_down(shape) * s.centre).z());
  return depth;
}

/// The damped oscillator d'' = -d^1.5 - gamma d^0.25 d' of N contacts with stock's damper `dampers` times over, by the
/// midpoint rule; duration until the overlap is gone.
Contact closed_form(const Level& level, const shape::ClusterShape& shape, double e, double dampers) {
  const double mass = density * shape.volume();
  const double kn =
      level.contacts * 4. / 3 * youngs / (2 * (1 - poisson * poisson)) * std::sqrt(shape.smallest_radius());
  const double beta = -std::log(e) / std::hypot(M_PI, std::log(e));
  const double gamma = dampers * std::sqrt(5.) * beta; // in units of kn, mass and speed
  const double time = std::pow(mass / (kn * std::sqrt(speed)), 0.4), force_unit = mass * speed / time;
  double d = 0, v = 1, t = 0, peak = 0;
  constexpr double h = 2e-5;
  const auto acceleration = [gamma](double at, double rate) {
    const double depth = std::max(at, 0.);
    return -std::pow(depth, 1.5) - gamma * std::pow(depth, 0.25) * rate;
  };
  while (d >= 0) {
    const double a = acceleration(d + h / 2 * v, v + h / 2 * acceleration(d, v));
    d += h * (v + h / 2 * a);
    v += h * a;
    t += h;
    peak = std::max(peak, -a);
  }
  return {t * time, peak * force_unit, -v};
}

/// Follows height and velocity from step to step.
template <class Height, class Velocity>
Contact follow(LiggghtsSession& session, double mass, double touch, Height height, Velocity velocity) {
  Contact contact = {0, 0, 0};
  session.command("run 0");
  double before = velocity();
  for (int step = 0; step < 40000; ++step) {
    session.command("run 1 pre no post no");
    const double now = velocity();
    contact.peak_force = std::max(contact.peak_force, mass * (now - before) / timestep);
    before = now;
    if (height() < touch)
      contact.duration += timestep;
    else if (contact.duration > 0)
      break;
  }
  contact.restitution = velocity() / speed;
  return contact;
}

Contact ours(const shape::ClusterShape& shape, double e, const std::string& arguments) {
  LiggghtsSession session;
  Material material;
  material.youngs = youngs;
  material.restitution = e;
  open_box(session, material);
  use_clusters(session, arguments);
  Start start;
  start.orientation = face_down(shape);
  start.position.z() = depth_of(shape) + 2 * speed * timestep;
  start.velocity.z() = -speed;
  add_body(session, shape, start, density);
  session.script("timestep " + std::to_string(timestep * 1e6) + "e-6\nfix floor all wall/gran/cluster model hertz " +
                 "tangential history " + arguments + " primitive type 1 zplane 0\n");
  return follow(
      session, density * shape.volume(), depth_of(shape), [&] { return session.atom().x[session.local(1)][2]; },
      [&] { return session.atom().v[session.local(1)][2]; });
}

Contact stock(const Level& level, const shape::ClusterShape& shape, double e) {
  LiggghtsSession session;
  Material material;
  material.youngs = youngs;
  material.restitution = e;
  open_box(session, material);
  const Eigen::Quaterniond q = face_down(shape);
  const double height = depth_of(shape) + 2 * speed * timestep;
  char place[200], turn[200];
  std::snprintf(place, sizeof place, "-1e-6 1e-6 -1e-6 1e-6 %.15g %.15g volume_limit 1e-24 units box", height,
                height + 1e-10);
  std::snprintf(turn, sizeof turn, "%.15g %.15g %.15g %.15g", q.w(), q.x(), q.y(), q.z());
  session.script(
      "pair_style gran model hertz tangential history\npair_coeff * *\ntimestep " + std::to_string(timestep * 1e6) +
      "e-6\nfix pts all particletemplate/multisphere/shape 15485863 atom_type 1 density constant 2619 shape " +
      level.family + " " + level.count + " diameter 6.35e-3\n" +
      "fix pdd all particledistribution/discrete 32452843 1 pts 1.0\nregion place block " + place +
      "\nfix ins all insert/pack seed 49979687 distributiontemplate pdd insert_every once overlapcheck no verbose no "
      "orientation constant " +
      turn + " all_in no vel constant 0 0 -0.3 particles_in_region 1 region place\n" +
      "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0\n" +
      "fix integrate all multisphere\nrun 1\n");
  auto& data = dynamic_cast<LAMMPS_NS::FixMultisphere*>(session.lammps().modify->find_fix_id("integrate"))->data();
  const auto component = [&](bool velocity) {
    double value[3];
    if (velocity)
      data.vcm(value, 0);
    else
      data.xcm(value, 0);
    return value[2];
  };
  return follow(
      session, density * shape.volume(), depth_of(shape), [&] { return component(false); },
      [&] { return component(true); });
}

void expect_close(const Contact& c, const Contact& expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(c.duration, expected.duration, tolerance * expected.duration) << what;
  EXPECT_NEAR(c.peak_force, expected.peak_force, tolerance * expected.peak_force) << what;
  EXPECT_NEAR(c.restitution, expected.restitution, tolerance) << what;
}

void print(const char* code, const Contact& c) {
  std::printf("    %-9s %6.3f ms  %7.4f N  %.3f\n", code, 1e3 * c.duration, c.peak_force, c.restitution);
}

} // namespace

TEST(ContactTime, FlatDropsAgainstHertzAndStock) {
  for (const Level& level : levels) {
    const shape::ClusterShape shape = shape_of(level.family, level.count, diameter);
    for (const double e : {0.999999, 0.9}) {
      const std::string what = level.family + " " + level.count + ", e " + (e < 0.95 ? "0.9" : "1");
      const double side_by_side = std::sqrt(static_cast<double>(level.contacts));
      const Contact one = closed_form(level, shape, e, 1), many = closed_form(level, shape, e, side_by_side);
      const Contact shared = ours(shape, e, "contacts shared"), parallel = ours(shape, e, "contacts parallel");
      std::printf("%s: duration, peak force, restitution\n", what.c_str());
      print("one affair", one);
      print("shared", shared);
      print("N dampers", many);
      print("parallel", parallel);
      expect_close(shared, one, 0.005, what + ", shared");
      expect_close(parallel, many, 0.005, what + ", parallel");
      if (level.contacts > 1) {
        const Contact host = stock(level, shape, e);
        print("stock", host);
        expect_close(host, many, 0.01, what + ", stock");
        expect_close(parallel, host, 0.01, what + ", parallel and stock");
      }
    }
  }
}
