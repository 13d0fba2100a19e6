// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of the real shape: a tensor along axes of its own, so that the lift of an inclined body is part of it.
#pragma once

#include "closures/drag_effect.h"
#include "closures/oriented_loop.h"
#include "closures/vector_step.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <vector>

namespace eccentra::closures {

/// F = sum over axes e_i of (pi/8) d^2 X G_i(Re) (u.e_i)/U e_i, with G_i = K_i G_sphere(0) + G(Re) - G(0): the law's
/// creeping part for a sphere times the body's resistance K_i, and the law's inertial part at its own sphericity (and
/// phi_perp along the axis, where the law knows it). Plain spheres go through DragEffect unchanged. Each G_i > 0, so
/// that the force never drives. The answer to the fluid's velocity is the mean of the three axes; what is exchanged is
/// exact.
template <class Stress, class Law> class OrientedDrag : public DragEffect<Stress, Law> {
 public:
  /// `name` is that of the law in scripts.
  OrientedDrag(const char* name, const Rheology& fluid)
      : DragEffect<Stress, Law>(name, fluid), fluid_(fluid), stress_(fluid) {}

  void prepare(const ShapeCatalogue& shapes) override {
    DragEffect<Stress, Law>::prepare(shapes);
    kinds_.prepare(shapes);
    laws_.clear();
    for (int kind = 0; kind < shapes.kinds(); ++kind)
      laws_.push_back(make_law<Law>(shapes.factors(kind), fluid_));
  }

  void apply(const HalfStep& half_step) override {
    if (!kinds_.any()) {
      DragEffect<Stress, Law>::apply(half_step);
      return;
    }
    DragEffect<Stress, Law>::apply(kinds_.plain_spheres(half_step));
    const Law sphere = make_law<Law>(ShapeFactors{}, fluid_);
    for (int i = 0; i < half_step.count; ++i)
      if (const OrientedShape* shape = kinds_[half_step.kind[i]]; shape && half_step.mask[i] & half_step.group)
        push(half_step, i, *shape, sphere);
  }

 private:
  void push(const HalfStep& half_step, int i, const OrientedShape& shape, const Law& sphere) {
    const double d = 2.0 * half_step.radius[i];
    const double compliance = half_step.compliance(i);
    const Eigen::Matrix3d frame = kinds_.frame(i);
    const Eigen::Matrix3d to_axes = shape.drag_axes * frame.transpose();
    const Eigen::Vector3d slip = vector_of(half_step.samples.velocity()[i]) - vector_of(half_step.velocity[i]);
    const Eigen::Vector3d free = to_axes * (slip - compliance * vector_of(half_step.force[i]));
    if (!(free.squaredNorm() > 0.0))
      return;
    DragPlace place;
    place.fraction = std::clamp(half_step.samples.fraction()[i], kDragFractionFloor, 1.0);
    const double creeping = sphere.in(place)(0.0).value;
    const Law& law = laws_[std::size_t(half_step.kind[i])];
    using Placed = std::decay_t<decltype(law.in(place))>;
    const auto placed = [&](double crosswise) {
      place.crosswise = crosswise;
      return law.in(place);
    };
    // A law that does not know orientation has one inertial part for all axes.
    const std::array<Placed, 3> laws = {placed(shape.crosswise[0]), placed(shape.crosswise[1]),
                                        placed(shape.crosswise[2])};
    Eigen::Array3d extra; // G_i - G
    for (int k = 0; k < 3; ++k)
      extra[k] = shape.drag[k] * creeping - laws[std::size_t(k)](0.0).value;
    const auto scale = drag_resistance<Law>(stress_, laws[0], d, fluid_.density, place.fraction);
    const auto resistance = [&](double speed) -> VectorResistance {
      const ValueAndSlope x = stress_(speed, scale.inverse_length);
      const double inertial = scale.inertia * speed * speed;
      const double re = inertial / x.value;
      VectorResistance r;
      ValueAndSlope g{};
      for (int k = 0; k < 3; ++k) {
        if (k == 0 || Law::kOriented)
          g = laws[std::size_t(k)](re);
        const double value = g.value + extra[k];
        r.value[k] = scale.area * x.value * value;
        r.slope[k] = scale.area * ((value - re * g.slope) * x.slope + g.slope * 2.0 * inertial / speed);
      }
      return r;
    };
    Eigen::Array3d at_rest;
    for (int k = 0; k < 3; ++k)
      at_rest[k] = scale.area * stress_.at_rest() * (laws[std::size_t(k)](0.0).value + extra[k]);
    const VectorSlip step = vector_slip(resistance, at_rest, free, compliance, slip.norm());
    const Eigen::Vector3d force = to_axes.transpose() * (step.coefficient * free.array()).matrix();
    half_step.exchange(i, force.data(), step.coefficient.mean());
    for (int k = 0; k < 3; ++k)
      this->total_[k] += force[k];
    if (half_step.mask[i] & half_step.frozen)
      return;
    for (int k = 0; k < 3; ++k)
      half_step.force[i][k] = step.speed == 0.0 ? slip[k] / compliance : half_step.force[i][k] + force[k];
    if (shape.off_centre) {
      const Eigen::Vector3d torque = (frame * shape.centre * d).cross(force);
      for (int k = 0; k < 3; ++k)
        half_step.torque[i][k] += torque[k];
    }
  }

  OrientedKinds kinds_;
  Rheology fluid_;
  Stress stress_;
  std::vector<Law> laws_;
};

} // namespace eccentra::closures
