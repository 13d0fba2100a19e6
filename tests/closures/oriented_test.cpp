// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of the real shape: reference values, limits, the step, and what a sphere and a cube must show.
#include "closures/drag_table.h"
#include "closures/fluid_options.h"
#include "closures/oriented_shape.h"
#include "closures/pitching_laws.h"
#include "closures/vector_step.h"

#include "law_names.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

using namespace eccentra::closures;
using eccentra::test::drag_laws;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kD = 6.35e-3, kSolid = 2619.0;

/// The spheroid of the inertia of D48, axis z: exact K, K_rot and B (Oberbeck, Jeffery).
struct Spheroid {
  static constexpr double kBeta = 0.3435727383, kAlong = 1.2567036486, kAcross = 1.0341116131,
                          kSpinAcross = 1.4321283953, kSpinAlong = 1.7908787, kPhi = 0.8058075531;
};

OrientedShape spheroid() {
  eccentra::shape::Resistance r;
  r.translation = Vector3d(Spheroid::kAcross, Spheroid::kAcross, Spheroid::kAlong).asDiagonal();
  r.rotation = Vector3d(Spheroid::kSpinAcross, Spheroid::kSpinAcross, Spheroid::kSpinAlong).asDiagonal();
  const double b2 = Spheroid::kBeta * Spheroid::kBeta, b = (1 - b2) / (1 + b2);
  r.strain(0, 3) = b * Spheroid::kSpinAcross;
  r.strain(1, 4) = -b * Spheroid::kSpinAcross;
  const double equator = 0.5 * std::pow(Spheroid::kBeta, -1.0 / 3.0), axis = equator * Spheroid::kBeta;
  const double side = (equator * equator + axis * axis) / 5, end = 2 * equator * equator / 5;
  return oriented_shape(r, Vector3d(side, side, end), [=](const Vector3d& n) {
    const double a = equator * equator;
    return M_PI * std::sqrt(a * axis * axis * (n.x() * n.x() + n.y() * n.y()) + a * a * n.z() * n.z());
  });
}

/// One particle in a flow, with the shape that it is given (null: a plain sphere).
class OneBody : public ShapeCatalogue {
 public:
  explicit OneBody(const OrientedShape* shape, double phi = 1.0) : shape_(shape), phi_(phi) {
    half_step.count = 1;
    half_step.interval = 1e-3;
    half_step.velocity = &velocity_row_;
    half_step.force = &force_row_;
    half_step.spin = &spin_row_;
    half_step.torque = &torque_row_;
    half_step.mass = &mass;
    half_step.radius = &radius;
    half_step.kind = &kind_;
    half_step.mask = &mask;
    half_step.group = half_step.integrated = 1;
    half_step.samples[eccentra::link::kVelocity] = flow.data();
    half_step.samples[eccentra::link::kFraction] = &fraction;
    half_step.samples[eccentra::link::kVorticity] = vorticity.data();
    half_step.samples[eccentra::link::kVelocityGradient] = gradient.data();
    half_step.impulse = &impulse;
    half_step.drag_coefficient = &coefficient;
    half_step.last = &last;
  }
  OneBody(const OneBody&) = delete;

  /// Applies the effects that these arguments of fix fluid/force make.
  void apply(const std::string& arguments) {
    std::istringstream stream(arguments);
    std::vector<std::string> list;
    for (std::string word; stream >> word;)
      list.push_back(word);
    effects = make_effects(read_fluid_options(list, 1));
    for (const auto& effect : effects)
      effect->prepare(*this);
    for (const auto& effect : effects)
      effect->apply(half_step);
  }

  int kinds() const override { return 1; }
  ShapeFactors factors(int) const override { return {phi_}; }
  double inertia_factor(int) const override { return 0.4; }
  double crosswise_sphericity(int, const double*) const override { return 1.0; }
  const OrientedShape* oriented(int) const override { return shape_; }
  const double* quaternion(int) const override { return q; }

  void turn(const Eigen::Quaterniond& to) {
    q[0] = to.w();
    q[1] = to.x();
    q[2] = to.y();
    q[3] = to.z();
  }

