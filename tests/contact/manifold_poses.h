// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies of all kinds in random poses, and the contacts that a search finds.
#pragma once

#include "contact/feature_search.h"
#include "contact/gjk.h"
#include "contact/manifold.h"
#include "contact/random_poses.h"
#include "shape/convex_hull.h"

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace eccentra::test {
using contact::BodyPair;
using contact::Contact;
using contact::ContactCore;
using contact::FeatureSearch;
using contact::gjk_distance;
using contact::Manifolds;
using contact::PosedCore;
using Eigen::AngleAxisd;
using Eigen::Matrix3d;

inline RoundedHull scattered(unsigned seed) {
  Random r(seed);
  std::vector<Vector3d> points;
  for (int k = 0; k < 14; ++k)
    points.push_back(r.uniform(0.8, 1.2) * r.direction());
  return {"hull", shape::convex_hull(points), 0.15};
}

/// One of each kind of body.
inline std::vector<RoundedHull> kinds() {
  std::vector<RoundedHull> all;
  for (const char* line : {"smooth cube rounding .15", "smooth box 1 2 3 rounding .3", "smooth box 1 3 3 rounding 1",
                           "smooth box 1 1 3 rounding 1", "smooth cube rounding 1", "smooth disk aspect .31 rounding 1",
                           "smooth disk aspect .31 rounding .5", "smooth disk aspect 2 rounding .3"})
    all.push_back(made(line));
  all.push_back(scattered(4));
  return all;
}

/// Two orientations and an offset: anyhow, parallel, nearly parallel; the cores at `apart` from each other.
struct Pose {
  PosedCore a, b;
  Vector3d offset;
};
inline Pose random_pose(const ContactCore& a, const ContactCore& b, Random& r, double apart) {
  Pose pose;
  const Matrix3d first = r.turn();
  const int kind = static_cast<int>(r.uniform(0, 4));
  Matrix3d second = r.turn();
  if (kind == 1) // axes parallel, to round-off
    second = first * (r.uniform(0, 1) < 0.5 ? Matrix3d(Matrix3d::Identity())
                                            : AngleAxisd(M_PI / 2, Vector3d::UnitY()).toRotationMatrix());
  if (kind == 2)
    second = AngleAxisd(std::pow(10, r.uniform(-12, -1)), r.direction()).toRotationMatrix() * first;
  pose.a.pose(a, first);
  pose.b.pose(b, second);
  const Vector3d way = kind == 3 ? Vector3d(first.col(2)) : r.direction();
  const Vector3d side =
      kind == 0
          ? Vector3d(Vector3d::Zero())
          : Vector3d(0.5 * a.bound * r.uniform(-1, 1) * first.col(0) + 0.5 * a.bound * r.uniform(-1, 1) * first.col(1));
  double low = 0, high = 4 * (a.bound + b.bound);
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (gjk_distance(pose.a, pose.b, side + middle * way) < apart ? low : high) = middle;
  }
  pose.offset = side + high * way;
  return pose;
}

inline BodyPair pair_of(const Pose& pose) {
  return {{&pose.a}, {&pose.b}, pose.offset};
}

/// The contacts of a pair, from a search with this skin.
struct Found {
  std::vector<Contact> contacts;
  double gap, sunk, slack;
  std::vector<int> candidates;
};
inline Found find(const Pose& pose, double skin) {
  FeatureSearch search;
  Found found;
  found.slack = search.search(pair_of(pose), skin);
  found.candidates = search.found();
  Manifolds m;
  m.add(pair_of(pose), found.candidates.data(), static_cast<int>(found.candidates.size()));
  m.evaluate();
  found.contacts = m.contacts();
  found.gap = m.gap(0);
  found.sunk = m.sunk(0);
  return found;
}

struct Load {
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
};
inline Load load_of(const std::vector<Contact>& contacts) {
  Load load;
  for (const Contact& c : contacts) {
    const Vector3d f = c.weight * std::pow(c.overlap(), 1.5) * c.normal;
    load.force += f;
    load.torque += c.contact_point().cross(f);
  }
  return load;
}

} // namespace eccentra::test
