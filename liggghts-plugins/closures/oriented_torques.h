// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Torques on the real shape: resistance to spin, the turning by strain (Jeffery), and pitching by inertia of the flow.
#pragma once

#include "closures/oriented_loop.h"
#include "closures/rotational_drag.h"
#include "closures/vector_step.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace eccentra::closures {

/// Rates around a particle that yield or thin the fluid [1/s]: by slip and, where the gradient of the flow travels, by
/// strain. The spin is left to SpinStress.
inline double rate_around(const HalfStep& half_step, int i, double d, bool newtonian) {
  if (newtonian)
    return 0.0;
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double slip = (half_step.samples.velocity()[i][k] - half_step.velocity[i][k]) / d;
    square += slip * slip;
  }
  if (half_step.samples.velocity_gradient())
    square += rate_squared(strain_in_body(half_step.samples.velocity_gradient()[i], Eigen::Matrix3d::Identity()));
  return std::sqrt(square);
}

/// Torque on a body that spins relative to the fluid: pi mu d^3 f_R K_rot (w_f/2 - omega_p), f_R = C_DR Re_r/(64 pi) of
/// Dennis et al.; implicit in the spin along each mode of rotation. Plain spheres go through RotationalDrag unchanged.
template <class Stress> class OrientedRotationalDrag : public RotationalDrag<Stress> {
 public:
  /// Reads density and stress scale of `fluid`.
  explicit OrientedRotationalDrag(const Rheology& fluid)
      : RotationalDrag<Stress>(fluid), stress_(fluid), density_(fluid.density), newtonian_(fluid.newtonian()) {}

  void prepare(const ShapeCatalogue& shapes) override {
    RotationalDrag<Stress>::prepare(shapes);
    kinds_.prepare(shapes);
  }
  void apply(const HalfStep& half_step) override {
    if (!kinds_.any()) {
      RotationalDrag<Stress>::apply(half_step);
      return;
    }
    RotationalDrag<Stress>::apply(kinds_.plain_spheres(half_step));
    for (int i = 0; i < half_step.count; ++i)
      if (const OrientedShape* shape = kinds_[half_step.kind[i]]; shape && half_step.mask[i] & half_step.group)
        turn(half_step, i, *shape);
  }

 private:
  void turn(const HalfStep& half_step, int i, const OrientedShape& shape) {
    const double d = 2.0 * half_step.radius[i];
    const double compliance = half_step.compliance(i) / (d * d);
    const Eigen::Matrix3d frame = kinds_.frame(i);
    const Eigen::Vector3d spin =
        frame.transpose() * (0.5 * vector_of(half_step.samples.vorticity()[i]) - vector_of(half_step.spin[i]));
    const Eigen::Vector3d other = frame.transpose() * vector_of(half_step.torque[i]);
    const Eigen::Vector3d free = spin - compliance * other.cwiseQuotient(shape.inertia);
    if (!(free.squaredNorm() > 0.0))
      return;
    const Resistance<SpinStress<Stress>, Dennis> sphere{{stress_, rate_around(half_step, i, d, newtonian_)},
                                                        Dennis(),
                                                        Dennis::kAreaPart * d * d * d,
                                                        1.0,
                                                        density_ * d * d};
    // In modes: dy/dt = -(m d^2)^-1 rate R(|q|)/|q| y, q the spin.
    const auto resistance = [&](double speed) -> VectorResistance {
      const ValueAndSlope r = sphere(speed);
      return {shape.rates.array() * r.value, shape.rates.array() * r.slope};
    };
    const VectorSlip step = vector_slip(resistance, (shape.rates.array() * sphere.at_rest()).eval(), shape.modes * free,
                                        compliance, spin.norm(), shape.shared_modes ? nullptr : &shape.modes_inverse);
    // The coefficient is that of modes; the torque is what takes the spin from `free` to what is left, I (S - q)/dt.
    const Eigen::Vector3d change = shape.modes_inverse * (step.coefficient * (shape.modes * free).array()).matrix();
    const Eigen::Vector3d torque = frame * shape.inertia.cwiseProduct(change);
    for (int k = 0; k < 3; ++k)
      this->total_[k] += torque[k];
    if (half_step.mask[i] & half_step.frozen)
      return;
    const Eigen::Vector3d at_rest = frame * (shape.inertia.cwiseProduct(spin) / compliance);
    for (int k = 0; k < 3; ++k)
      half_step.torque[i][k] = step.speed == 0.0 ? at_rest[k] : half_step.torque[i][k] + torque[k];
  }

  OrientedKinds kinds_;
  Stress stress_;
  double density_;
  bool newtonian_;
};

