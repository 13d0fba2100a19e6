// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Manifolds of two bodies: distances against slow references, candidates, continuity of force, limits in which others
// know the answer.
#include "contact/least_axis.h"
#include "contact/manifold_poses.h"
#include "contact/rim_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {
using namespace eccentra::contact;
using namespace eccentra::test;
using eccentra::shape::ConvexCore;

double segment_distance(const Vector3d& a, const Vector3d& u, const Vector3d& b, const Vector3d& v) {
  const Vector3d r = a - b;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), det = uu * vv - uv * uv;
  double least = 1e300;
  if (det > 1e-12 * uu * vv) {
    const double s = (uv * v.dot(r) - vv * u.dot(r)) / det, t = (uu * v.dot(r) - uv * u.dot(r)) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
      least = (r + s * u - t * v).norm();
  }
  const auto ask = [&](const Vector3d& p, const Vector3d& from, const Vector3d& along) {
    const double t = std::min(1., std::max(0., (p - from).dot(along) / along.squaredNorm()));
    least = std::min(least, (p - from - t * along).norm());
  };
  ask(a, b, v);
  ask(a + u, b, v);
  ask(b, a, u);
  ask(b + v, a, u);
  return least;
}

/// Distance of two polyhedral cores feature by feature; 0 where a vertex or an edge is inside.
double slow_distance(const PosedCore& a, const PosedCore& b, const Vector3d& offset) {
  if (least_axis(a, b, offset).separation < 0 && a.core->polyhedron.dimension() == 3 &&
      b.core->polyhedron.dimension() == 3)
    return 0;
  double least = 1e300;
  const auto moved = [](const PosedCore& posed, const Vector3d& shift) {
    ConvexCore core = posed.core->polyhedron;
    for (Vector3d& v : core.vertices)
      v = posed.rotation * v + shift;
    for (auto& f : core.faces) {
      f.normal = posed.rotation * f.normal;
      f.offset += f.normal.dot(shift);
    }
    return core;
  };
  const ConvexCore ca = moved(a, Vector3d::Zero()), cb = moved(b, offset);
  for (const Vector3d& v : ca.vertices)
    least = std::min(least, std::max(0., distance_to_core(cb, v).distance));
  for (const Vector3d& v : cb.vertices)
    least = std::min(least, std::max(0., distance_to_core(ca, v).distance));
  for (const auto& e : ca.edges)
    for (const auto& f : cb.edges)
      least = std::min(least, segment_distance(ca.vertices[e.from], ca.vertices[e.to] - ca.vertices[e.from],
                                               cb.vertices[f.from], cb.vertices[f.to] - cb.vertices[f.from]));
  return least;
}

TEST(SmoothManifold, DistancesAgreeWithASlowReference) {
  Random r(1);
  std::vector<ContactCore> cores;
  for (const RoundedHull& h : kinds())
    cores.emplace_back(h);
  double worst_gjk = 0, worst_manifold = 0, worst_disk = 0;
  for (const ContactCore& a : cores)
    for (const ContactCore& b : cores)
      for (int n = 0; n < 60; ++n) {
        const double reach = a.radius + b.radius;
        const Pose pose = random_pose(a, b, r, reach * r.uniform(0.05, 1.5));
        const double gjk = gjk_distance(pose.a, pose.b, pose.offset);
        if (!a.is_disk() && !b.is_disk()) {
          const double slow = slow_distance(pose.a, pose.b, pose.offset);
          worst_gjk = std::max(worst_gjk, std::abs(gjk - slow));
        }
        const Found found = find(pose, 1.5 * reach);
        // The closest of its contacts is at the distance of the bodies, and the gap is no wider.
        ASSERT_FALSE(std::isnan(found.gap));
        EXPECT_LT(found.gap, gjk - reach + 5e-3 * reach);
        double closest = reach;
        for (const Contact& c : found.contacts)
          closest = std::min(closest, c.distance);
        double& worst = a.is_disk() || b.is_disk() ? worst_disk : worst_manifold;
        if (gjk < reach)
          worst = std::max(worst, std::abs(closest - gjk) / reach);
        for (const Contact& c : found.contacts) {
          ASSERT_NEAR(c.normal.norm(), 1, 1e-9);
          ASSERT_GT(c.overlap(), 0);
          ASSERT_TRUE(c.arm.allFinite());
        }
        EXPECT_TRUE(std::is_sorted(found.contacts.begin(), found.contacts.end(),
                                   [](const Contact& p, const Contact& q) { return p.id < q.id; }));
        EXPECT_LE(best_face_axis(pose.a, pose.b, pose.offset).separation, gjk + 1e-9);
        EXPECT_LE(least_axis(pose.a, pose.b, pose.offset).separation, gjk + 1e-9);
      }
  std::printf("worst error of GJK %.1e; of the closest contact over the reach %.1e, with a disk %.1e\n", worst_gjk,
              worst_manifold, worst_disk);
  EXPECT_LT(worst_gjk, 1e-9);
  EXPECT_LT(worst_manifold, 1e-9);
  EXPECT_LT(worst_disk, 5e-3); // two closest points of one piece of an arc are not told apart
}

