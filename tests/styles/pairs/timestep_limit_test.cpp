// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The critical step of fix timestep/limit: the step at which the explicit scheme itself goes unstable, case by case.
#include "contact/timestep_limit_formula.h"
#include "styles/walls/wall_scene.h"

#include "fix.h"
#include "modify.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace eccentra::contact;
using eccentra::test::LiggghtsSession;
using eccentra::test::wall_scene;

namespace {

/// Runs the linear motion of one body on fixed springs with LIGGGHTS's scheme and tells whether it blows up.
struct LinearBody {
  double mass;
  Eigen::Matrix3d inertia;
  struct Spring {
    ContactStiffness k;
    Eigen::Vector3d n, arm;
  };
  std::vector<Spring> springs;

  bool unstable(double dt) const {
    Eigen::Matrix<double, 6, 1> u, v = Eigen::Matrix<double, 6, 1>::Zero();
    u << 1, -2, 0.5, 30, 20, -10;
    u *= 1e-9;
    const double start = u.norm();
    for (int step = 0; step < 20000; ++step) {
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
      for (const Spring& s : springs) {
        const Eigen::Vector3d x = u.head<3>() + u.tail<3>().cross(s.arm), w = v.head<3>() + v.tail<3>().cross(s.arm);
        const Eigen::Vector3d xn = x.dot(s.n) * s.n, wn = w.dot(s.n) * s.n;
        const Eigen::Vector3d f =
            -s.k.normal * xn - s.k.tangential * (x - xn) - s.k.normal_damping * wn - s.k.tangential_damping * (w - wn);
        force += f;
        torque += s.arm.cross(f);
      }
      v.head<3>() += dt / mass * force;
      v.tail<3>() += dt * inertia.inverse() * torque;
      u += dt * v;
      if (!(u.norm() < 1e6 * start))
        return true;
    }
    return false;
  }
};

void expect_limit_is_the_onset(const LinearBody& body) {
  BodyStiffness stiffness;
  for (const auto& s : body.springs)
    stiffness.add(s.k, s.n, s.arm, 1);
  const double limit = stiffness.critical_step(body.mass, body.inertia);
  EXPECT_FALSE(body.unstable(0.97 * limit));
  EXPECT_TRUE(body.unstable(1.05 * limit));
}

constexpr double kMass = 3.5e-4;
constexpr double kRadius = 3.175e-3;

} // namespace

TEST(TimestepFormula, LimitIsTheOnsetOfInstability) {
  const Eigen::Matrix3d sphere = 0.4 * kMass * kRadius * kRadius * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d up(0, 0, 1);
  const ContactStiffness undamped{2e4, 1.6e4, 0, 0};
  const ContactStiffness damped{2e4, 1.6e4, 0.8, 0.7};
  for (const auto& k : {undamped, damped}) {
    expect_limit_is_the_onset({kMass, sphere, {{k, up, -kRadius * up}}});
    // A cube on a face: many contacts, a mean arm, rocking.
    LinearBody cube{kMass, 1.2 * sphere, {}};
    for (const double x : {-1., 1.})
      for (const double y : {-1., 1.})
        cube.springs.push_back({k, up, kRadius * Eigen::Vector3d(0.7 * x, 0.7 * y, -0.8)});
    expect_limit_is_the_onset(cube);
    // A disk wedged between oblique walls.
    LinearBody disk{kMass, (Eigen::Matrix3d() << 1.2, 0, 0, 0, 1.2, 0, 0, 0, 2.1).finished() * sphere, {}};
    disk.springs.push_back({k, Eigen::Vector3d(1, 0, 1).normalized(), kRadius * Eigen::Vector3d(-1, 0.2, -0.3)});
    disk.springs.push_back({k, Eigen::Vector3d(-1, 0.3, 1).normalized(), kRadius * Eigen::Vector3d(1, -0.1, -0.3)});
    expect_limit_is_the_onset(disk);
  }
}

TEST(TimestepFormula, ImpactOverlapIsHertz) {
  // Chung & Ooi test 2: aluminium alloy sphere R 0.1 on a rigid wall at 0.2 m/s, largest overlap 49.717 um.
  const double youngs = 70e9 / (1 - 0.3 * 0.3), radius = 0.1;
  const double mass = 2699 * 4. / 3. * M_PI * std::pow(radius, 3);
  const double at = 1e-5, kn = 4. / 3. * youngs * std::sqrt(radius * at);
  EXPECT_NEAR(impact_overlap(1.5, kn, at, mass, 0.2), 49.717e-6, 1e-9);
}

TEST(TimestepLimit, RestingSphereHasTheClosedForm) {
  LiggghtsSession session;
  session.script(wall_scene(1e-5));
  session.script(R"(
    create_atoms 1 single 0.01 0.01 -0.0919 units box
    set group all diameter 6.35e-3 density 2619
    fix floor all wall/gran/cluster model hertz tangential history primitive type 2 zplane -0.095
    fix integrate all nve/sphere
    fix limit all timestep/limit safety 0.2 every 100
    run 0
  )");
  auto* limit = session.lammps().modify->fix[session.lammps().modify->find_fix("limit")];
  const double nu = 0.3, e = 5e6, overlap = -0.095 - (-0.0919 - 6.35e-3 / 2);
  const double shear = 1 / (2 * (2 - nu) * 2 * (1 + nu) / e);
  const double mass = 2619 * M_PI / 6 * std::pow(6.35e-3, 3);
  // Spin and slip together: the sphere rolls against its tangential spring, 1/m + r^2/I with r to the contact point.
  const double kt = 8 * shear * std::sqrt(kRadius * overlap), arm = kRadius - overlap / 2;
  const double beta = -std::log(0.9) / std::hypot(M_PI, std::log(0.9));
  const double inverse_mass = 1 / mass + arm * arm / (0.4 * mass * kRadius * kRadius);
  const double w = std::sqrt(kt * inverse_mass);
  const double z = 2 * std::sqrt(5. / 6.) * beta * std::sqrt(kt * mass) * inverse_mass / (2 * w);
  const double expected = 2 / w * (std::sqrt(1 + z * z) - z);
  EXPECT_NEAR(limit->compute_scalar(), expected, 1e-9 * expected);
  EXPECT_NEAR(limit->compute_vector(1), 1e-5 / expected, 1e-9);
  EXPECT_NEAR(limit->compute_vector(2), 0.2 * expected, 1e-9 * expected);
  EXPECT_EQ(limit->compute_vector(3), 1);
  EXPECT_EQ(limit->compute_vector(4), 1);
}
