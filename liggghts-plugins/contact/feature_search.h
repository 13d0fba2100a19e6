// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the features of two near bodies that can touch soon.
#pragma once

#include "contact/manifold.h"

#include <vector>

namespace eccentra::contact {

/// Finds the features of A and B that touch, or may do so once the bodies have moved by `skin` [m] relative to each
/// other, as feature_id in ascending order. Returns the relative motion [m] up to which no other features can touch.
class FeatureSearch {
 public:
  /// The search; the features replace those of the search before.
  double search(const BodyPair& pair, double skin);
  /// Features of the last search.
  const std::vector<int>& found() const { return found_; }

 private:
  void find_points(const BodyPair& pair, bool of_b, double skin, const double* depth, double budget);
  void find_edges(const BodyPair& pair, double limit, double skin, double budget);
  void measure_edges(const Eigen::Vector3d& a, const Eigen::Vector3d& u, int count);
  void find_rims(const BodyPair& pair, bool of_b, double limit);
  /// Edges of B that may be near an edge of A, for a loop over vectors: a point, the way along and its square, the
  /// depth behind the support plane.
  enum EdgeRow { fx, fy, fz, ux, uy, uz, square, behind, apart, edge_rows };
  LaneRows<edge_rows> edges_;
  std::vector<int> edge_of_;

  std::vector<int> found_;
  RimLanes rims_;                         ///< points of the rim at hand
  std::vector<double> depth_a_, depth_b_; ///< of points behind the support plane [m]
};

} // namespace eccentra::contact
