// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces to and from VTK.
#pragma once

#include "shape/surface.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace eccentra::shape {

vtkSmartPointer<vtkPolyData> poly_data(const Surface& surface);

/// Maps the bounding box to size 1 about the origin, because VTK's locators have absolute tolerances that are too large
/// for bodies of millimetres.
struct UnitFrame {
  explicit UnitFrame(const Surface& surface);
  Eigen::Vector3d middle;
  double size; ///< diagonal of the bounding box
  Eigen::Vector3d to_unit(const Eigen::Vector3d& point) const { return (point - middle) / size; }
  Surface to_unit(const Surface& surface) const;
};

/// The triangles of `data`; other cells are ignored.
Surface surface_of(vtkPolyData* data);

} // namespace eccentra::shape
