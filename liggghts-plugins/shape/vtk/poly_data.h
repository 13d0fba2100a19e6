// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces to and from VTK.
#pragma once

#include "shape/surface.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace eccentra::shape {

/// The same vertices and triangles.
vtkSmartPointer<vtkPolyData> poly_data(const Surface& surface);

/// Maps the bounding box to size 1 about the origin, because VTK's locators have absolute tolerances that are too large
/// for bodies of millimetres.
struct UnitFrame {
  /// The frame of `surface`.
  explicit UnitFrame(const Surface& surface);
  Eigen::Vector3d middle; ///< of the bounding box
  double size;            ///< diagonal of the bounding box
  /// A point in the unit frame.
  Eigen::Vector3d to_unit(const Eigen::Vector3d& point) const { return (point - middle) / size; }
  /// A surface in the unit frame.
  Surface to_unit(const Surface& surface) const;
};

/// The triangles of `data`; other cells are ignored.
Surface surface_of(vtkPolyData* data);

} // namespace eccentra::shape