// Any pose, however deep: finite numbers, unit normals.
TEST(SmoothManifold, SurvivesAnyPose) {
  Random r(2);
  std::vector<ContactCore> cores;
  for (const RoundedHull& h : kinds())
    cores.emplace_back(h);
  cores.emplace_back(std::vector<Vector3d>{{0.5, 0, 0}, {-0.5, 0, 0}}, std::vector<double>{0.6, 0.4});
  cores.emplace_back(
      ConvexCore(eccentra::shape::make_core({{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 2, 1}})), 0.);
  for (const ContactCore& a : cores)
    for (const ContactCore& b : cores)
      for (int n = 0; n < 120; ++n) {
        Pose pose;
        const Matrix3d first = n % 3 ? r.turn() : Matrix3d(Matrix3d::Identity());
        pose.a.pose(a, first);
        pose.b.pose(b, n % 2 ? r.turn() : first);
        pose.offset =
            n == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(r.uniform(0, 1) * (a.bound + b.bound) * r.direction());
        const Found found = find(pose, 0.1);
        for (const Contact& c : found.contacts) {
          ASSERT_NEAR(c.normal.norm(), 1, 1e-9);
          ASSERT_TRUE(c.arm.allFinite() && std::isfinite(c.distance) && std::isfinite(c.weight));
        }
        if (found.sunk > 0.3 * (a.radius + b.radius)) { // all of them push the bodies apart along one axis
          const SeparatingAxis axis = least_axis(pose.a, pose.b, pose.offset);
          const Load load = load_of(found.contacts);
          EXPECT_GT(load.force.dot(axis.normal), 0);
        }
      }
}

TEST(SmoothManifold, CandidatesHoldForTheirSkin) {
  Random r(3);
  std::vector<ContactCore> cores;
  for (const RoundedHull& h : kinds())
    cores.emplace_back(h);
  for (const ContactCore& a : cores)
    for (const ContactCore& b : cores)
      for (int n = 0; n < 40; ++n) {
        const double reach = a.radius + b.radius, skin = 0.3 * reach;
        Pose pose = random_pose(a, b, r, reach * r.uniform(0.6, 1.2));
        const Found before = find(pose, skin);
        // A motion of B whose matter moves by no more than the slack.
        const double shift = 0.5 * std::min(before.slack, skin);
        pose.offset += shift * r.direction();
        const Matrix3d turn =
            AngleAxisd(0.49 * std::min(before.slack, skin) / b.bound, r.direction()).toRotationMatrix();
        pose.b.pose(b, turn * pose.b.rotation);
        const Found fresh = find(pose, skin);
        Manifolds m;
        m.add(pair_of(pose), before.candidates.data(), static_cast<int>(before.candidates.size()));
        m.evaluate();
        ASSERT_EQ(m.contacts().size(), fresh.contacts.size());
        for (std::size_t k = 0; k < fresh.contacts.size(); ++k) {
          EXPECT_EQ(m.contacts()[k].id, fresh.contacts[k].id);
          EXPECT_EQ(m.contacts()[k].weight, fresh.contacts[k].weight);
        }
      }
}

