// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One time step of a particle against a resistance that differs by axis: backward Euler by one scalar root.
#pragma once

#include "closures/implicit_step.h"

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace eccentra::closures {

/// Resistance along each axis at one speed, and its derivative with respect to the speed.
struct VectorResistance {
  Eigen::Array3d value, slope; ///< [N], and with respect to the speed [kg/s]
};

/// What a step leaves.
struct VectorSlip {
  double speed;               ///< |slip| after the step
  Eigen::Vector3d slip;       ///< by axis
  Eigen::Array3d coefficient; ///< force along an axis over the free slip along it; at rest 1/compliance
};

/// Solves q_i + c F_i(|q|) q_i/|q| = S_i for the slip q. `free` is S by axis; `compliance` c, 0 for what nothing can
/// move; `guess` any speed. `resistance(s)` gives F_i for s > 0, `at_rest` F_i(0). Where F depends on the axis alone
/// through factors, `back` may turn q_i into the vector whose length is the speed (null: q is that vector).
/// With q_i = s S_i/(s + c F_i(s)) the length of q is s at one speed alone, because each s + c F_i grows with s: the
/// same bracket and the same Newton's method as for one axis, on A(s) = |S| s/|q(s)|, which is s + c F for equal axes.
/// At rest where |S_i/(c F_i(0))| <= 1: the yield surface is an ellipsoid.
template <class Forces>
VectorSlip vector_slip(const Forces& resistance, const Eigen::Array3d& at_rest, const Eigen::Vector3d& free,
                       double compliance, double guess, const Eigen::Matrix3d* back = nullptr) {
  const auto length = [&](const Eigen::Vector3d& q) { return back ? (*back * q).norm() : q.norm(); };
  const double free_speed = length(free);
  if (compliance == 0.0)
    return {free_speed, free, resistance(free_speed).value / free_speed};
  const Eigen::Array3d yield = compliance * at_rest;
  const VectorSlip rest{0.0, Eigen::Vector3d::Zero(), Eigen::Array3d::Constant(1.0 / compliance)};
  if ((yield > 0.0).all() && length((free.array() / yield).matrix()) <= 1.0)
    return rest;
  double low = 0.0, high = free_speed;
  if (back)
    high *= 1e3; // modes are no lengths: the bracket is a safe one
  double s = guess > 0.0 && guess < free_speed ? guess : free_speed;
  for (int i = 0; i < kNewtonLimit; ++i) {
    const VectorResistance r = resistance(s);
    const Eigen::Array3d sum = s + compliance * r.value;
    const Eigen::Vector3d ratio = (free.array() / sum).matrix(); // q/s
    const Eigen::Vector3d change_of_ratio = (-ratio.array() * (1.0 + compliance * r.slope) / sum).matrix();
    const Eigen::Vector3d turned = back ? Eigen::Vector3d(*back * ratio) : ratio;
    const double size = turned.norm();
    const double slope_of_size = turned.dot(back ? Eigen::Vector3d(*back * change_of_ratio) : change_of_ratio) / size;
    const double excess = 1.0 - size; // > 0: s is too large
    (excess > 0.0 ? high : low) = s;
    // A = 1/size (in units of |S|) = 1.
    const double change = excess * size / slope_of_size;
    if (std::abs(change) <= kNewtonTolerance * s) {
      const double speed = s + change;
      const Eigen::Array3d value = r.value + r.slope * change;
      const Eigen::Array3d total = speed + compliance * value;
      return {speed, (speed * free.array() / total).matrix(), value / total};
    }
    s += change;
    if (!(s > low && s < high))
      s = low > 0.0 ? std::sqrt(low * high) : kBracketShrink * high;
    if (s < std::numeric_limits<double>::min())
      break;
  }
  return rest;
}

} // namespace eccentra::closures
