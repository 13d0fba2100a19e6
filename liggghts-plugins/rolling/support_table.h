// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which sub-spheres of a shape a contact in a given direction can touch, found without looking at all of them. Pure.
#pragma once

#include "shape/cluster_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace eccentra::rolling {

/// What the sub-spheres that carry a contact do, in units of R_eq: multiply `arm` by R, `spread` by R^2.
struct CarriedContact {
  Eigen::Vector3d arm;    ///< r_c of eq (32): mean of the centres, weighted by their share of the force
  Eigen::Matrix3d spread; ///< mean of c c^T, weighted alike
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

  static constexpr double kDeepest = 0.01;

 private:
  static constexpr int kCellsPerEdge = 32; ///< of each face of the cube that directions are sorted into

  static int cell_of(const Eigen::Vector3d& d);
  static Eigen::Vector3d centre_of(int cell, double& half_angle);
  void keep_corners();
  void fill_cells();

  static constexpr int kLanes = 8;
  static constexpr int kFewCorners = 4 * kLanes;
  using Lanes = Eigen::Array<double, kLanes, 1>;
  /// Eight sub-spheres side by side; the last block of a list is filled up with ones that reach nowhere.
  struct Block {
    Lanes x, y, z, r;
    Lanes reach(const Eigen::Vector3d& d) const { return x * d[0] + y * d[1] + z * d[2] + r; }
  };
  static void append_blocks(const std::vector<shape::Sphere>& spheres, std::vector<Block>& blocks);

  std::vector<shape::Sphere> spheres_; ///< corners
  std::vector<Block> blocks_;          ///< all corners, if they are few
  std::vector<int> first_;             ///< per cell: its first block; one more entry at the end
  std::vector<Block> cell_blocks_;
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
  // Few corners: all of them, without a branch. Many: those that the cell of the direction lists.
  const bool few = !blocks_.empty();
  const int cell = few ? 0 : cell_of(d);
  const Block* const begin = few ? blocks_.data() : cell_blocks_.data() + first_[cell];
  const Block* const end = few ? begin + blocks_.size() : cell_blocks_.data() + first_[cell + 1];
  Lanes furthest = begin->reach(d);
  for (const Block* block = begin + 1; block < end; ++block)
    furthest = furthest.max(block->reach(d));
  // At no depth the furthest sub-sphere carries all.
  constexpr double shallowest = 1e-9;
  const double level = furthest.maxCoeff() - std::clamp(depth, shallowest, kDeepest);
  Lanes share = (begin->reach(d) - level).max(0.0);
  Lanes sum = share;
  Lanes sx = share * begin->x;
  Lanes sy = share * begin->y;
  Lanes sz = share * begin->z;
  Lanes xx = sx * begin->x;
  Lanes xy = sx * begin->y;
  Lanes xz = sx * begin->z;
  Lanes yy = sy * begin->y;
  Lanes yz = sy * begin->z;
  Lanes zz = sz * begin->z;
  for (const Block* block = begin + 1; block < end; ++block) {
    share = (block->reach(d) - level).max(0.0);
    const Lanes bx = share * block->x;
    const Lanes by = share * block->y;
    const Lanes bz = share * block->z;
    sum += share;
    sx += bx;
    sy += by;
    sz += bz;
    xx += bx * block->x;
    xy += bx * block->y;
    xz += bx * block->z;
    yy += by * block->y;
    yz += by * block->z;
    zz += bz * block->z;
  }
  const double scale = 1.0 / sum.sum();
  CarriedContact contact;
  contact.arm = scale * Eigen::Vector3d(sx.sum(), sy.sum(), sz.sum());
  const double cross[3] = {scale * xy.sum(), scale * xz.sum(), scale * yz.sum()};
  contact.spread << scale * xx.sum(), cross[0], cross[1], cross[0], scale * yy.sum(), cross[2], cross[1], cross[2],
      scale * zz.sum();
  return contact;
}

} // namespace eccentra::rolling
