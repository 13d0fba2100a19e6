// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What contacts of two bodies share: one kernel, the same for blocks of any size and order; and the restitution of
// contacts whose normals disagree.
#include "contact/contact_models.h"
#include "contact/shared_contacts.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <vector>

using namespace eccentra::contact;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

struct TestContact {
  Vector3d normal, point; ///< arm of the contact point
  double overlap, stiffness;
};

/// Two bodies and their contacts.
struct TestPair {
  double mass_a, mass_b;
  Matrix3d inertia_a, inertia_b; ///< per unit mass
  Vector3d offset;
  std::vector<TestContact> contacts;
};

Matrix3d random_inertia(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0.5, 1);
  const Matrix3d turn =
      Eigen::Quaterniond(u(random), u(random) - 0.7, u(random) - 0.7, u(random)).normalized().toRotationMatrix();
  return turn * Vector3d(u(random), u(random), u(random)).asDiagonal() * turn.transpose() * 1e-5;
}

TestPair random_pair(std::mt19937& random, int count, bool one_normal) {
  std::uniform_real_distribution<double> u(-1, 1);
  TestPair p{1 + 0.5 * u(random),
             2 + u(random),
             random_inertia(random),
             random_inertia(random),
             Vector3d(u(random), u(random), u(random)) * 6e-3,
             {}};
  const Vector3d common = Vector3d(u(random), u(random), 2).normalized();
  for (int k = 0; k < count; ++k)
    p.contacts.push_back({one_normal ? common : Vector3d(u(random), u(random), 1.5).normalized(),
                          Vector3d(u(random), u(random), u(random)) * 3e-3, 1e-5 * (1.1 + u(random)),
                          1e3 * (1.1 + u(random))});
  return p;
}

/// What the doc comment of DampingShares says, contact by contact.
std::vector<double> by_the_formula(const TestPair& p) {
  std::vector<double> shares;
  for (const TestContact& k : p.contacts) {
    double s = 0, f = 0, w = 0;
    Vector3d arm = Vector3d::Zero();
    for (const TestContact& j : p.contacts) {
      const double weight = std::pow(j.normal.dot(k.normal), 2) * j.stiffness;
      s += weight;
      f += weight * j.overlap;
      w += weight * j.overlap * j.overlap;
      arm += weight * j.point;
    }
    arm /= s;
    const double common = p.contacts.size() > 1 ? std::min(1., std::sqrt(k.stiffness * f * f / w) / s) : 1;
    const Vector3d turn_a = arm.cross(k.normal), turn_b = (arm - p.offset).cross(k.normal);
    const double inverse = 1 / p.mass_a + 1 / p.mass_b;
    const double felt = inverse + turn_a.dot(p.inertia_a.inverse() * turn_a) / p.mass_a +
                        turn_b.dot(p.inertia_b.inverse() * turn_b) / p.mass_b;
    shares.push_back(common * std::sqrt(inverse / felt));
  }
  return shares;
}

template <class Block> void put(Block& c, int m, const TestContact& t) {
  const double radius = 1e-3;
  for (int k = 0; k < 3; ++k) {
    c.normal[k][m] = t.normal[k];
    c.arm[k][m] = t.point[k] + (radius - 0.5 * t.overlap) * t.normal[k];
  }
  c.radius_a[m] = radius;
  c.overlap[m] = t.overlap;
  c.kn[m] = t.stiffness;
  c.gamma_n[m] = 1;
  c.gamma_t[m] = 3;
}

void put(ImpactRows& rows, int k, const TestPair& p) {
  const auto six = [&](ImpactRows::Row* to, const Matrix3d& inertia) {
    const Matrix3d i = inertia.inverse();
    const double values[6] = {i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)};
    for (int d = 0; d < 6; ++d)
      to[d][k] = values[d];
  };
  for (int d = 0; d < 3; ++d)
    rows.offset[d][k] = p.offset[d];
  rows.ease_a[k] = 1 / p.mass_a;
  rows.ease_b[k] = 1 / p.mass_b;
  six(rows.inverse_a, p.inertia_a);
  six(rows.inverse_b, p.inertia_b);
}

/// Shares of the contacts of all pairs in one block, one pair after the other.
template <class Block> std::vector<double> by_the_kernel(Block& c, const std::vector<TestPair>& pairs) {
  ImpactRows rows = {};
  DampingShares shares;
  std::vector<int> group_of;
  std::vector<ContactGroup> groups;
  int m = 0;
  for (const TestPair& p : pairs) {
    const int first = m;
    for (const TestContact& t : p.contacts) {
      put(c, m++, t);
      group_of.push_back(static_cast<int>(groups.size()));
    }
    put(rows, static_cast<int>(groups.size()), p);
    groups.push_back({first, m});
  }
  shares.apply(
      c, m, group_of.data(), static_cast<int>(groups.size()), [&](int k) { return groups[k]; }, rows);
  for (int k = 0; k < m; ++k)
    EXPECT_NEAR(c.gamma_t[k], 3 * c.gamma_n[k], 1e-14);
  return {&c.gamma_n[0], &c.gamma_n[0] + m};
}

