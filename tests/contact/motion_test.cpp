// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid-body motion without torque: conserved quantities, the closed form of the symmetric top, the intermediate axis.
#include "contact/rigid_rotation.h"
#include "contact/turning_block.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

using namespace eccentra::contact;

namespace {

struct Body {
  Eigen::Vector3d inertia;
  double q[4] = {1, 0, 0, 0};
  double momentum[3] = {0, 0, 0};

  double energy() const {
    double r[9], body[3];
    rotation_matrix(q, r);
    to_body(r, momentum, body);
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += body[k] * body[k] / inertia[k] / 2;
    return sum;
  }
  Eigen::Vector3d omega_body() const {
    double r[9], body[3];
    rotation_matrix(q, r);
    to_body(r, momentum, body);
    return {body[0] / inertia[0], body[1] / inertia[1], body[2] / inertia[2]};
  }
  double norm_error() const { return std::abs(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) - 1); }
  void spin(const Eigen::Vector3d& omega) {
    double r[9];
    rotation_matrix(q, r);
    angular_momentum(r, inertia.data(), omega.data(), momentum);
  }
};

constexpr int steps_per_turn = 1000;

} // namespace

TEST(FreeRotation, KeepsEnergyOfAnyInertiaOver100Turns) {
  const Eigen::Vector3d inertias[] = {{1, 1, 1}, {1, 1, 1.79}, {1.79, 1, 1}, {1, 1.5, 2}, {0.4, 1, 1.2}, {1, 0.3, 1.1}};
  const Eigen::Vector3d spins[] = {{1, 0.3, 0.2}, {0.1, 1, 0.1}, {0.3, 0.5, 0.8}};
  for (const auto& inertia : inertias)
    for (const auto& spin : spins) {
      Body body{inertia};
      body.spin(spin);
      const double energy = body.energy();
      const double dt = 2 * M_PI / spin.norm() / steps_per_turn;
      const FreeRotation rotation(inertia);
      double worst = 0, worst_norm = 0;
      for (int n = 0; n < 100 * steps_per_turn; ++n) {
        rotation.step(body.q, body.momentum, dt);
        worst_norm = std::max(worst_norm, body.norm_error());
        if (n % 10 == 0)
          worst = std::max(worst, std::abs(body.energy() / energy - 1));
      }
      EXPECT_LT(std::abs(body.energy() / energy - 1), 1e-6) << inertia.transpose() << " / " << spin.transpose();
      EXPECT_LT(worst, 4e-6) << "the error of a symplectic step stays bounded";
      EXPECT_LT(worst_norm, 1e-14);
    }
}

TEST(FreeRotation, DoesNotDriftInAMillionSteps) {
  Body body{{1, 1.5, 2}};
  body.spin({0.3, 1, 0.4});
  const double energy = body.energy();
  const FreeRotation rotation(body.inertia);
  const double dt = 2 * M_PI / 1.1 / 100; // coarse: an error that grows would show
  double first = 0, last = 0;
  constexpr int steps = 1000000, window = 100000;
  for (int n = 0; n < steps; ++n) {
    rotation.step(body.q, body.momentum, dt);
    const double error = body.energy() / energy - 1;
    if (n < window)
      first += error / window;
    if (n >= steps - window)
      last += error / window;
  }
  EXPECT_NEAR(first, last, 2e-6) << "the mean error of the first and the last tenth are the same";
  EXPECT_LT(body.norm_error(), 1e-14);
}

TEST(FreeRotation, IsSecondOrder) {
  // Orientation after one turn against a solution with a 64 times finer step.
  const auto orientation = [](int steps) {
    Body body{{1, 1.5, 2}};
    body.spin({0.5, 0.7, 0.6});
    const FreeRotation rotation(body.inertia);
    for (int n = 0; n < steps; ++n)
      rotation.step(body.q, body.momentum, 6. / steps);
    return Eigen::Vector4d(body.q[0], body.q[1], body.q[2], body.q[3]);
  };
  const Eigen::Vector4d fine = orientation(12800);
  const double coarse_error = (orientation(100) - fine).norm(), half_error = (orientation(200) - fine).norm();
  EXPECT_NEAR(std::log2(coarse_error / half_error), 2, 0.05);
}