  HalfStep half_step;
  EffectList effects;
  Vector3d velocity = Vector3d::Zero(), force = Vector3d::Zero(), spin = Vector3d::Zero(), torque = Vector3d::Zero(),
           flow = Vector3d::Zero(), vorticity = Vector3d::Zero();
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> gradient = Matrix3d::Zero();
  double radius = kD / 2, mass = kSolid * M_PI / 6 * kD * kD * kD, fraction = 1.0, coefficient = 0.0;
  double impulse[3] = {0, 0, 0}, last[4] = {0, 0, 0, 0}, q[4] = {1, 0, 0, 0};
  int mask = 1;

 private:
  const OrientedShape* shape_;
  double phi_;
  int kind_ = 0;
  double *velocity_row_ = velocity.data(), *force_row_ = force.data(), *spin_row_ = spin.data(),
         *torque_row_ = torque.data();
};

const char* const kFluids[] = {"rheology newtonian 0.1 density 1000 ",
                               "rheology herschel_bulkley 1 0.28 0.65 density 1000 "};

/// Dabade et al. from their formulas in more digits; the values where the fits cross them.
TEST(Pitching, References) {
  struct Reference {
    double ratio, limit, meets;
  };
  for (const Reference& r :
       {Reference{5, 10.2365859751, .4259}, Reference{2, 2.4376942559, .3081}, Reference{1.25, .6704548240, 1.269},
        Reference{.5, 2.0853097408, .4404}, Reference{.4, 2.9163159335, .4463}, Reference{1. / 3, 3.7110084564, .4413},
        Reference{.2, 6.7766454790, .3707}}) {
    const PitchingLaw law(r.ratio);
    EXPECT_NEAR(law.limit(), r.limit, 1e-8 * r.limit) << r.ratio;
    EXPECT_NEAR(law.fit(r.meets), r.limit, 2e-4 * r.limit) << r.ratio; // four digits of Re
    EXPECT_EQ(law(1e-3), law.limit());
    EXPECT_LT(law(10.0), law.limit());
  }
  EXPECT_NEAR(PitchingLaw(2.0).fit(1.0) / 2, .9649949655, 1e-9); // C_T at 45 degrees is half
  EXPECT_NEAR(PitchingLaw(5.0).fit(10.0) / 2, 1.7296391929, 1e-9);
  EXPECT_NEAR(PitchingLaw(.5).fit(10.0), 1.3218182032, 1e-9);
  EXPECT_NEAR(PitchingLaw(.2).fit(10.0), 4.1887615773, 1e-9);
  EXPECT_EQ(PitchingLaw(1.0)(1.0), 0.0);
  // Continuous where the formulas hand over to the line, and no jump at the sphere.
  for (const double edge : {.95, 1.05})
    EXPECT_NEAR(PitchingLaw(edge * (1 - 1e-6)).limit(), PitchingLaw(edge * (1 + 1e-6)).limit(),
                1e-3 * PitchingLaw(edge).limit());
}

/// Holzer & Sommerfeld's inertia on the spheroid's own creeping drag; pitching by the smaller of limit and fit.
TEST(Oriented, ReferencesOfASpheroid) {
  struct Reference {
    double re, broadside, edgewise, lift, pitching;
  };
  const OrientedShape shape = spheroid();
  for (const Reference& r : {Reference{.1, 314.2829046603, 259.8633162028, 27.2097942288, 1.7852757476},
                             Reference{1, 35.2078205111, 28.8681117216, 3.1698543948, 1.5851612100},
                             Reference{10, 5.6511221557, 4.1194013330, .7658604114, 1.1325918607},
                             Reference{100, 2.1739326696, 1.1230106435, .5254610130, .8092327234}}) {
    const double speed = r.re * 0.1 / 1000 / kD, unit = M_PI / 8 * 1000 * kD * kD * speed * speed;
    for (const double angle : {0.0, 90.0, 45.0}) {
      OneBody body(&shape, Spheroid::kPhi);
      body.half_step.integrated = 0;
      const double f = angle * M_PI / 180;
      body.flow = speed * Vector3d(std::sin(f), 0, std::cos(f));
      body.apply(std::string(kFluids[0]) + "buoyancy off drag holzer_sommerfeld oriented on drag_torque dennis "
                                           "pitching_torque dabade");
      const Vector3d along = body.flow.normalized(), across(std::cos(f), 0, -std::sin(f));
      const double drag = body.force.dot(along) / unit, lift = std::abs(body.force.dot(across)) / unit;
      const double torque = std::abs(body.torque.y()) / (0.5 * unit * kD);
      if (angle == 0.0) {
        EXPECT_NEAR(drag, r.broadside, 1e-8 * r.broadside);
      }
      if (angle == 90.0) {
        EXPECT_NEAR(drag, r.edgewise, 1e-8 * r.edgewise);
      }
      if (angle != 45.0) {
        EXPECT_LT(lift, 1e-12 * drag);
        EXPECT_LT(torque, 1e-12 * drag);
      } else {
        EXPECT_NEAR(lift, r.lift, 1e-8 * r.lift);
        EXPECT_NEAR(drag, (r.broadside + r.edgewise) / 2, 1e-8 * drag); // sin^2
        EXPECT_NEAR(torque, r.pitching, 1e-8 * r.pitching);
        // The disk's axis turns towards the slip: about +y from z to x.
        EXPECT_GT(body.torque.y(), 0.0);
      }
      EXPECT_LT(std::abs(body.torque.x()) + std::abs(body.torque.z()), 1e-12 * unit * kD);
    }
  }
}

