// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A closed triangulated solid from an STL file: its exact mass properties and the distance to its surface.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/note.h"
#include "shape/surface.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace eccentra::shape {

/// The closed surface of one solid, as an STL file holds it. Frame of the file, metres.
class Solid {
 public:
  /// Reads an ASCII or binary STL file and multiplies its lengths by `scale`. What can be repaired in one way only
  /// (repeated and degenerate facets, facets that face the wrong way, corners that differ by round-off) is repaired and
  /// listed in notes(). Throws std::invalid_argument with one sentence that names the defect if the surface is not that
  /// of one solid: open, several solids, crossing itself, without volume, and so on.
  Solid(const std::string& path, double scale);

  /// Of the file.
  const std::string& path() const { return path_; }
  /// Repairs and other remarks for the user; one sentence each.
  const Notes& notes() const { return notes_; }
  /// Of the solid, in the frame of the file, exact for its triangles.
  const MassProperties& properties() const { return properties_; }
  /// Corners [m].
  const std::vector<Eigen::Vector3d>& vertices() const { return surface_.vertices; }
  /// Counter-clockwise from outside.
  const std::vector<std::array<int, 3>>& triangles() const { return surface_.triangles; }
  Eigen::Vector3d low() const { return low_; }   ///< corner of the bounding box
  Eigen::Vector3d high() const { return high_; } ///< the opposite corner

  /// Distance to the surface [m], negative inside.
  double distance(const Eigen::Vector3d& point) const;
  /// True inside, by winding numbers; slower than the sign of distance() and independent of it.
  bool holds(const Eigen::Vector3d& point) const;

 private:
  struct DistanceField;
  void repair(const Surface& raw);
  void require_one_solid(const std::vector<Shell>& shells);

  std::string path_, where_;
  Notes notes_;
  Surface surface_;
  std::vector<int> all_triangles_;
  MassProperties properties_;
  Eigen::Vector3d low_, high_;
  std::shared_ptr<DistanceField> field_;
};

} // namespace eccentra::shape