// A rim in the frame of a solid: distances, their slopes and the slopes' changes; no point of an arc is closer than the
// bound that its ends give.
TEST(SmoothManifold, RimsOnSolids) {
  Random r(9);
  constexpr double step = eccentra::contact::RingDirections::step, part = 1e-6;
  int rates = 0, monotonic = 0;
  double tightest = 1e300;
  for (const char* line : {"smooth disk aspect .31 rounding .5", "smooth disk aspect .31 rounding 1"}) {
    const ContactCore disk(made(line));
    for (const RoundedHull& hull : kinds()) {
      const ContactCore solid(hull);
      if (solid.solid == SolidKind::none)
        continue;
      for (int n = 0; n < 60; ++n) {
        const Pose pose = random_pose(disk, solid, r, 0.5 * disk.radius);
        const int rim_number = n % disk.rims, k = n % disk.ring;
        const RimOnSolid rim(pose.a, rim_number, pose.b, -pose.offset);
        const RimOnSolid::Arc arc(rim, k);
        const auto slope_at = [&arc](double angle) {
          double slopes[eccentra::contact::lane_width];
          arc.slopes(angle, 0, 1, slopes);
          return slopes[0];
        };
        const auto world = [&](double angle) {
          const double turn = (k + 0.5) * step + angle;
          return distance_to(pose.b, Vector3d(pose.a.rotation * Vector3d(disk.half.x() * std::cos(turn),
                                                                         disk.half.x() * std::sin(turn),
                                                                         (rim_number == 0 ? 1 : -1) * disk.half.z()) -
                                              pose.offset));
        };
        const auto from = world(-step / 2), to = world(step / 2);
        RimLanes lanes;
        lanes.add(rim, k);
        lanes.add(rim, (k + 1) % disk.ring);
        if (solid.is_disk())
          lanes.on_disks();
        else if (solid.solid == SolidKind::box)
          lanes.on_boxes();
        else
          lanes.on_polyhedra({&solid, &solid});
        for (int end = 0; end < 2; ++end) {
          const RimSample at = arc((end - 0.5) * step);
          const RimEnd of_lane = lanes.end(end);
          EXPECT_NEAR(of_lane.distance, end == 0 ? from.distance : to.distance, 1e-14);
          EXPECT_NEAR(of_lane.slope, at.slope, 1e-12);
          EXPECT_LT((lanes.vector(RimLanes::nx, end) - at.point.at.normal).norm(), 1e-12);
          if (!std::isnan(at.rate)) {
            EXPECT_NEAR(of_lane.rate, at.rate, 1e-10 * (1 + std::abs(at.rate)));
          }
        }
        const double bound = rim.least_between(lanes.end(0), lanes.end(1));
        if (RimOnSolid::monotonic(lanes.end(0), lanes.end(1))) {
          const int samples = 40;
          double before = lanes.end(0).slope;
          const double way = lanes.end(1).slope - before;
          for (int j = 1; j <= samples; ++j) {
            const double next = slope_at((j / double(samples) - 0.5) * step);
            EXPECT_GT((next - before) * way, -1e-12);
            before = next;
          }
          ++monotonic;
        }
        for (int j = 0; j <= 20; ++j) {
          const double angle = (j / 20. - 0.5) * step;
          const auto at = arc(angle), before = arc(angle - part), after = arc(angle + part);
          EXPECT_NEAR(at.point.at.distance, world(angle).distance, 1e-14);
          EXPECT_NEAR(at.slope, slope_at(angle), 1e-13);
          EXPECT_GE(at.point.at.distance, bound - 1e-14);
          tightest = std::min(tightest, at.point.at.distance - bound);
          // Where the nearest feature of the solid changes between, slopes have kinks.
          if ((before.point.at.normal - after.point.at.normal).norm() > 100 * part ||
              std::abs(before.rate - after.rate) > 0.01 * (1 + std::abs(at.rate)))
            continue;
          EXPECT_NEAR((after.point.at.distance - before.point.at.distance) / (2 * part * disk.half.x()), at.slope,
                      1e-7);
          if (std::isnan(at.rate))
            continue;
          EXPECT_NEAR((after.slope - before.slope) / (2 * part), at.rate, 1e-5 * (1 + std::abs(at.rate)))
              << hull.name();
          ++rates;
        }
      }
    }
  }
  EXPECT_GT(rates, 5000);
  EXPECT_GT(monotonic, 100);
  EXPECT_LT(tightest, 1e-3); // it is reached
}