void expect_equal(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], 1e-12) << "contact " << k << " of " << found.size();
}

} // namespace

TEST(SharedContacts, BlocksOfAnySizeGiveTheFormula) {
  std::mt19937 random(4);
  auto block = std::make_unique<ContactBlock>();
  LargeContactBlock large;
  for (const bool one_normal : {false, true})
    for (const int count : {1, 2, 3, 8, 9, 30, 64}) {
      const TestPair pair = random_pair(random, count, one_normal);
      const std::vector<double> expected = by_the_formula(pair);
      *block = {};
      expect_equal(by_the_kernel(*block, {pair}), expected);
      large.reserve(count);
      expect_equal(by_the_kernel(large, {pair}), expected);
    }
  const TestPair many = random_pair(random, 200, false);
  large.reserve(200);
  expect_equal(by_the_kernel(large, {many}), by_the_formula(many));
}

TEST(SharedContacts, NeighboursInABlockDoNotMatter) {
  std::mt19937 random(5);
  auto block = std::make_unique<ContactBlock>();
  *block = {};
  std::vector<TestPair> pairs;
  std::vector<double> expected;
  for (const int count : {3, 1, 9, 2, 1, 8, 12}) {
    pairs.push_back(random_pair(random, count, count == 3 || count == 9));
    for (const double share : by_the_formula(pairs.back()))
      expected.push_back(share);
  }
  expect_equal(by_the_kernel(*block, pairs), expected);
}

TEST(SharedContacts, ContactsAtARightAngleReturnTheRestitutionEach) {
  // A rod meets a floor beside its centre and a wall in line with its centre at the same instant. n1 . n2 = 0 and r2 x
  // n2 = 0, so that the two impacts do not disturb each other: each returns e along its own normal, for its own mass,
  // m_c = m / (1 + L^2 m / I) at the floor and m at the wall. One mass for both, from their mean normal, would not.
  const double mass = 1e-3, radius = 1e-3, length = 2e-3, inertia = 2e-6, speed = 0.02, dt = 1e-7;
  for (const double e : {0.9, 0.5}) {
    const double youngs = 1e9, beta = std::log(e) / std::hypot(M_PI, std::log(e));
    auto block = std::make_unique<ContactBlock>();
    *block = {};
    ContactBlock& c = *block;
    Vector3d x(0, 0, 0), v(-speed, 0, -speed);
    double angle = 0, spin = 0; // about y
    ImpactRows rows = {};
    rows.ease_a[0] = 1;
    for (int k = 0; k < 3; ++k)
      rows.inverse_a[k][0] = 1 / inertia;
    DampingShares shares;
    const int group_of[2] = {0, 0};
    const Vector3d ends[2] = {Vector3d(length, 0, 0), Vector3d(-length, 0, 0)}, normals[2] = {{0, 0, 1}, {1, 0, 0}};
    const double walls[2] = {-radius, -length - radius};
    double returned[2] = {0, 0};
    bool touched[2] = {false, false};
    for (int step = 0; step < 200000; ++step) {
      const Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix();
      int n = 0;
      for (int k = 0; k < 2; ++k) {
        const Vector3d arm = turn * ends[k];
        const double overlap = walls[k] + radius - normals[k].dot(x + arm);
        const Vector3d point = arm - radius * normals[k];
        returned[k] = normals[k].dot(v + Vector3d(0, spin, 0).cross(point));
        if (overlap <= 0)
          continue;
        touched[k] = true;
        for (int d = 0; d < 3; ++d) {
          c.normal[d][n] = normals[k][d];
          c.arm[d][n] = arm[d];
          c.velocity[d][n] = v[d];
          c.spin[d][n] = d == 1 ? spin : 0;
        }
        c.radius_a[n] = radius;
        c.overlap[n] = overlap;
        c.contact_radius[n] = std::sqrt(radius * overlap);
        c.mass[n] = mass;
        c.material[0][n] = youngs;
        c.material[2][n] = beta;
        ++n;
      }
      if (step > 0 && n == 0 && touched[0] && touched[1])
        break;
      Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
      if (n > 0) {
        find_contact_model("hertz")->stiffness(c, contact_width, DampingChoice());
        shares.apply(
            c, n, group_of, 1,
            [n](int) {
              return ContactGroup{0, n};
            },
            rows);
        contact_forces(c, contact_width, dt, true, {});
        for (int k = 0; k < n; ++k) {
          force += Vector3d(c.force[0][k], c.force[1][k], c.force[2][k]);
          torque += Vector3d(c.torque[0][k], c.torque[1][k], c.torque[2][k]);
        }
      }
      v += dt / mass * force;
      spin += dt / (mass * inertia) * torque.y();
      x += dt * v;
      angle += dt * spin;
    }
    ASSERT_TRUE(touched[0] && touched[1]);
    std::printf("e %.1f: floor returns %.4f, wall %.4f\n", e, returned[0] / speed, returned[1] / speed);
    EXPECT_NEAR(returned[0] / speed, e, 0.01);
    EXPECT_NEAR(returned[1] / speed, e, 0.01);
  }
}
