// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The triangle of a surface that is nearest to a point.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace eccentra::link {

/// Finds the triangle nearest to a point, through a tree of boxes.
class TriangleTree {
 public:
  /// Its corners [m].
  using Triangle = std::array<Eigen::Vector3d, 3>;
  /// Copies the triangles.
  explicit TriangleTree(std::vector<Triangle> triangles);

  /// Result of a search.
  struct Nearest {
    int triangle = -1;       ///< -1: there is none
    double distance = 0;     ///< [m]
    Eigen::Vector3d weights; ///< of its corners at the nearest point
  };
  /// The nearest triangle.
  Nearest nearest(const Eigen::Vector3d& x) const;

 private:
  struct Node {
    Eigen::Vector3d low, high;
    int begin, end;  ///< triangles in order_
    int left, right; ///< nodes; -1: a leaf
  };
  int build(int begin, int end);
  std::vector<Triangle> triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

} // namespace eccentra::link