/// A torque on bodies that are no spheres, explicit, in the body frame: of(i, shape, frame) gives it.
class BodyTorque : public Effect {
 public:
  /// Needs drag_torque, see requires_slot().
  explicit BodyTorque(const Rheology& fluid) : fluid_(fluid) {}
  bool is_torque() const override { return true; }
  /// A spin that nothing damps would grow.
  const char* requires_slot() const override { return "drag_torque"; }
  void prepare(const ShapeCatalogue& shapes) override { kinds_.prepare(shapes); }

 protected:
  /// Calls of(i, shape, frame) for every such body of the group and adds its torque [N m], body frame.
  template <class Torque> void for_each(const HalfStep& half_step, Torque&& of) {
    std::fill_n(total_, 3, 0.0);
    for (int i = 0; i < half_step.count; ++i) {
      const OrientedShape* shape = kinds_[half_step.kind[i]];
      if (!shape || !(half_step.mask[i] & half_step.group))
        continue;
      const Eigen::Matrix3d frame = kinds_.frame(i);
      const Eigen::Vector3d torque = frame * of(i, *shape, frame);
      const double held = half_step.mask[i] & half_step.frozen ? 0.0 : 1.0;
      for (int k = 0; k < 3; ++k) {
        half_step.torque[i][k] += held * torque[k];
        total_[k] += torque[k];
      }
    }
  }
  Rheology fluid_;      ///< as given
  OrientedKinds kinds_; ///< of the scene
};

/// Torque by the strain e of the flow: pi mu d^3 f_R S:e, the rest of Jeffery's (1922) beside the rotational drag. With
/// the same mu and f_R as that one, a body that is free to turn has Jeffery's spin w_f/2 + K_rot^-1 S:e at any Re_r.
template <class Stress> class StrainTorque : public BodyTorque {
 public:
  /// Viscosity by the stress scale of `fluid`.
  explicit StrainTorque(const Rheology& fluid) : BodyTorque(fluid), stress_(fluid) {}
  const char* name() const override { return "strain_torque"; }
  unsigned needs() const override {
    return link::kVelocityGradient | link::kVorticity | (fluid_.newtonian() ? 0u : unsigned(link::kVelocity));
  }
  std::vector<Validity> validity() const override { return {{kSpinReynolds, 0.0, Dennis::kSwitchRe}}; }
  void apply(const HalfStep& half_step) override {
    for_each(half_step, [&](int i, const OrientedShape& shape, const Eigen::Matrix3d& frame) -> Eigen::Vector3d {
      const double d = 2.0 * half_step.radius[i];
      const auto strain = strain_in_body(half_step.samples.velocity_gradient()[i], frame);
      const double spin = (0.5 * vector_of(half_step.samples.vorticity()[i]) - vector_of(half_step.spin[i])).norm();
      const double around = rate_around(half_step, i, d, fluid_.newtonian());
      const double rate = std::sqrt(around * around + spin * spin);
      if (!(strain.squaredNorm() > 0.0))
        return Eigen::Vector3d::Zero();
      const double viscosity = fluid_.newtonian() ? fluid_.consistency : stress_(rate, 1.0).value / rate;
      const double factor = Dennis()(fluid_.density * d * d * spin / viscosity).value / Dennis::kStokes;
      return kPi * viscosity * d * d * d * factor * (shape.rotation * (shape.spin_by_strain * strain));
    });
  }

 private:
  Stress stress_;
};

/// Torque by inertia of the flow past an inclined body: T_k = -s (1/2) rho U^2 (pi/8) d^3 C'(Re) (u_i/U)(u_j/U), (i, j,
/// k) cyclic, s = 1 where axis i is the longer one: turns the longest axis across the slip.
class PitchingTorque : public BodyTorque {
 public:
  using BodyTorque::BodyTorque;
  const char* name() const override { return "pitching_torque"; }
  unsigned needs() const override { return link::kVelocity; }
  std::vector<Validity> validity() const override { return {{kReynolds, 0.0, kPitchingHighestRe}}; }
  void apply(const HalfStep& half_step) override {
    for_each(half_step, [&](int i, const OrientedShape& shape, const Eigen::Matrix3d& frame) -> Eigen::Vector3d {
      const double d = 2.0 * half_step.radius[i];
      const Eigen::Vector3d slip =
          frame.transpose() * (vector_of(half_step.samples.velocity()[i]) - vector_of(half_step.velocity[i]));
      const double speed = slip.norm();
      const double re = reynolds_herschel_bulkley(fluid_, speed, d);
      Eigen::Vector3d torque = Eigen::Vector3d::Zero();
      if (!(re > 0.0))
        return torque;
      for (int k = 0; k < 3; ++k)
        if (shape.pitching[k].sign != 0.0)
          torque[k] = -shape.pitching[k].sign * kPi / 16.0 * fluid_.density * d * d * d * shape.pitching[k](re) *
                      slip[(k + 1) % 3] * slip[(k + 2) % 3];
      return torque;
    });
  }
};

} // namespace eccentra::closures
