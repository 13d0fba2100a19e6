// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// delta_e of clusters over evenly spread directions; rounded bodies have rounded_eccentricity.h.
#include "shape/eccentricity.h"

#include "shape/over_directions.h"
#include "shape/rounded_eccentricity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr int cluster_pair_count = 20000;   ///< mean good to 2e-3
constexpr int surface_point_count = 400000; ///< over all spheres, before the covered ones are dropped

/// Sub-spheres that can be touched, as arrays for the inner loops.
struct Touchable {
  Eigen::Matrix3Xd centre;
  Eigen::ArrayXd radius;
  explicit Touchable(const ClusterShape& shape)
      : centre(3, shape.surface_spheres().size()), radius(shape.surface_spheres().size()) {
    for (std::size_t k = 0; k < shape.surface_spheres().size(); ++k) {
      const Sphere& s = shape.spheres()[shape.surface_spheres()[k]];
      centre.col(k) = s.centre;
      radius[k] = s.radius;
    }
  }
};

/// How far a sub-sphere reaches in some direction.
struct Front {
  double reach;
  int index;
};

/// Sub-spheres in the order in which they lead in `direction`.
void sort_by_front(const Touchable& t, const Eigen::Vector3d& direction, std::vector<Front>& front) {
  front.clear();
  for (int k = 0; k < t.radius.size(); ++k)
    front.push_back({t.centre.col(k).dot(direction) + t.radius[k], k});
  std::sort(front.begin(), front.end(),
            [](const Front& x, const Front& y) { return x.reach != y.reach ? x.reach > y.reach : x.index < y.index; });
}

double plane_eccentricity(const Touchable& t, const Eigen::Vector3d& normal) {
  int touched = 0;
  ((t.centre.transpose() * normal).array() + t.radius).maxCoeff(&touched);
  return t.centre.col(touched).cross(normal).norm();
}

double sphere_eccentricity(const Touchable& t, const Eigen::Vector3d& direction, double radius) {
  double farthest = -std::numeric_limits<double>::max(), result = 0;
  for (int k = 0; k < t.radius.size(); ++k) {
    const double along = t.centre.col(k).dot(direction), across2 = t.centre.col(k).squaredNorm() - along * along;
    const double reach = t.radius[k] + radius, rest = reach * reach - across2;
    if (rest <= 0)
      continue;
    const double distance = along + std::sqrt(rest);
    if (distance > farthest) {
      farthest = distance;
      result = std::sqrt(std::max(0.0, across2)) * distance / reach; // |c x (distance u - c)| / reach
    }
  }
  return result;
}

} // namespace

EccentricityDistribution::EccentricityDistribution(std::vector<double> samples, double least, double largest)
    : sorted_(std::move(samples)) {
  std::sort(sorted_.begin(), sorted_.end());
  min_ = std::min(least, sorted_.front());
  max_ = std::max(largest, sorted_.back());
  mean_ = std::accumulate(sorted_.begin(), sorted_.end(), 0.0) / static_cast<double>(sorted_.size());
}

double EccentricityDistribution::quantile(double probability) const {
  if (probability <= 0)
    return min_;
  if (probability >= 1)
    return max_;
  const double place = probability * static_cast<double>(sorted_.size()) - 0.5;
  const std::size_t below = static_cast<std::size_t>(std::max(0.0, std::floor(place)));
  const std::size_t above = std::min(below + 1, sorted_.size() - 1);
  const double part = std::clamp(place - static_cast<double>(below), 0.0, 1.0);
  return (1 - part) * sorted_[below] + part * sorted_[above];
}

EccentricityDistribution eccentricity_plane(const ClusterShape& shape) {
  if (shape.hull())
    return eccentricity_plane(*shape.hull());
  const Touchable t(shape);
  const double unit = shape.equivalent_radius();
  return over_directions([&](const Eigen::Vector3d& n) { return plane_eccentricity(t, n) / unit; });
}