TEST(FreeRotation, SymmetricTopPrecessesByTheClosedForm) {
  // D48: I3/I1 = 1.79; omega turns about the body's axis at (I3/I1 - 1) w3 (physics.md, D2), whatever the step.
  Body body{{1, 1, 1.79}};
  body.spin({0.5, 0, 2});
  const FreeRotation rotation(body.inertia);
  const double rate = 0.79 * 2, time = 7.3;
  for (int n = 0; n < 50; ++n)
    rotation.step(body.q, body.momentum, time / 50);
  const Eigen::Vector3d omega = body.omega_body();
  EXPECT_NEAR(omega.x(), 0.5 * std::cos(rate * time), 1e-12);
  EXPECT_NEAR(omega.y(), 0.5 * std::sin(rate * time), 1e-12);
  EXPECT_NEAR(omega.z(), 2, 1e-12);
}

TEST(FreeRotation, IntermediateAxisFlips) {
  // Spin about the middle axis with a small disturbance turns over; the time between flips by the closed form, elliptic
  // integral T = 2 K(k) / p with p^2 = (I2-I1)(I3-I2)/(I1 I3) w2^2 for a small disturbance (K by its logarithm is not
  // exact enough, so: compare with a fine solution of Euler's equations).
  const Eigen::Vector3d inertia(1, 1.5, 2), start(1e-3, 1, 1e-3);
  Body body{inertia};
  body.spin(start);
  const FreeRotation rotation(inertia);
  const double dt = 2 * M_PI / steps_per_turn;
  double time = 0;
  while (body.omega_body().y() > 0 && time < 200) {
    rotation.step(body.q, body.momentum, dt);
    time += dt;
  }
  Eigen::Vector3d w = start;
  const auto slope = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d((inertia[1] - inertia[2]) * v[1] * v[2] / inertia[0],
                           (inertia[2] - inertia[0]) * v[2] * v[0] / inertia[1],
                           (inertia[0] - inertia[1]) * v[0] * v[1] / inertia[2]);
  };
  double reference = 0;
  const double h = dt / 4;
  while (w.y() > 0 && reference < 200) {
    const Eigen::Vector3d k1 = slope(w), k2 = slope(w + h / 2 * k1), k3 = slope(w + h / 2 * k2), k4 = slope(w + h * k3);
    w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    reference += h;
  }
  ASSERT_LT(reference, 100) << "Euler's equations flip";
  EXPECT_NEAR(time, reference, 5 * dt);
}

TEST(TurningBlock, TurnsAsOneBodyAlone) {
  // Angles up to the longest that a block takes; fewer bodies than there are places.
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
  TurningBlock block;
  double alone[TurningBlock::width][4];
  block.count = TurningBlock::width - 2;
  for (int m = 0; m < block.count; ++m) {
    const Eigen::Vector3d angle = 0.199 * m / block.count * Eigen::Vector3d(1, -2, m).normalized();
    ASSERT_TRUE(turns_in_block(angle.data()));
    const Eigen::Quaterniond start(Eigen::AngleAxisd(0.7 * m, Eigen::Vector3d(m, 1, 2).normalized()));
    const double q[4] = {start.w(), start.x(), start.y(), start.z()};
    for (int k = 0; k < 4; ++k)
      block.quaternion[k][m] = alone[m][k] = q[k];
    for (int k = 0; k < 3; ++k)
      block.angle[k][m] = angle[k];
    rotate_in_world(alone[m], angle.data());
    normalise(alone[m]);
  }
  turn_all(block);
  for (int m = 0; m < block.count; ++m) {
    double matrix[9];
    rotation_matrix(alone[m], matrix);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(block.quaternion[k][m], alone[m][k], round_off);
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(block.matrix[k][m], matrix[k], 2 * round_off);
  }
}

TEST(TurningBlock, RoundsTheSameInAnyPlace) {
  TurningBlock first, last;
  const double angle[3] = {1e-3, -7e-4, 3e-4}, q[4] = {0.5, -0.1, 0.7, 0.5};
  constexpr int end = TurningBlock::width - 1;
  for (int k = 0; k < 3; ++k)
    first.angle[k][0] = last.angle[k][end] = angle[k];
  for (int k = 0; k < 4; ++k)
    first.quaternion[k][0] = last.quaternion[k][end] = q[k];
  turn_all(first);
  turn_all(last);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(first.quaternion[k][0], last.quaternion[k][end]);
  for (int k = 0; k < 9; ++k)
    EXPECT_EQ(first.matrix[k][0], last.matrix[k][end]);
}

TEST(TurningBlock, LeavesLongTurnsToOthers) {
  const double longer[3] = {0.15, 0.15, 0.15};
  EXPECT_FALSE(turns_in_block(longer)) << "where the series of sine and cosine has ended";
}
