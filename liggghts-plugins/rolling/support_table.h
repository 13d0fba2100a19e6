// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which sub-spheres of a shape a contact in a given direction can touch, found without looking at all of them. Pure.
#pragma once

#include "shape/cluster_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace eccentra::rolling {

/// What the sub-spheres that carry a contact do, in units of R_eq: multiply `arm` by R, `spread` by R^2.
struct CarriedContact {
  Eigen::Vector3d arm;    ///< r_c of eq (32): mean of the centres, weighted by their share of the force
  Eigen::Matrix3d spread; ///< mean of c c^T, weighted alike; only where several carry
  bool several;           ///< else `arm` is the centre of the only one
};

/// Built once per shape, in units of its equivalent radius R_eq; directions in the body frame. Knows only the
/// sub-spheres that are furthest in some direction, the corners of the convex hull of the shape: those that lie between
/// others on a flat face or straight edge add nothing to how far it reaches.
class SupportTable {
 public:
  explicit SupportTable(const shape::ClusterShape& shape);

  /// The contact of a flat partner in unit direction d (from the centre towards the partner) at the given depth, in
  /// units of R_eq; depths beyond kDeepest count as kDeepest. Sub-spheres that a flat partner would overlap by x share
  /// the force in proportion to x^(3/2), as Hertz contacts do. Face on, a cube thus stands on all sub-spheres of a
  /// face, not on one.
  CarriedContact carried(const Eigen::Vector3d& d, double depth) const;

  /// Largest lever max |c x d| over all directions, in units of R_eq.
  double largest_lever() const { return largest_lever_; }
  /// How far the shape reaches in direction d, max(c . d + r), in units of R_eq.
  double reach(const Eigen::Vector3d& d) const;

  static constexpr int kMostSpheres = 1024;
  static constexpr double kDeepest = 0.01;

 private:
  static constexpr int kCellsPerEdge = 64; ///< of each face of the cube that directions are sorted into

  static int cell_of(const Eigen::Vector3d& d);
  static Eigen::Vector3d centre_of(int cell, double& half_angle);
  void keep_corners();
  void fill_cells();

  std::vector<shape::Sphere> spheres_;
  std::vector<int> first_; ///< per cell: its first candidate; one more entry at the end
  std::vector<std::uint16_t> candidates_;
  double largest_lever_ = 0;
};

inline int SupportTable::cell_of(const Eigen::Vector3d& d) {
  const double x = std::abs(d[0]);
  const double y = std::abs(d[1]);
  const double z = std::abs(d[2]);
  const int axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
  const int next = axis == 2 ? 0 : axis + 1;
  const int last = axis == 0 ? 2 : axis - 1;
  const int face = 2 * axis + (d[axis] < 0.0);
  constexpr double half = 0.5 * kCellsPerEdge;
  const double scale = half / std::abs(d[axis]);
  const auto place = [scale](double u) { return std::min(kCellsPerEdge - 1, static_cast<int>(u * scale + half)); };
  return (face * kCellsPerEdge + place(d[next])) * kCellsPerEdge + place(d[last]);
}

inline CarriedContact SupportTable::carried(const Eigen::Vector3d& d, double depth) const {
  const int cell = cell_of(d);
  const std::uint16_t* const candidate = candidates_.data() + first_[cell];
  const int count = first_[cell + 1] - first_[cell];
  CarriedContact contact;
  contact.several = false;
  if (count == 1) {
    contact.arm = spheres_[candidate[0]].centre;
    return contact;
  }
  double reach[kMostSpheres];
  double furthest = -HUGE_VAL;
  double second = -HUGE_VAL;
  int best = 0;
  for (int k = 0; k < count; ++k) {
    const shape::Sphere& sphere = spheres_[candidate[k]];
    reach[k] = sphere.centre.dot(d) + sphere.radius;
    second = std::max(second, std::min(reach[k], furthest));
    best = reach[k] > furthest ? k : best;
    furthest = std::max(furthest, reach[k]);
  }
  const double level = furthest - std::min(depth, kDeepest);
  if (second <= level) {
    contact.arm = spheres_[candidate[best]].centre;
    return contact;
  }
  contact.several = true;
  contact.arm.setZero();
  double sum = 0;
  double xx = 0;
  double xy = 0;
  double xz = 0;
  double yy = 0;
  double yz = 0;
  double zz = 0;
  for (int k = 0; k < count; ++k) {
    const double share = reach[k] - level;
    if (share <= 0.0)
      continue;
    const Eigen::Vector3d& c = spheres_[candidate[k]].centre;
    const Eigen::Vector3d part = share * c;
    sum += share;
    contact.arm += part;
    xx += part[0] * c[0];
    xy += part[0] * c[1];
    xz += part[0] * c[2];
    yy += part[1] * c[1];
    yz += part[1] * c[2];
    zz += part[2] * c[2];
  }
  const double scale = 1.0 / sum;
  contact.arm *= scale;
  contact.spread << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  contact.spread *= scale;
  return contact;
}

} // namespace eccentra::rolling