// Along paths in touch the force has no jump: the step of a path that changes it most is halved until it is short.
TEST(SmoothManifold, ForceIsContinuous) {
  std::vector<ContactCore> cores;
  for (const RoundedHull& h : kinds())
    cores.emplace_back(h);
  int disk_paths = 0, disk_jumps = 0;
  for (std::size_t ka = 0; ka < cores.size(); ++ka)
    for (const std::size_t kb : {ka, (ka + 1) % cores.size(), (ka + 5) % cores.size()}) {
      const ContactCore &a = cores[ka], &b = cores[kb];
      Random r(11);
      const double reach = a.radius + b.radius, one_spring = std::pow(0.03 * reach, 1.5);
      double worst = 0;
      int paths = 0, jumps = 0;
      for (int n = 0; n < 12; ++n) {
        const Pose start = random_pose(a, b, r, 0.97 * reach);
        const Vector3d axis = r.direction(), way = start.offset.cross(r.direction()).normalized();
        const auto at = [&](double t) {
          Pose pose = start;
          pose.offset += 0.3 * b.bound * t * way;
          pose.b.pose(b, AngleAxisd(0.1 * t, axis).toRotationMatrix() * start.b.rotation);
          Load load = load_of(find(pose, 0.1 * reach).contacts);
          load.torque /= b.bound;
          if (gjk_distance(pose.a, pose.b, pose.offset) < 0.5 * reach)
            load.force[0] = NAN; // deeper is not what this is for
          return load;
        };
        const auto change = [](const Load& p, const Load& q) {
          return (p.force - q.force).norm() + (p.torque - q.torque).norm();
        };
        constexpr int steps = 150;
        Load before = at(0), low{}, high{};
        double most = 0, from = 0;
        for (int k = 1; k <= steps; ++k) {
          const Load next = at(double(k) / steps);
          const double c = change(before, next);
          if (std::isnan(c))
            break;
          if (c > most) {
            most = c;
            from = (k - 1.) / steps;
            low = before;
            high = next;
          }
          before = next;
        }
        double width = 1. / steps;
        for (int k = 0; k < 24 && most > 0; ++k) {
          width /= 2;
          const Load middle = at(from + width);
          const double left = change(low, middle), right = change(middle, high);
          most = std::max(left, right);
          if (left >= right) {
            high = middle;
          } else {
            low = middle;
            from += width;
          }
        }
        worst = std::max(worst, most / one_spring);
        ++paths;
        jumps += most / one_spring > 1e-5;
      }
      if (!a.is_disk() && !b.is_disk())
        EXPECT_LT(worst, 1e-5) << "kinds " << ka << " and " << kb;
      else
        disk_jumps += jumps;
      disk_paths += a.is_disk() || b.is_disk() ? paths : 0;
    }
  // Where flat faces lie exactly parallel and cover each other in part, as on a quarter of the paths, deepest points of
  // rims are not unique: as the tilt changes its sign, springs move along their arcs.
  std::printf("disks: a jump on %d of %d paths\n", disk_jumps, disk_paths);
  EXPECT_LT(disk_jumps, 0.07 * disk_paths);
}

// Boxes have a way of their own, which finds what the way of all polyhedra finds.
TEST(SmoothManifold, TwoBoxesAreTwoPolyhedra) {
  Random r(12);
  const ContactCore cube(made("smooth cube rounding .15")), box(made("smooth box 1 2 3 rounding .3"));
  const auto as_polyhedron = [](ContactCore core) {
    core.solid = SolidKind::polyhedron;
    return core;
  };
  int poses = 0, ties = 0, contacts = 0, elastic = 0, weighted = 0;
  for (const ContactCore* a : {&cube, &box})
    for (const ContactCore* b : {&cube, &box}) {
      const ContactCore slow_a = as_polyhedron(*a), slow_b = as_polyhedron(*b);
      const double reach = a->radius + b->radius, one_spring = std::pow(0.03 * reach, 1.5);
      for (int n = 0; n < 1500; ++n) {
        const Pose pose = random_pose(*a, *b, r, reach * r.uniform(0.02, 1.1));
        Pose slow = pose;
        slow.a.core = &slow_a;
        slow.b.core = &slow_b;
        const Found found = find(pose, 0.1 * reach), expected = find(slow, 0.1 * reach);
        EXPECT_NEAR(found.gap, expected.gap, 1e-12);
        const Load load = load_of(found.contacts), slow_load = load_of(expected.contacts);
        EXPECT_LT((load.force - slow_load.force).norm(), 1e-7 * one_spring);
        EXPECT_LT((load.torque - slow_load.torque).norm(), 1e-7 * one_spring * b->bound);
        // Where a closest point is at an end to round-off, the spring is the vertex's or the edge's.
        ++poses;
        if (!std::equal(found.contacts.begin(), found.contacts.end(), expected.contacts.begin(),
                        expected.contacts.end(),
                        [](const Contact& c, const Contact& e) { return c.id == e.id && c.elastic == e.elastic; })) {
          ++ties;
          continue;
        }
        for (std::size_t k = 0; k < found.contacts.size(); ++k) {
          const Contact &c = found.contacts[k], &e = expected.contacts[k];
          EXPECT_NEAR(c.distance, e.distance, 1e-11);
          EXPECT_LT((c.normal - e.normal).norm(), 1e-9);
          ++contacts;
          elastic += c.elastic;
          weighted += c.weight < 1;
        }
      }
    }
  EXPECT_LT(ties, 0.02 * poses);
  EXPECT_GT(contacts, 5000);
  EXPECT_GT(elastic, 100);
  EXPECT_GT(weighted, 1000);
}