TEST(Oriented, OneRootForThreeAxes) {
  const OrientedShape shape = spheroid();
  OneBody body(&shape, Spheroid::kPhi);
  body.flow = Vector3d(.1, 0, .1);
  body.apply(std::string(kFluids[0]) + "buoyancy off drag holzer_sommerfeld oriented on");
  const Vector3d q = body.flow - body.half_step.interval / body.mass * body.force;
  EXPECT_NEAR(q.x(), .0972540768, 3e-9); // Newton stops at 1e-3, its error is the square of that times the curvature
  EXPECT_NEAR(q.z(), .0963218469, 3e-9);
  // What is exchanged is the force, and its linearisation lies between the axes' own.
  EXPECT_EQ(body.impulse[0], body.force.x() * body.half_step.interval);
  EXPECT_EQ(body.impulse[2], body.force.z() * body.half_step.interval);
  EXPECT_GT(body.coefficient / body.half_step.interval, body.force.x() / .1);
  EXPECT_LT(body.coefficient / body.half_step.interval, body.force.z() / .1);
}

/// Random resistances and steps of all sizes against bisection.
TEST(VectorStep, SolvesItsEquation) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> decade(-3, 3), part(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    const Eigen::Array3d linear = (Eigen::Array3d(decade(random), decade(random), decade(random)) * .5).exp(),
                         square = linear * std::exp(decade(random)), yield = linear * (n % 2 ? 0 : .1);
    const auto resistance = [&](double s) -> VectorResistance {
      return {yield + linear * s + square * s * s, linear + 2 * square * s};
    };
    const Vector3d free(part(random), part(random), part(random));
    const double c = std::pow(10.0, decade(random));
    const VectorSlip step = vector_slip(resistance, yield, free, c, n % 3 ? free.norm() * .3 : 0.0);
    if (step.speed == 0.0) {
      EXPECT_GE(c * yield.maxCoeff(), free.norm() * .999); // inside the ellipsoid's box
      EXPECT_LE((free.array() / (c * yield)).matrix().norm(), 1.0);
      continue;
    }
    EXPECT_NEAR(step.slip.norm(), step.speed, 1e-5 * step.speed);
    const Eigen::Array3d f = resistance(step.speed).value;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(step.slip[k] + c * f[k] * step.slip[k] / step.speed, free[k], 1e-5 * free.norm());
      EXPECT_NEAR(free[k] - c * step.coefficient[k] * free[k], step.slip[k], 1e-9 * free.norm());
    }
    EXPECT_GT((step.coefficient * free.array() * step.slip.array()).sum(), 0.0); // dissipates
  }
}

