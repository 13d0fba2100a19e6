// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What pictures of bodies in a flow are put together from.
#pragma once

#include "report/case_data.h"

#include <vtkActor.h>
#include <vtkAlgorithmOutput.h>
#include <vtkColorTransferFunction.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>

#include <functional>
#include <string>
#include <vector>

namespace eccentra::report {

constexpr int kTextSize = 22;         ///< of pictures, in pixels
constexpr double kLegendPixels = 130; ///< height of the scales of colour under a picture
constexpr double kTitlePixels = 70;   ///< height of the names above it

/// Scales of colour from 0 to the fastest body and to the fastest fluid [m/s]. Bodies at rest have tones of sand, which
/// tell neighbours apart and mean nothing.
struct Colours {
  vtkSmartPointer<vtkColorTransferFunction> bodies;
  vtkSmartPointer<vtkColorTransferFunction> fluid;
  bool at_rest = false;
};

/// Both speeds are rounded up to a number whose quarters are short; each must be above 0.
Colours make_colours(double fastest_body, double fastest_fluid);

/// Of bodies at rest.
Colours colours_at_rest(double fastest_fluid);

/// Adds the point data `speed`, from the velocities of the points (0 without them).
vtkSmartPointer<vtkPolyData> with_speed(vtkPolyData* points);

/// Value below which 98 % lie: one body that has just bounced does not set the scale for all. 0 without values.
double nearly_largest(std::vector<double> values);

/// By position, which bodies are drawn.
using Keep = std::function<bool(const Vector&)>;

/// The surfaces of the bodies of a file with `speed` (with_speed).
void add_bodies(vtkRenderer& renderer, vtkPolyData& bodies, const Colours& colours, const Keep& keep);

/// The speed of the fluid on a plane.
vtkSmartPointer<vtkActor> flow_slice(vtkUnstructuredGrid& flow, const Colours& colours, const Vector& origin,
                                     const Vector& normal);

/// Geometry in one grey, 0 (black) to 1.
vtkSmartPointer<vtkActor> plain_actor(vtkAlgorithmOutput* geometry, double grey);

void add_line(vtkRenderer& renderer, const Vector& a, const Vector& b);

/// Parallel projection from `centre` + `from`; `half_height` [m] of the world above and below the centre.
void look(vtkRenderer& renderer, const Vector& centre, const Vector& from, const Vector& up, double half_height);

/// Text about a place in the viewport (0 to 1).
void add_text(vtkRenderer& renderer, const std::string& text, int size, double x, double y);

/// A horizontal scale of colour from x on; both numbers are parts of the viewport's width.
void add_bar(vtkRenderer& renderer, vtkColorTransferFunction* colours, const char* title, double x,
             double width = 0.36);

} // namespace eccentra::report
