// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Separating axes of two cores.
#pragma once

#include "contact/contact_core.h"

namespace eccentra::contact {

/// The cores are `separation` [m] apart along `normal`, which points from B to A. A negative value is the distance by
/// which A must move along the normal until the cores do not overlap.
struct SeparatingAxis {
  double separation;      ///< [m]
  Eigen::Vector3d normal; ///< unit, from B to A
};

/// Separation along a unit vector from B to A; `offset` leads from A's centre to B's.
double separation_along(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset,
                        const Eigen::Vector3d& normal);

/// The axes of two boxes, by the cosines between their edges.
class BoxesApart {
 public:
  /// Asks the axes of all faces; the bodies must outlive this.
  BoxesApart(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset);
  /// Asks those across pairs of edges, too.
  void ask_edges();
  /// Greatest separation of the axes asked [m].
  double separation() const { return separation_; }
  /// Its axis: unit, from B to A.
  Eigen::Vector3d normal() const;

 private:
  const PosedCore &a_, &b_;
  Eigen::Vector3d to_b_, to_b_in_b_; ///< from A's centre to B's, in the frames of A and of B [m]
  double cosine_[3][3], size_[3][3]; ///< between edges of A and of B, and their sizes
  double separation_;
  int axis_ = 0; ///< 0 to 2: faces of A; 3 to 5: of B; then pairs of edges
};

/// The axis of greatest separation among the faces' normals (of disks: their axes, and the directions from their axes
/// to the other's centre). The cores' distance is at least the separation.
SeparatingAxis best_face_axis(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset);

/// The same, also with the directions across one edge of each core: the exact separation of polyhedra that overlap.
SeparatingAxis least_axis(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset);

} // namespace eccentra::contact
