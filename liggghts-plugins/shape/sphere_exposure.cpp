// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Caps that neighbours cut from a sphere, and the arcs that they leave on its circles of latitude.
#include "shape/sphere_exposure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace eccentra::shape {
namespace {

constexpr double full_turn = 2 * M_PI;
/// Directions this close to a cap's rim count as on it: a break too many costs a little time, one too few costs
/// accuracy.
constexpr double rim_tolerance = 1e-9;
/// Two cap axes this close to parallel have no distinct crossing points of their rims.
constexpr double parallel_tolerance = 1e-14;

bool cap_contains(const Cap& outer, const Cap& inner) {
  const double between = std::atan2(outer.axis.cross(inner.axis).norm(), outer.axis.dot(inner.axis));
  return between + std::acos(inner.height) <= std::acos(outer.height);
}

/// Drops caps that another cap holds; of equal caps the first stays.
std::vector<Cap> without_contained(const std::vector<Cap>& caps) {
  std::vector<Cap> kept;
  for (std::size_t i = 0; i < caps.size(); ++i) {
    bool contained = false;
    for (std::size_t j = 0; j < caps.size() && !contained; ++j)
      if (j != i && cap_contains(caps[j], caps[i]))
        contained = !(cap_contains(caps[i], caps[j]) && i < j);
    if (!contained)
      kept.push_back(caps[i]);
  }
  return kept;
}

} // namespace

SphereExposure::SphereExposure(const std::vector<Sphere>& spheres, std::size_t index) {
  const Sphere& self = spheres[index];
  std::vector<Cap> caps;
  for (std::size_t j = 0; j < spheres.size(); ++j) {
    if (j == index)
      continue;
    const Eigen::Vector3d offset = spheres[j].centre - self.centre;
    const double distance = offset.norm(), other = spheres[j].radius;
    if (distance >= self.radius + other)
      continue;
    if (distance + self.radius <= other) {
      // Of two identical spheres the first one owns the surface.
      const bool identical = distance == 0 && other == self.radius;
      if (!identical || j < index) {
        swallowed_ = true;
        return;
      }
      continue;
    }
    if (distance + other <= self.radius)
      continue;
    const double height =
        (self.radius * self.radius + distance * distance - other * other) / (2 * self.radius * distance);
    caps.push_back({offset / distance, std::clamp(height, -1.0, 1.0)});
  }
  caps_ = without_contained(caps);
  for (const Cap& cap : caps_) {
    longitude_.push_back(std::atan2(cap.axis.y(), cap.axis.x()));
    tilt_.push_back(std::hypot(cap.axis.x(), cap.axis.y()));
  }
}

bool SphereExposure::is_free(const Eigen::Vector3d& direction, std::size_t skip1, std::size_t skip2) const {
  for (std::size_t k = 0; k < caps_.size(); ++k)
    if (k != skip1 && k != skip2 && direction.dot(caps_[k].axis) > caps_[k].height + rim_tolerance)
      return false;
  return true;
}

std::vector<double> SphereExposure::break_heights() const {
  std::vector<double> heights{-1.0, 1.0};
  for (std::size_t i = 0; i < caps_.size(); ++i) {
    const Cap& a = caps_[i];
    const double rim = std::sqrt(std::max(0.0, 1 - a.height * a.height));
    // Highest and lowest point of the rim, where arcs appear or vanish.
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ() - a.axis.z() * a.axis;
    up = up.norm() > parallel_tolerance ? Eigen::Vector3d(up.normalized()) : a.axis.unitOrthogonal();
    for (double side : {-1.0, 1.0}) {
      const Eigen::Vector3d point = a.height * a.axis + side * rim * up;
      if (is_free(point, i, i))
        heights.push_back(point.z());
    }
    // Where two rims cross, arcs meet.
    for (std::size_t j = i + 1; j < caps_.size(); ++j) {
      const Cap& b = caps_[j];
      const double cosine = a.axis.dot(b.axis);
      const Eigen::Vector3d normal = a.axis.cross(b.axis);
      const double sine2 = normal.squaredNorm();
      if (sine2 < parallel_tolerance)
        continue;
      const double alpha = (a.height - b.height * cosine) / sine2, beta = (b.height - a.height * cosine) / sine2;
      const Eigen::Vector3d base = alpha * a.axis + beta * b.axis;
      const double rest = (1 - base.squaredNorm()) / sine2;
      if (rest < -rim_tolerance)
        continue;
      const double gamma = std::sqrt(std::max(0.0, rest));
      for (double side : {-1.0, 1.0}) {
        const Eigen::Vector3d point = base + side * gamma * normal;
        if (is_free(point, i, j))
          heights.push_back(point.z());
      }
    }
  }
  for (double& z : heights)
    z = std::clamp(z, -1.0, 1.0);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 1e-14; }),
                heights.end());
  heights.back() = 1.0;
  return heights;
}

const std::vector<Arc>& SphereExposure::free_arcs(double height) {
  covered_.clear();
  free_.clear();
  const double ring = std::sqrt(std::max(0.0, 1 - height * height));
  for (std::size_t k = 0; k < caps_.size(); ++k) {
    const double need = caps_[k].height - height * caps_[k].axis.z(), reach = ring * tilt_[k];
    if (need >= reach)
      continue;
    if (need <= -reach)
      return free_;
    const double half = std::acos(need / reach);
    double begin = longitude_[k] - half;
    if (begin < 0)
      begin += full_turn;
    const double end = begin + 2 * half;
    covered_.push_back({begin, std::min(end, full_turn)});
    if (end > full_turn)
      covered_.push_back({0, end - full_turn});
  }
  std::sort(covered_.begin(), covered_.end(), [](const Arc& a, const Arc& b) { return a.begin < b.begin; });
  double reached = 0;
  for (const Arc& arc : covered_) {
    if (arc.begin > reached)
      free_.push_back({reached, arc.begin});
    reached = std::max(reached, arc.end);
  }
  if (reached < full_turn)
    free_.push_back({reached, full_turn});
  return free_;
}

} // namespace eccentra::shape
