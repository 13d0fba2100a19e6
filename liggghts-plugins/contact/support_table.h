// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the sub-spheres of a shape that a contact in a given direction can touch. Pure functions.
#pragma once

#include "contact/lane_sums.h"
#include "shape/cluster_shape.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace eccentra::contact {

/// Eight sub-spheres in structure-of-arrays form, in units of the particle's radius; unused places never touch.
struct SphereBlock {
  /// A value of each sub-sphere.
  using Lanes = EightLanes;
  static constexpr int kLanes = Lanes::SizeAtCompileTime;
  Lanes x, y, z, r; ///< centres and radii
  /// Distance that each reaches in direction d, c . d + r.
  Lanes along(const Eigen::Vector3d& d) const { return x * d[0] + y * d[1] + z * d[2]; }
  /// The same with the radius.
  Lanes reach(const Eigen::Vector3d& d) const { return along(d) + r; }
};

/// Normal force on one side of a contact: each sub-sphere at c presses with its share of push - drag (c . across).
struct ContactLoad {
  double push;            ///< F_n [N]
  double drag;            ///< gamma_n R of the dashpot [N s]; 0: rocking is not damped
  Eigen::Vector3d across; ///< n x omega, n the direction of the force: c . across is a normal velocity over R [1/s]
};

/// Depths outside these bounds, in units of the radius, count as the bound. With depth 0 the furthest sub-sphere
/// carries the whole force.
constexpr double kShallowestShare = 1e-9;
constexpr double kDeepestShare = 0.01;

/// Sum over the sub-spheres that carry a contact of c times its part of the load, in units of R: without drag F_n r_c /
/// R of eq (32). A flat partner in unit direction d (from the centre towards the partner; same frame as the blocks)
/// overlaps the furthest sub-sphere by `depth`, in units of R; those that it overlaps, too, share the force in
/// proportion to their overlap. A cube on its face therefore stands on all corners of the face.
inline Eigen::Vector3d carried_moment(const SphereBlock* begin, const SphereBlock* end, const Eigen::Vector3d& d,
                                      double depth, const ContactLoad& load) {
  using Lanes = SphereBlock::Lanes;
  Lanes furthest = begin->reach(d);
  for (const SphereBlock* block = begin + 1; block < end; ++block)
    furthest = furthest.max(block->reach(d));
  const double level = largest_lane(furthest) - std::clamp(depth, kShallowestShare, kDeepestShare);
  Lanes sum = Lanes::Zero();
  Lanes x = Lanes::Zero();
  Lanes y = Lanes::Zero();
  Lanes z = Lanes::Zero();
  for (const SphereBlock* block = begin; block < end; ++block) {
    const Lanes share = (block->reach(d) - level).max(0.0);
    const Lanes force = share * (load.push - load.drag * block->along(load.across));
    sum += share;
    x += force * block->x;
    y += force * block->y;
    z += force * block->z;
  }
  const Eigen::Vector4d sums = lane_sums(x, y, z, sum);
  return sums.head<3>() * (1.0 / sums[3]);
}

/// Built once per shape, in units of its equivalent radius R_eq; directions in the body frame. Contains
/// only the sub-spheres that are furthest in some direction, the corners of the convex hull of the shape. Sub-spheres
/// between others on a flat face or a straight edge are never the furthest.
class SupportTable {
 public:
  /// Reads the surface sub-spheres of `shape`.
  explicit SupportTable(const shape::ClusterShape& shape);

  /// The sub-spheres of the table, in units of R_eq, body frame.
  const std::vector<shape::Sphere>& corners() const { return corners_; }
  /// Longest distance of a corner's centre from that of the shape, in units of R_eq.
  double longest_arm() const { return longest_arm_; }
  /// Number of corners up to which a test of each is faster than the table.
  bool few() const { return corners_.size() <= static_cast<std::size_t>(kFewCorners); }
  /// carried_moment of this shape.
  Eigen::Vector3d moment(const Eigen::Vector3d& d, double depth, const ContactLoad& load) const;
  /// r_c of eq (32) in units of R_eq: the mean of the centres of the carrying sub-spheres, weighted by their shares.
  Eigen::Vector3d arm(const Eigen::Vector3d& d, double depth) const {
    return moment(d, depth, {1.0, 0.0, Eigen::Vector3d::Zero()});
  }
  /// Distance that the shape reaches in direction d, max(c . d + r), in units of R_eq.
  double reach(const Eigen::Vector3d& d) const;

  static constexpr int kFewCorners = 4 * SphereBlock::kLanes;

 private:
  static constexpr int kCellsPerEdge = 32; ///< of each face of the cube that directions are sorted into

  static int cell_of(const Eigen::Vector3d& d);
  static Eigen::Vector3d centre_of(int cell, double& half_angle);
  void keep_corners();
  void fill_cells();
  static void append_blocks(const std::vector<shape::Sphere>& spheres, std::vector<SphereBlock>& blocks);

  std::vector<shape::Sphere> corners_;
  double longest_arm_ = 0;
  std::vector<SphereBlock> few_corners_;
  std::vector<int> first_; ///< per cell: its first block; one more entry at the end
  std::vector<SphereBlock> cell_blocks_;
};

/// carried_moment of a shape turned by `orientation` (body to world); all vectors in the world frame.
inline Eigen::Vector3d turned_moment(const SupportTable& shape, const Eigen::Quaterniond& orientation,
                                     const Eigen::Vector3d& d, double depth, const ContactLoad& load) {
  const Eigen::Matrix3d to_world = orientation.toRotationMatrix();
  const Eigen::Matrix3d to_body = to_world.transpose();
  return to_world * shape.moment(to_body * d, depth, {load.push, load.drag, to_body * load.across});
}

} // namespace eccentra::contact
