// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sorts directions into the cells of a cube and finds, per cell, every sub-sphere that may carry a contact there.
#include "contact/support_table.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace eccentra::contact {

SupportTable::SupportTable(const shape::ClusterShape& shape) {
  const double unit = 1.0 / shape.equivalent_radius();
  for (const int k : shape.surface_spheres()) {
    const shape::Sphere& sphere = shape.spheres()[k];
    corners_.push_back({sphere.centre * unit, sphere.radius * unit});
  }
  keep_corners();
  for (const shape::Sphere& corner : corners_)
    longest_arm_ = std::max(longest_arm_, corner.centre.norm());
  if (few())
    append_blocks(corners_, few_corners_);
  else
    fill_cells();
}

Eigen::Vector3d SupportTable::moment(const Eigen::Vector3d& d, double depth, const ContactLoad& load) const {
  if (!few_corners_.empty())
    return carried_moment(few_corners_.data(), few_corners_.data() + few_corners_.size(), d, depth, load);
  const int cell = cell_of(d);
  return carried_moment(cell_blocks_.data() + first_[cell], cell_blocks_.data() + first_[cell + 1], d, depth, load);
}

int SupportTable::cell_of(const Eigen::Vector3d& d) {
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

void SupportTable::append_blocks(const std::vector<shape::Sphere>& spheres, std::vector<SphereBlock>& blocks) {
  using Lanes = SphereBlock::Lanes;
  constexpr double nowhere = -1e3; // radius of a place that is not taken
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const int lane = static_cast<int>(k % SphereBlock::kLanes);
    if (lane == 0)
      blocks.push_back({Lanes::Zero(), Lanes::Zero(), Lanes::Zero(), Lanes::Constant(nowhere)});
    SphereBlock& block = blocks.back();
    block.x[lane] = spheres[k].centre[0];
    block.y[lane] = spheres[k].centre[1];
    block.z[lane] = spheres[k].centre[2];
    block.r[lane] = spheres[k].radius;
  }
}

void SupportTable::keep_corners() {
  constexpr double tie = 1e-6; // of R_eq
  std::vector<char> corner(corners_.size(), corners_.size() == 1);
  for (int cell = 0; cell < 6 * kCellsPerEdge * kCellsPerEdge; ++cell) {
    double half_angle = 0;
    const Eigen::Vector3d d = centre_of(cell, half_angle);
    double first = -HUGE_VAL;
    double second = -HUGE_VAL;
    std::size_t best = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const double here = corners_[k].centre.dot(d) + corners_[k].radius;
      second = std::max(second, std::min(here, first));
      best = here > first ? k : best;
      first = std::max(first, here);
    }
    if (first > second + tie)
      corner[best] = true;
  }
  std::vector<shape::Sphere> kept;
  for (std::size_t k = 0; k < corners_.size(); ++k)
    if (corner[k])
      kept.push_back(corners_[k]);
  if (!kept.empty()) // else all tie everywhere: one sphere, given several times
    corners_ = kept;
}

Eigen::Vector3d SupportTable::centre_of(int cell, double& half_angle) {
  const int face = cell / (kCellsPerEdge * kCellsPerEdge);
  const int row = cell / kCellsPerEdge % kCellsPerEdge;
  const int column = cell % kCellsPerEdge;
  const int axis = face / 2;
  const int next = axis == 2 ? 0 : axis + 1;
  const int last = axis == 0 ? 2 : axis - 1;
  const auto point = [&](double u, double v) {
    Eigen::Vector3d p;
    p[axis] = face % 2 ? -1.0 : 1.0;
    p[next] = 2.0 * u / kCellsPerEdge - 1.0;
    p[last] = 2.0 * v / kCellsPerEdge - 1.0;
    return p.normalized().eval();
  };
  Eigen::Vector3d centre = point(row + 0.5, column + 0.5);
  half_angle = 0;
  for (const int u : {0, 1})
    for (const int v : {0, 1})
      half_angle = std::max(half_angle, std::acos(std::min(1.0, centre.dot(point(row + u, column + v)))));
  return centre;
}

void SupportTable::fill_cells() {
  const int cells = 6 * kCellsPerEdge * kCellsPerEdge;
  first_.reserve(cells + 1);
  for (int cell = 0; cell < cells; ++cell) {
    first_.push_back(static_cast<int>(cell_blocks_.size()));
    std::vector<shape::Sphere> candidates;
    double half_angle = 0;
    const Eigen::Vector3d d = centre_of(cell, half_angle);
    // k carries nothing in this cell if some m reaches further by kDeepestShare wherever in the cell.
    const auto hidden_by = [&](const shape::Sphere& k, const shape::Sphere& m) {
      const Eigen::Vector3d apart = k.centre - m.centre;
      const double distance = apart.norm();
      const double angle = distance > 0.0 ? std::acos(std::clamp(apart.dot(d) / distance, -1.0, 1.0)) : 0.0;
      return distance * std::cos(std::max(0.0, angle - half_angle)) + k.radius - m.radius < -kDeepestShare;
    };
    const double reached = reach(d);
    std::vector<const shape::Sphere*> near; // these carry in the middle of the cell already
    for (const shape::Sphere& sphere : corners_)
      if (reached - sphere.centre.dot(d) - sphere.radius < kDeepestShare)
        near.push_back(&sphere);
    // Over the cell a sphere's reach changes by no more than its distance from the centre times the angle.
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const double gap = reached - corners_[k].centre.dot(d) - corners_[k].radius;
      const bool far = gap > kDeepestShare + half_angle * (corners_[k].centre.norm() + near.front()->centre.norm());
      if (gap < kDeepestShare || (!far && std::none_of(near.begin(), near.end(), [&](const shape::Sphere* m) {
            return hidden_by(corners_[k], *m);
          })))
        candidates.push_back(corners_[k]);
    }
    append_blocks(candidates, cell_blocks_);
  }
  first_.push_back(static_cast<int>(cell_blocks_.size()));
}

double SupportTable::reach(const Eigen::Vector3d& d) const {
  double reach = -HUGE_VAL;
  for (const shape::Sphere& sphere : corners_)
    reach = std::max(reach, sphere.centre.dot(d) + sphere.radius);
  return reach;
}

} // namespace eccentra::contact
