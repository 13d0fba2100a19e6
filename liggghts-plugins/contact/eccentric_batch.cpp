// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// carried_moment for eight sides at a time: a lane is a side, and the loop goes over the corners of the shape.
#include "contact/eccentric_batch.h"

#include <Eigen/Geometry>

namespace eccentra::contact {
namespace {

using Lanes = EightLanes;
using LaneVector = std::array<Lanes, 3>;

template <class Row> Lanes load(const Row& row, int first) {
  return Eigen::Map<const Lanes, Eigen::Aligned>(row.data() + first);
}

template <class Rows> LaneVector load3(const Rows& rows, int first) {
  return {load(rows[0], first), load(rows[1], first), load(rows[2], first)};
}

/// Rotation matrices, row by row, of unit quaternions.
struct LaneRotation {
  LaneVector row[3];

  template <class Rows> LaneRotation(const Rows& q, int first) {
    const Lanes w = load(q[0], first);
    const Lanes x = load(q[1], first);
    const Lanes y = load(q[2], first);
    const Lanes z = load(q[3], first);
    const Lanes x2 = x + x;
    const Lanes y2 = y + y;
    const Lanes z2 = z + z;
    row[0] = {1.0 - (y2 * y + z2 * z), x2 * y - z2 * w, x2 * z + y2 * w};
    row[1] = {x2 * y + z2 * w, 1.0 - (x2 * x + z2 * z), y2 * z - x2 * w};
    row[2] = {x2 * z - y2 * w, y2 * z + x2 * w, 1.0 - (x2 * x + y2 * y)};
  }
  LaneVector to_body(const LaneVector& v) const {
    LaneVector body;
    for (int k = 0; k < 3; ++k)
      body[k] = row[0][k] * v[0] + row[1][k] * v[1] + row[2][k] * v[2];
    return body;
  }
  LaneVector to_world(const LaneVector& v) const {
    LaneVector world;
    for (int k = 0; k < 3; ++k)
      world[k] = row[k][0] * v[0] + row[k][1] * v[1] + row[k][2] * v[2];
    return world;
  }
};

LaneVector cross(const LaneVector& a, const LaneVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace

void EccentricBatch::fill_torques(const SupportTable& shape) {
  if (!shape.few()) {
    fill_by_cell(shape);
    return;
  }
  const std::vector<shape::Sphere>& corners = shape.corners();
  for (int first = 0; first < size_; first += SphereBlock::kLanes) {
    const LaneRotation rotation(orientation_, first);
    const LaneVector n = load3(outward_, first);
    const LaneVector d = rotation.to_body(n); // of the force, from the partner: against carried_moment's d
    const LaneVector across = rotation.to_body(cross(n, load3(spin_, first)));
    std::array<Lanes, SupportTable::kFewCorners> reach;
    Lanes level = Lanes::Constant(-HUGE_VAL);
    int k = 0;
    for (const shape::Sphere& corner : corners) {
      const Eigen::Vector3d& c = corner.centre;
      reach[k] = corner.radius - (c[0] * d[0] + c[1] * d[1] + c[2] * d[2]);
      level = level.max(reach[k]);
      ++k;
    }
    level -= load(depth_, first).max(kShallowestShare).min(kDeepestShare);
    const Lanes push = load(push_, first);
    const Lanes drag = load(drag_, first);
    Lanes sum = Lanes::Zero();
    LaneVector moment = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    k = 0;
    for (const shape::Sphere& corner : corners) {
      const Eigen::Vector3d& c = corner.centre;
      const Lanes share = (reach[k] - level).max(0.0);
      const Lanes force = share * (push - drag * (c[0] * across[0] + c[1] * across[1] + c[2] * across[2]));
      sum += share;
      moment[0] += force * c[0];
      moment[1] += force * c[1];
      moment[2] += force * c[2];
      ++k;
    }
    const LaneVector torque = cross(rotation.to_world(moment), n);
    const Lanes scale = load(radius_, first) / sum;
    for (int axis = 0; axis < 3; ++axis)
      Eigen::Map<Lanes, Eigen::Aligned>(torque_[axis].data() + first) = torque[axis] * scale;
  }
}

void EccentricBatch::fill_by_cell(const SupportTable& shape) {
  for (int m = 0; m < size_; ++m) {
    const Eigen::Quaterniond q(orientation_[0][m], orientation_[1][m], orientation_[2][m], orientation_[3][m]);
    const Eigen::Vector3d n(outward_[0][m], outward_[1][m], outward_[2][m]);
    const Eigen::Vector3d spin(spin_[0][m], spin_[1][m], spin_[2][m]);
    const Eigen::Vector3d torque =
        radius_[m] * turned_moment(shape, q, -n, depth_[m], {push_[m], drag_[m], n.cross(spin)}).cross(n);
    for (int axis = 0; axis < 3; ++axis)
      torque_[axis][m] = torque[axis];
  }
}

} // namespace eccentra::contact
