// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces to and from VTK.
#pragma once

#include "shape/surface.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace eccentra::shape {

vtkSmartPointer<vtkPolyData> poly_data(const Surface& surface);

/// The triangles of `data`; other cells are left out.
Surface surface_of(vtkPolyData* data);

} // namespace eccentra::shape