/// A plain sphere has every bit of the law as it is without the word.
TEST(Oriented, ChangesNoBitOfAPlainSphere) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto any = [&](double scale) -> Vector3d {
    return scale * Vector3d(normal(random), normal(random), normal(random));
  };
  for (const char* fluid : kFluids)
    for (const std::string& law : drag_laws()) {
      if (law == "gidaspow")
        continue;
      for (int n = 0; n < 20; ++n) {
        const Vector3d flow = any(.1), force = any(1e-3), spin = any(10), torque = any(1e-7), curl = any(5);
        Vector3d out[2][2];
        for (const bool oriented : {false, true}) {
          OneBody body(nullptr);
          body.flow = flow;
          body.force = force;
          body.spin = spin;
          body.torque = torque;
          body.vorticity = curl;
          body.fraction = .7;
          body.apply(std::string(fluid) + "buoyancy off drag " + law + " drag_torque dennis" +
                     (oriented ? " oriented on strain_torque jeffery pitching_torque dabade" : ""));
          out[oriented][0] = body.force;
          out[oriented][1] = body.torque;
        }
        EXPECT_EQ(out[0][0], out[1][0]) << law;
        EXPECT_EQ(out[0][1], out[1][1]) << law;
      }
    }
}

/// All axes alike: no lift, no torque, at any orientation.
TEST(Oriented, ACubeFeelsNeitherLiftNorTorque) {
  eccentra::shape::Resistance r;
  r.translation *= 1.044;
  r.rotation *= 1.166;
  const OrientedShape shape = oriented_shape(r, Vector3d::Constant(.11), [](const Vector3d&) { return .9; });
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (const char* fluid : kFluids)
    for (const std::string& law : drag_laws()) {
      if (law == "gidaspow")
        continue;
      OneBody body(&shape, .85);
      body.turn(Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized());
      body.flow = Vector3d(.1, .2, -.05);
      body.gradient << 0, 3, 0, 1, 0, 0, 0, 0, 0;
      body.vorticity = Vector3d(0, 0, -2);
      body.spin = body.vorticity / 2;
      body.apply(std::string(fluid) + "buoyancy off drag " + law +
                 " drag_torque dennis oriented on strain_torque jeffery pitching_torque dabade");
      EXPECT_LT(body.force.cross(body.flow).norm(), 1e-12 * body.force.norm() * body.flow.norm()) << law;
      EXPECT_GT(body.force.dot(body.flow), 0.0);
      EXPECT_LT(body.torque.norm(), 1e-12 * body.force.norm() * kD) << law;
    }
}

/// Where nothing moves and the yield stress holds: exactly the fluid's velocity and half its vorticity; an ellipsoid.
TEST(Oriented, MudThatDoesNotYieldHolds) {
  const OrientedShape shape = spheroid();
  const std::string words =
      std::string("rheology herschel_bulkley 10 0.28 0.65 density 1000 buoyancy off drag chien ") +
      "drag_torque dennis oriented on strain_torque jeffery pitching_torque dabade";
  const double unit = M_PI / 8 * kD * kD * 10 * kAnsleySmith * 30;
  for (const double share : {.99, 1.01})
    for (const double angle : {0.0, .4, 1.1, M_PI / 2}) {
      OneBody body(&shape, Spheroid::kPhi);
      // On the ellipsoid sum (F_i/(K_i unit))^2 = 1.
      body.force = share * unit * Vector3d(Spheroid::kAcross * std::cos(angle), 0, Spheroid::kAlong * std::sin(angle));
      body.torque = Vector3d(1e-7, 0, 0);
      body.apply(words);
      EXPECT_EQ(body.force.norm() == 0.0, share < 1) << angle;
      if (share < 1) {
        EXPECT_EQ(body.torque.norm(), 0.0);
      }
    }
}

/// Jeffery: the torques vanish where the body turns as he says, in both fluids and at any Re_r.
TEST(Oriented, TorquesVanishAtJefferysSpin) {
  const OrientedShape shape = spheroid();
  for (const char* fluid : kFluids)
    for (const double rate : {.1, 100.0}) {
      OneBody body(&shape, Spheroid::kPhi);
      const Eigen::Quaterniond turn = Eigen::Quaterniond(.3, .5, -.2, .7).normalized();
      body.turn(turn);
      body.gradient << 0, rate, 0, 0, 0, 0, 0, 0, 0;
      body.vorticity = Vector3d(0, 0, -rate);
      const Matrix3d e = turn.conjugate().toRotationMatrix() * (.5 * (body.gradient + body.gradient.transpose())) *
                         turn.toRotationMatrix();
      const double b2 = Spheroid::kBeta * Spheroid::kBeta, b = (1 - b2) / (1 + b2);
      body.spin = body.vorticity / 2 + turn * Vector3d(b * e(1, 2), -b * e(0, 2), 0);
      body.apply(std::string(fluid) + "buoyancy off drag chien drag_torque dennis oriented on strain_torque jeffery");
      const double scale = M_PI * .01 * kD * kD * kD * rate;
      EXPECT_LT(body.torque.norm(), 1e-6 * scale);
      EXPECT_GT(std::abs(body.effects.back()->total()[0]), 1e-2 * scale);
    }
}

