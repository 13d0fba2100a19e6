// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which particles have a shape that matters, and the frame in which it lies.
#pragma once

#include "closures/effect.h"
#include "closures/oriented_shape.h"

#include <Eigen/Geometry>

#include <vector>

namespace eccentra::closures {

/// The kinds of a scene as forces of the real shape see them: null for a plain sphere.
class OrientedKinds {
 public:
  /// Reads the kinds of the scene; `shapes` must outlive this object.
  void prepare(const ShapeCatalogue& shapes) {
    shapes_ = &shapes;
    kinds_.clear();
    any_ = false;
    for (int kind = 0; kind < shapes.kinds(); ++kind) {
      kinds_.push_back(shapes.oriented(kind));
      any_ = any_ || kinds_.back();
    }
  }
  /// True if the scene has a shape that is not a sphere.
  bool any() const { return any_; }
  /// Null for a plain sphere.
  const OrientedShape* operator[](int kind) const { return kinds_[std::size_t(kind)]; }

  /// Turns body into world.
  Eigen::Matrix3d frame(int i) const {
    const double* q = shapes_->quaternion(i);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  }

  /// The same half step, in which only plain spheres feel the fluid; valid until the next call.
  HalfStep plain_spheres(const HalfStep& half_step) {
    plain_.resize(std::size_t(half_step.count));
    for (int i = 0; i < half_step.count; ++i)
      plain_[std::size_t(i)] =
          kinds_[std::size_t(half_step.kind[i])] ? half_step.mask[i] & ~half_step.group : half_step.mask[i];
    HalfStep plain = half_step;
    plain.mask = plain_.data();
    return plain;
  }

 private:
  const ShapeCatalogue* shapes_ = nullptr;
  std::vector<const OrientedShape*> kinds_;
  std::vector<int> plain_;
  bool any_ = false;
};

/// Three components as a vector.
inline Eigen::Vector3d vector_of(const double* v) {
  return {v[0], v[1], v[2]};
}

/// The symmetric part of a velocity gradient (rows d u_r/d x_c, world) in the body frame: xx yy zz yz xz xy.
inline Eigen::Matrix<double, 6, 1> strain_in_body(const double* gradient, const Eigen::Matrix3d& frame) {
  const Eigen::Matrix3d g = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(gradient);
  const Eigen::Matrix3d e = frame.transpose() * (0.5 * (g + g.transpose())) * frame;
  Eigen::Matrix<double, 6, 1> strain;
  strain << e(0, 0), e(1, 1), e(2, 2), e(1, 2), e(0, 2), e(0, 1);
  return strain;
}

/// 2 e:e of such a strain.
inline double rate_squared(const Eigen::Matrix<double, 6, 1>& strain) {
  return 2.0 * strain.head<3>().squaredNorm() + 4.0 * strain.tail<3>().squaredNorm();
}

} // namespace eccentra::closures
