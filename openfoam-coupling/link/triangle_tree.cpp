// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of bounding boxes.
#include "link/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace eccentra::link {
namespace {

using Eigen::Vector3d;

constexpr int kLeaf = 8;

/// Weights of the corners at the point of a triangle that is nearest to x (Ericson, Real-Time Collision
/// Detection, 5.1.5).
Vector3d nearest_weights(const TriangleTree::Triangle& t, const Vector3d& x) {
  const Vector3d ab = t[1] - t[0], ac = t[2] - t[0];
  const auto at = [&](const Vector3d& from) { return std::pair(ab.dot(x - from), ac.dot(x - from)); };
  const auto [d1, d2] = at(t[0]);
  if (d1 <= 0 && d2 <= 0)
    return {1, 0, 0};
  const auto [d3, d4] = at(t[1]);
  if (d3 >= 0 && d4 <= d3)
    return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const auto [d5, d6] = at(t[2]);
  if (d6 >= 0 && d5 <= d6)
    return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4, along = d4 - d3, back = d5 - d6;
  if (va <= 0 && along >= 0 && back >= 0 && along + back > 0) {
    const double w = along / (along + back);
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  // A triangle without area: one of its corners is near enough.
  return sum != 0 ? Vector3d(va / sum, vb / sum, vc / sum) : Vector3d(1, 0, 0);
}

double distance_to_box(const Vector3d& x, const Vector3d& low, const Vector3d& high) {
  return (x - x.cwiseMax(low).cwiseMin(high)).norm();
}

} // namespace

TriangleTree::TriangleTree(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!triangles_.empty())
    build(0, static_cast<int>(order_.size()));
}

int TriangleTree::build(int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  Node node{Vector3d::Constant(std::numeric_limits<double>::max()), {}, begin, end, -1, -1};
  node.high = -node.low;
  for (int i = begin; i < end; ++i)
    for (const Vector3d& x : triangles_[order_[i]]) {
      node.low = node.low.cwiseMin(x);
      node.high = node.high.cwiseMax(x);
    }
  nodes_.push_back(node);
  if (end - begin <= kLeaf)
    return index;
  int widest = 0;
  (node.high - node.low).maxCoeff(&widest);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    const Triangle &s = triangles_[a], &t = triangles_[b];
    return s[0][widest] + s[1][widest] + s[2][widest] < t[0][widest] + t[1][widest] + t[2][widest];
  });
  const int left = build(begin, middle), right = build(middle, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

TriangleTree::Nearest TriangleTree::nearest(const Vector3d& x) const {
  Nearest best;
  best.distance = std::numeric_limits<double>::max();
  if (nodes_.empty())
    return best;
  std::vector<int> open{0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (distance_to_box(x, node.low, node.high) >= best.distance)
      continue;
    if (node.left < 0) {
      for (int i = node.begin; i < node.end; ++i) {
        const Triangle& t = triangles_[order_[i]];
        const Vector3d weights = nearest_weights(t, x);
        const double distance = (weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2] - x).norm();
        if (distance < best.distance)
          best = {order_[i], distance, weights};
      }
      continue;
    }
    int first = node.left, second = node.right;
    if (distance_to_box(x, nodes_[first].low, nodes_[first].high) >
        distance_to_box(x, nodes_[second].low, nodes_[second].high))
      std::swap(first, second);
    open.push_back(second);
    open.push_back(first);
  }
  return best;
}

} // namespace eccentra::link