TEST(Oriented, NeverDrives) {
  const OrientedShape shape = spheroid();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const std::string& law : drag_laws()) {
    if (law == "gidaspow")
      continue;
    for (int n = 0; n < 100; ++n) {
      OneBody body(&shape, Spheroid::kPhi);
      body.half_step.integrated = n % 2;
      body.turn(Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized());
      body.flow = std::pow(10.0, normal(random)) * .1 * Vector3d(normal(random), normal(random), normal(random));
      body.apply(std::string(kFluids[n % 2]) + "buoyancy off drag " + law + " oriented on");
      EXPECT_GT(body.force.dot(body.flow), 0.0) << law;
    }
  }
}

/// The principal frame of the drag need not be the body's: a turned tensor gives a turned force.
TEST(Oriented, TurnsWithTheBody) {
  eccentra::shape::Resistance r;
  const Matrix3d turn = Eigen::AngleAxisd(.6, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  r.translation = turn * Vector3d(1.0, 1.2, 1.5).asDiagonal() * turn.transpose();
  r.rotation = turn * Vector3d(1.1, 1.3, 1.9).asDiagonal() * turn.transpose();
  r.rotation = (.5 * (r.rotation + r.rotation.transpose())).eval();
  r.centre = Vector3d(.1, 0, 0);
  const OrientedShape shape = oriented_shape(r, Vector3d(.09, .1, .13), [](const Vector3d&) { return M_PI / 4; });
  OneBody body(&shape);
  body.half_step.integrated = 0;
  const Eigen::Quaterniond lies = Eigen::Quaterniond(.3, .5, -.2, .7).normalized();
  body.turn(lies);
  body.flow = Vector3d(1e-6, 2e-6, -1e-6);
  body.spin = Vector3d(-1e-3, 2e-3, 1e-3);
  body.apply(std::string(kFluids[0]) + "buoyancy off drag schiller_naumann oriented on drag_torque dennis");
  const Matrix3d frame = lies.toRotationMatrix();
  const Vector3d force = 3 * M_PI * .1 * kD * frame * r.translation * frame.transpose() * body.flow;
  EXPECT_LT((body.force - force).norm(), 1e-3 * force.norm()); // Re 6e-5 has its own share
  const Vector3d arm = frame * r.centre * kD;
  const Vector3d torque =
      arm.cross(body.force) - M_PI * .1 * kD * kD * kD * frame * r.rotation * frame.transpose() * body.spin;
  EXPECT_LT((body.torque - torque).norm(), 1e-9 * torque.norm());
}

TEST(Oriented, WordsThatNeedEachOther) {
  const auto refuses = [](const std::string& words, const std::string& says) {
    OneBody body(nullptr);
    try {
      body.apply(std::string(kFluids[0]) + words);
      ADD_FAILURE() << words << " is taken";
    } catch (const std::invalid_argument& problem) {
      EXPECT_NE(std::string(problem.what()).find(says), std::string::npos) << problem.what();
    }
  };
  refuses("oriented on", "add drag NAME");
  refuses("oriented on drag gidaspow", "another drag law");
  refuses("drag chien strain_torque jeffery drag_torque dennis", "add oriented on");
  refuses("drag chien pitching_torque dabade drag_torque dennis", "add oriented on");
  refuses("drag chien oriented on pitching_torque dabade", "add drag_torque dennis");
  refuses("drag chien oriented on strain_torque jeffery", "add drag_torque dennis");
  refuses("drag chien oriented perhaps", "perhaps");
}

} // namespace
