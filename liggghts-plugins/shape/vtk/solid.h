// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A closed triangulated solid from an STL file: its exact mass properties and the distance to its surface.
#pragma once

#include "shape/cluster_shape.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace eccentra::shape {

class Solid {
 public:
  /// Reads an ASCII or binary STL file and multiplies its lengths by `scale`. Throws std::invalid_argument with one
  /// sentence where the file cannot be read, holds no triangles, is not closed or encloses no volume.
  Solid(const std::string& path, double scale);

  const std::string& path() const { return path_; }
  /// Of the solid, in the frame of the file, exact for its triangles.
  const MassProperties& properties() const { return properties_; }
  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  Eigen::Vector3d low() const { return low_; }   ///< corner of the bounding box
  Eigen::Vector3d high() const { return high_; } ///< the opposite corner

  /// Distance to the surface [m], negative inside.
  double distance(const Eigen::Vector3d& point) const;

 private:
  struct DistanceField;
  std::string path_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  MassProperties properties_;
  Eigen::Vector3d low_, high_;
  std::shared_ptr<DistanceField> field_;
};

} // namespace eccentra::shape
