// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies in motion, without any host: their manifolds, the contact law of the pair style, planes and a
// leapfrog. Small and slow; what the tests of contacts need.
#pragma once

#include "contact/contact_models.h"
#include "contact/feature_search.h"
#include "contact/manifold.h"
#include "contact/random_poses.h"
#include "contact/shared_contacts.h"
#include "contact/wall_manifold.h"
#include "shape/cluster_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace small_dem {
using eccentra::contact::BodyPair;
using eccentra::contact::Contact;
using eccentra::contact::ContactBody;
using eccentra::contact::ContactCore;
using eccentra::contact::FeatureSearch;
using eccentra::contact::Manifolds;
using eccentra::contact::PosedCore;
using eccentra::shape::RoundedHull;
using eccentra::test::made;
using eccentra::test::Random;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A shape as bodies share it.
struct Species {
  explicit Species(const RoundedHull& hull) : core(hull), inertia(hull.inertia_per_mass()), volume(hull.volume()) {}
  Species(const ContactCore& core, const Vector3d& inertia, double volume)
      : core(core), inertia(inertia), volume(volume) {}
  ContactCore core;
  Vector3d inertia; ///< per mass
  double volume;
};

struct Material {
  double youngs = 5e6, poisson = 0.3, restitution = 0.5, friction = 0.5, density = 2619;
  double effective_youngs() const { return youngs / (2 * (1 - poisson * poisson)); }
  double effective_shear() const { return youngs / (4 * (2 - poisson) * (1 + poisson)); }
  double damping() const {
    const double l = std::log(restitution);
    return restitution >= 1 ? 0 : -l / std::sqrt(M_PI * M_PI + l * l);
  }
};

struct Body {
  const Species* species;
  double mass;
  Vector3d x, v = Vector3d::Zero(), angular_momentum = Vector3d::Zero(), omega = Vector3d::Zero();
  Quaterniond q = Quaterniond::Identity();
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  double path = 0; ///< how far any of its matter can have moved [m]
  PosedCore posed;
};

inline Quaterniond turned(const Quaterniond& q, const Vector3d& rotation) {
  const double angle = rotation.norm();
  if (angle == 0)
    return q;
  return (Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)) * q).normalized();
}

class SmallDem {
 public:
  explicit SmallDem(const Material& material) : material(material) {}
  Material material;
  double dt = 2e-5, gravity = 0;
  Vector3d down = -Vector3d::UnitZ();
  struct Plane {
    Vector3d normal;
    double offset;
  };
  std::vector<Plane> planes;
  double hole = 0; ///< radius of a hollow cylinder about the z axis
  double pipe = 0; ///< radius of a full one
  std::vector<Body> bodies;

  // Of the last step.
  int contacts = 0, wall_contacts = 0;
  double most_sunk = 0, most_overlap = 0; ///< [m], over the reach; since they were set to 0
  long searches = 0;

  Body& add(const Species& species, const Vector3d& x, const Vector3d& v = Vector3d::Zero(),
            const Quaterniond& q = Quaterniond::Identity(), const Vector3d& omega = Vector3d::Zero()) {
    Body b;
    b.species = &species;
    b.mass = material.density * species.volume;
    b.x = x;
    b.v = v;
    b.q = q;
    const Matrix3d r = q.toRotationMatrix();
    b.angular_momentum = b.mass * (r * species.inertia.asDiagonal() * r.transpose() * omega);
    b.omega = omega;
    b.posed.pose(species.core, r);
    bodies.push_back(b);
    started_ = false;
    return bodies.back();
  }

  double kinetic_energy() const {
    double sum = 0;
    for (const Body& b : bodies)
      sum += b.mass * b.v.squaredNorm() / 2 + b.omega.dot(b.angular_momentum) / 2;
    return sum;
  }

