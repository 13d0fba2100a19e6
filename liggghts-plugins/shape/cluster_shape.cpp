// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From spheres in any frame to a shape in its body frame.
#include "shape/cluster_shape.h"

#include "shape/rounded_hull.h"
#include "shape/union_geometry.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// Moments of inertia that differ by less than this part of the largest are taken as equal: files carry few digits, and
/// a body frame must not hang on the last of them.
constexpr double equal_moments = 1e-6;
/// A free area below this part of a sphere is round-off, not something that another body can touch.
constexpr double negligible_exposure = 1e-9;
/// Centres of mass closer to the origin than this part of the size are at the origin.
constexpr double negligible_offset = 1e-12;

/// Bounding radii beyond these [m] are mistakes, and their fifth powers would not stay finite.
constexpr double kMinSize = 1e-12, kMaxSize = 1e12;

/// Rows are the body axes in the given frame: principal, right-handed, and as near to the given axes as the inertia
/// allows.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& inertia) {
  const double scale = inertia.diagonal().cwiseAbs().maxCoeff();
  const Eigen::Vector3d off(inertia(0, 1), inertia(0, 2), inertia(1, 2));
  if (off.cwiseAbs().maxCoeff() < equal_moments * scale)
    return Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  const Eigen::Vector3d moment = solver.eigenvalues(); // ascending
  const Eigen::Matrix3d vectors = solver.eigenvectors();
  const bool low_equal = moment[1] - moment[0] < equal_moments * scale;
  const bool high_equal = moment[2] - moment[1] < equal_moments * scale;
  Eigen::Matrix3d axes;
  if (low_equal || high_equal) {
    // One axis of symmetry; the other two are free: take them near the given ones.
    Eigen::Vector3d unique = vectors.col(low_equal ? 2 : 0);
    int k = 0;
    unique.cwiseAbs().maxCoeff(&k);
    if (unique[k] < 0)
      unique = -unique;
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const Eigen::Vector3d side = Eigen::Vector3d::Unit(next) - unique[next] * unique;
    axes.row(k) = unique;
    axes.row(next) = side.normalized();
    axes.row(last) = unique.cross(side.normalized());
    return axes;
  }
  // Three axes: the order and the signs that turn the given frame least.
  std::array<int, 3> order{0, 1, 2}, best = order;
  double closest = -1;
  do {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += std::abs(vectors(k, order[k]));
    if (sum > closest + equal_moments) {
      closest = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  for (int k = 0; k < 3; ++k)
    axes.row(k) = vectors.col(best[k]).transpose() * (vectors(k, best[k]) < 0 ? -1 : 1);
  if (axes.determinant() < 0)
    axes.row(2) *= -1;
  return axes;
}

/// Makes moments that are equal within the tolerance exactly equal.
Eigen::Vector3d merge_equal(Eigen::Vector3d moment) {
  const double tolerance = equal_moments * moment.maxCoeff();
  if (moment.maxCoeff() - moment.minCoeff() < tolerance)
    return Eigen::Vector3d::Constant(moment.mean());
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    if (std::abs(moment[a] - moment[b]) < tolerance) {
      moment[a] = moment[b] = (moment[a] + moment[b]) / 2;
      break;
    }
  }
  return moment;
}

} // namespace

ClusterShape::ClusterShape(std::string name, std::vector<Sphere> spheres, const MassProperties& properties)
    : name_(std::move(name)), spheres_(std::move(spheres)), volume_(properties.volume), surface_(properties.surface) {
  require_connected(spheres_);
  if (!(volume_ > 0) || !(surface_ > 0) || !std::isfinite(volume_) || !std::isfinite(surface_) ||
      !properties.centre.allFinite() || !properties.inertia_per_mass.allFinite())
    throw std::invalid_argument("shape '" + name_ + "' has no volume or a mass property that is not a finite number");
  const Eigen::Matrix3d axes = principal_axes(properties.inertia_per_mass);
  inertia_per_mass_ = merge_equal((axes * properties.inertia_per_mass * axes.transpose()).diagonal());
  if (!(inertia_per_mass_.minCoeff() > 0))
    throw std::invalid_argument("shape '" + name_ + "' has a moment of inertia that is not greater than 0");
  Eigen::Vector3d origin = properties.centre;
  const double size = std::cbrt(volume_);
  for (int k = 0; k < 3; ++k)
    if (std::abs(origin[k]) < negligible_offset * size)
      origin[k] = 0;
  given_centre_ = origin;
  bounding_radius_ = 0;
  for (Sphere& s : spheres_) {
    s.centre = axes * (s.centre - origin);
    bounding_radius_ = std::max(bounding_radius_, s.centre.norm() + s.radius);
  }
  if (!(bounding_radius_ > kMinSize && bounding_radius_ < kMaxSize))
    throw std::invalid_argument("shape '" + name_ + "' has a bounding radius of " + std::to_string(bounding_radius_) +
                                " m, which is no size of a body; expected 1e-12 to 1e12 m: check diameter and scale");
  const std::vector<double> exposed = measure_union(spheres_).exposed_area;
  smallest_radius_ = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (exposed[i] > negligible_exposure * 4 * M_PI * spheres_[i].radius * spheres_[i].radius) {
      surface_spheres_.push_back(static_cast<int>(i));
      smallest_radius_ = std::min(smallest_radius_, spheres_[i].radius);
    }
}

ClusterShape::ClusterShape(const RoundedHull& hull)
    : name_(hull.name()), volume_(hull.volume()), surface_(hull.surface()), given_centre_(hull.given_centre()),
      inertia_per_mass_(hull.inertia_per_mass()), bounding_radius_(hull.bounding_radius()),
      smallest_radius_(hull.radius()), hull_(std::make_shared<RoundedHull>(hull)) {
  for (const Eigen::Vector3d& point : hull.points()) {
    surface_spheres_.push_back(static_cast<int>(spheres_.size()));
    spheres_.push_back({point, hull.radius()});
  }
}

double ClusterShape::equivalent_radius() const {
  return std::cbrt(3 * volume_ / (4 * M_PI));
}

double ClusterShape::sphericity() const {
  return std::cbrt(36 * M_PI * volume_ * volume_) / surface_;
}

} // namespace eccentra::shape