TEST(SmoothManifold, RoundingOneIsASphere) {
  const ContactCore ball{made("smooth cube rounding 1")}, sphere{std::vector<Vector3d>{Vector3d::Zero()}, {1.}};
  ContactCore plain; // an atom's radius is added to it
  Random r(5);
  for (int n = 0; n < 50; ++n) {
    Pose pose;
    pose.a.pose(ball, r.turn());
    pose.b.pose(ball, r.turn());
    pose.offset = r.uniform(1.7, 1.99) * r.direction();
    const Found found = find(pose, 0.1);
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_NEAR(found.contacts[0].overlap(), 2 - pose.offset.norm(), 1e-15);
    EXPECT_LT((found.contacts[0].normal + pose.offset.normalized()).norm(), 1e-15);
    EXPECT_EQ(found.contacts[0].weight, 1);
    // With the same of a cluster of one, and a plain sphere.
    Pose with = pose;
    with.b.pose(sphere, r.turn());
    EXPECT_NEAR(find(with, 0.1).contacts.at(0).overlap(), 2 - pose.offset.norm(), 1e-15);
    with.b.pose(plain, Matrix3d::Identity());
    FeatureSearch search;
    const BodyPair pair{{&with.a}, {&with.b, 1.}, with.offset};
    search.search(pair, 0.1);
    Manifolds m;
    m.add(pair, search.found().data(), static_cast<int>(search.found().size()));
    m.evaluate();
    ASSERT_EQ(m.contacts().size(), 1u);
    EXPECT_NEAR(m.contacts()[0].overlap(), 2 - pose.offset.norm(), 1e-15);
  }
}

// A sphere against a hull touches its closest point.
TEST(SmoothManifold, SpheresAgainstHulls) {
  Random r(6);
  const ContactCore ball{made("smooth cube rounding 1")};
  for (const RoundedHull& hull : kinds()) {
    const ContactCore core(hull);
    for (int n = 0; n < 50; ++n) {
      const Pose pose = random_pose(core, ball, r, core.radius + 0.9);
      const Found found = find(pose, 0.1);
      double sum = 0;
      for (const Contact& c : found.contacts)
        sum += c.weight;
      EXPECT_NEAR(sum, 1, 1e-9);
      EXPECT_NEAR(found.gap, -0.1, 1e-6);
    }
  }
}

// Two disks side by side: crossed, the sides touch; parallel, the rims.
TEST(SmoothManifold, SidesOfDisks) {
  const ContactCore core(made("smooth disk aspect 1 rounding .2"));
  const double outer = core.half.x() + core.radius;
  Pose pose;
  pose.a.pose(core, Matrix3d::Identity());
  pose.b.pose(core, AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix());
  pose.offset = {2 * outer - 0.005, 0, 0};
  const Found crossed = find(pose, 0.1);
  ASSERT_EQ(crossed.contacts.size(), 1u);
  EXPECT_EQ(crossed.contacts[0].id, feature_id(core.axis_feature(), core.axis_feature()));
  EXPECT_NEAR(crossed.contacts[0].overlap(), 0.005, 1e-12);
  pose.b.pose(core, AngleAxisd(0.1, Vector3d::UnitZ()).toRotationMatrix());
  const Found parallel = find(pose, 0.1);
  EXPECT_GT(parallel.contacts.size(), 1u);
  EXPECT_NEAR(load_of(parallel.contacts).torque.y(), 0, 1e-9);
}

} // namespace