  void step() {
    if (!started_)
      forces(false);
    started_ = true;
    for (Body& b : bodies) {
      b.v += dt / 2 / b.mass * b.force;
      b.angular_momentum += dt / 2 * b.torque;
      b.x += dt * b.v;
      // The orientation by the angular velocity at the middle of the step.
      const Vector3d now = angular_velocity(b, b.q);
      Vector3d middle = angular_velocity(b, turned(b.q, dt / 2 * now));
      middle = angular_velocity(b, turned(b.q, dt / 2 * middle));
      b.q = turned(b.q, dt * middle);
      b.omega = angular_velocity(b, b.q);
      b.path += dt * (b.v.norm() + middle.norm() * b.species->core.bound);
      b.posed.pose(b.species->core, b.q.toRotationMatrix());
    }
    time += dt;
    forces(true);
    for (Body& b : bodies) {
      b.v += dt / 2 / b.mass * b.force;
      b.angular_momentum += dt / 2 * b.torque;
      b.omega = angular_velocity(b, b.q);
    }
  }
  double time = 0;

  /// Forces on all bodies at their present places; `advance`: tangential history moves on.
  void forces(bool advance) {
    contacts = wall_contacts = 0;
    for (Body& b : bodies) {
      b.force = b.mass * gravity * down;
      b.torque = Vector3d::Zero();
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j)
        pair_forces(static_cast<int>(i), static_cast<int>(j), advance);
      wall_forces(static_cast<int>(i), advance);
    }
  }

  /// Bodies have been put elsewhere: forget what was near.
  void forget() {
    near_.clear();
    wall_history_.clear();
  }

 private:
  using History = std::map<int, Vector3d>;
  struct Near {
    std::vector<int> candidates;
    double until = -1; ///< sum of the bodies' paths up to which the candidates hold
    History history;
  };

  static Vector3d angular_velocity(const Body& b, const Quaterniond& q) {
    const Vector3d l = q.conjugate() * b.angular_momentum;
    return q * Vector3d(l.cwiseQuotient(b.mass * b.species->inertia));
  }

  void pair_forces(int i, int j, bool advance) {
    Body &a = bodies[i], &b = bodies[j];
    const Vector3d offset = b.x - a.x;
    const double path = a.path + b.path;
    Near& near = near_[{i, j}];
    const BodyPair pair{{&a.posed}, {&b.posed}, offset};
    if (path >= near.until || near.until < 0) {
      const double reach = a.species->core.radius + b.species->core.radius;
      search_.search(pair, 0.1 * reach);
      const double room = search_.search(pair, 0.1 * reach);
      near.candidates = search_.found();
      near.until = path + room;
      ++searches;
    }
    if (near.candidates.empty()) {
      near.history.clear();
      return;
    }
    manifolds_.clear();
    manifolds_.add(pair, near.candidates.data(), static_cast<int>(near.candidates.size()));
    manifolds_.evaluate();
    most_sunk = std::max(most_sunk, manifolds_.sunk(0));
    const double ra = a.species->core.contact_radius, rb = b.species->core.contact_radius;
    contacts += static_cast<int>(manifolds_.contacts().size());
    const auto [force, torque] =
        evaluate(manifolds_.contacts(), ra * rb / (ra + rb), a.mass * b.mass / (a.mass + b.mass),
                 a.v - b.v + b.omega.cross(offset), a.omega - b.omega, near.history, advance);
    a.force += force;
    a.torque += torque;
    b.force -= force;
    b.torque += offset.cross(force) - torque;
  }

  void wall_forces(int i, bool advance) {
    Body& b = bodies[i];
    int number = 0;
    const ContactBody body{&b.posed};
    const auto act = [&](const std::vector<Contact>& found) {
      wall_contacts += static_cast<int>(found.size());
      const auto [force, torque] =
          evaluate(found, b.species->core.contact_radius, b.mass, b.v, b.omega, wall_history_[{i, number++}], advance);
      b.force += force;
      b.torque += torque;
    };
    for (const Plane& plane : planes) {
      found_.clear();
      const double height = plane.normal.dot(b.x) - plane.offset;
      if (height < b.species->core.bound)
        plane_contacts(body, plane.normal, height, found_);
      act(found_);
    }
    const eccentra::contact::CylinderWall cylinder{-b.x, Vector3d::UnitZ(), 0};
    if (hole > 0) {
      found_.clear();
      hole_contacts(body, {cylinder.to_axis, cylinder.direction, hole}, found_);
      act(found_);
    }
    if (pipe > 0) {
      found_.clear();
      pipe_contacts(body, {cylinder.to_axis, cylinder.direction, pipe}, found_);
      act(found_);
    }
  }

  /// Force and torque on A of the contacts of one pair, by the law and the shared damping of the pair style.
  std::pair<Vector3d, Vector3d> evaluate(const std::vector<Contact>& found, double radius, double mass,
                                         const Vector3d& velocity, const Vector3d& spin, History& history,
                                         bool advance) {
    using namespace eccentra::contact;
    Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
    const int n = static_cast<int>(found.size());
    if (n == 0) {
      history.clear();
      return {force, torque};
    }
    block_.reserve(n + contact_width);
    const double e = material.effective_youngs();
    for (int m = 0; m < n; ++m) {
      const Contact& c = found[m];
      most_overlap = std::max(most_overlap, c.overlap() / c.reach);
      const double stiffness = c.weight * std::sqrt(radius * c.overlap());
      for (int k = 0; k < 3; ++k) {
        block_.normal[k][m] = c.normal[k];
        block_.arm[k][m] = c.arm[k];
        block_.velocity[k][m] = velocity[k];
        block_.spin[k][m] = spin[k];
        const auto old = history.find(c.id);
        block_.history[k][m] = c.elastic || old == history.end() ? 0 : old->second[k];
      }
      block_.radius_a[m] = c.radius_a;
      block_.overlap[m] = c.overlap();
      block_.mass[m] = mass;
      block_.material[0][m] = e;
      block_.material[1][m] = material.effective_shear();
      block_.material[2][m] = -material.damping();
      block_.friction[m] = material.friction;
      block_.curvature[m] = 0;
      block_.contact_radius[m] = stiffness;
      if (c.elastic) { // no law for a negative radius: the force alone
        block_.contact_radius[m] = 0;
        const Vector3d f = 4. / 3 * e * stiffness * c.overlap() * c.normal;
        force += f;
        torque += c.contact_point().cross(f);
      }
    }
    find_contact_model("hertz")->stiffness(block_, whole_vectors(n), DampingChoice());
    ImpactRows central = {}; // no inertia: the mass is that of the bodies
    central.ease_a[0] = 1;
    const std::vector<int> group_of(n, 0);
    shares_.apply(
        block_, n, group_of.data(), 1,
        [n](int) {
          return ContactGroup{0, n};
        },
        central);
    contact_forces(block_, whole_vectors(n), dt, advance, {FrictionBound::stock, false, false});
    History next;
    for (int m = 0; m < n; ++m) {
      force += Vector3d(block_.force[0][m], block_.force[1][m], block_.force[2][m]);
      torque += Vector3d(block_.torque[0][m], block_.torque[1][m], block_.torque[2][m]);
      if (!found[m].elastic)
        next[found[m].id] = Vector3d(block_.history[0][m], block_.history[1][m], block_.history[2][m]);
    }
    if (advance)
      history.swap(next);
    return {force, torque};
  }

  std::map<std::pair<int, int>, Near> near_;
  std::map<std::pair<int, int>, History> wall_history_;
  std::vector<Contact> found_;
  FeatureSearch search_;
  Manifolds manifolds_;
  eccentra::contact::LargeContactBlock block_;
  eccentra::contact::DampingShares shares_;
  bool started_ = false;
};

} // namespace small_dem