EccentricityDistribution eccentricity_sphere(const ClusterShape& shape, double radius) {
  if (shape.hull())
    return eccentricity_sphere(*shape.hull(), radius);
  if (!(radius > 0) || !std::isfinite(radius))
    throw std::invalid_argument("the radius of the sphere that a shape meets must be a number greater than 0");
  const Touchable t(shape);
  const double unit = shape.equivalent_radius();
  return over_directions([&](const Eigen::Vector3d& n) { return sphere_eccentricity(t, n, radius) / unit; });
}

EccentricityDistribution eccentricity_surface(const ClusterShape& shape) {
  if (shape.hull())
    return eccentricity_surface(*shape.hull());
  const std::vector<Sphere>& spheres = shape.spheres();
  const double unit = shape.equivalent_radius();
  double total = 0;
  for (const int k : shape.surface_spheres())
    total += spheres[k].radius * spheres[k].radius;
  std::vector<double> samples;
  double least = std::numeric_limits<double>::max();
  for (const int k : shape.surface_spheres()) {
    const Sphere& self = spheres[k];
    std::vector<Sphere> neighbours; // inner spheres, too, cover what faces them
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      const double distance = (spheres[j].centre - self.centre).norm();
      if (distance > 0 && distance < self.radius + spheres[j].radius)
        neighbours.push_back(spheres[j]);
    }
    const int count = static_cast<int>(std::lround(surface_point_count * self.radius * self.radius / total));
    const auto is_free = [&](const Eigen::Vector3d& n) {
      const Eigen::Vector3d point = self.centre + self.radius * n;
      return std::none_of(neighbours.begin(), neighbours.end(), [&](const Sphere& other) {
        return (point - other.centre).squaredNorm() < other.radius * other.radius;
      });
    };
    for (int p = 0; p < count; ++p) {
      const Eigen::Vector3d n = fibonacci_direction(p, count);
      if (is_free(n))
        samples.push_back(self.centre.cross(n).norm() / unit);
    }
    // Straight away from the centre of mass, or towards it, the normal passes through it: the least value there is.
    const Eigen::Vector3d away = self.centre.norm() > 0 ? self.centre.normalized() : Eigen::Vector3d::UnitZ();
    if (is_free(away) || is_free(-away))
      least = 0;
  }
  if (samples.empty())
    throw std::invalid_argument("shape '" + shape.name() + "' has no surface that can be sampled");
  const double most = *std::max_element(samples.begin(), samples.end());
  return {std::move(samples), least, most};
}

EccentricityDistribution eccentricity_cluster(const ClusterShape& shape, const ClusterShape& other) {
  if (shape.hull() || other.hull())
    return rounded_eccentricity_cluster(shape, other, cluster_pair_count);
  const Touchable a(shape), b(other);
  const double unit = shape.equivalent_radius();
  std::vector<double> samples(cluster_pair_count);
  std::vector<Front> a_front, b_front;
  for (int s = 0; s < cluster_pair_count; ++s) {
    const DirectionAndRotation way = even_direction_and_rotation(s);
    const Eigen::Matrix3d turn = way.rotation.toRotationMatrix();
    sort_by_front(a, way.direction, a_front);
    sort_by_front(b, -(turn.transpose() * way.direction), b_front);
    // The other cluster's centre of mass is at distance * direction when two sub-spheres touch; no pair can touch
    // farther out than its two fronts together, and the first contact is the farthest.
    double farthest = -std::numeric_limits<double>::max();
    for (const Front& fa : a_front) {
      if (fa.reach + b_front[0].reach <= farthest)
        break;
      const Eigen::Vector3d own = a.centre.col(fa.index);
      for (const Front& fb : b_front) {
        if (fa.reach + fb.reach <= farthest)
          break;
        const Eigen::Vector3d offset = own - turn * b.centre.col(fb.index);
        const double along = offset.dot(way.direction), touch = a.radius[fa.index] + b.radius[fb.index];
        const double rest = touch * touch - offset.squaredNorm() + along * along;
        if (rest <= 0 || along + std::sqrt(rest) <= farthest)
          continue;
        farthest = along + std::sqrt(rest);
        samples[s] = own.cross(farthest * way.direction - offset).norm() / (touch * unit);
      }
    }
  }
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  const double least = *low, most = *high;
  return {std::move(samples), least, most};
}

} // namespace eccentra::shape
