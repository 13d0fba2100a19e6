// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements picture_parts.h with VTK.
#include "report/picture_parts.h"

#include "report/body_surfaces.h"

#include <vtkArrayCalculator.h>
#include <vtkCamera.h>
#include <vtkCutter.h>
#include <vtkDataSetMapper.h>
#include <vtkDoubleArray.h>
#include <vtkLineSource.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace eccentra::report {
namespace {

constexpr std::size_t kMostTriangles = 2000000; // of the bodies of one picture

using Stop = std::array<double, 3>;

constexpr std::array<Stop, 4> kBlues = {
    {{0.95, 0.97, 1.0}, {0.72, 0.83, 0.93}, {0.42, 0.65, 0.83}, {0.13, 0.40, 0.66}}};

/// Even steps through colours of rising lightness; readable in grey, too.
template <std::size_t n>
vtkSmartPointer<vtkColorTransferFunction> scale(const std::array<Stop, n>& stops, double highest) {
  const auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (std::size_t i = 0; i < n; ++i)
    function->AddRGBPoint(highest * static_cast<double>(i) / static_cast<double>(n - 1), stops[i][0], stops[i][1],
                          stops[i][2]);
  return function;
}

/// The next larger number whose quarters are short: the scale has five labels.
double round_up(double value) {
  constexpr std::array<double, 10> steps = {0.1, 0.12, 0.16, 0.2, 0.24, 0.32, 0.4, 0.6, 0.8, 1.0};
  const double decade = std::pow(10.0, std::ceil(std::log10(value)));
  return decade * *std::find_if(steps.begin(), steps.end() - 1, [&](double s) { return s * decade >= value; });
}

void shade(vtkProperty& property) {
  property.SetSpecular(0.25);
  property.SetSpecularPower(20);
  property.SetAmbient(0.25);
  property.SetDiffuse(0.8);
}

/// A number from 0 to 1 for each point, the same for all of a body and another one for its neighbours: parts of the
/// golden ratio.
vtkSmartPointer<vtkDoubleArray> tones(vtkPolyData& surface) {
  constexpr double golden = 0.6180339887498949;
  vtkDataArray* tags = surface.GetPointData()->GetArray("body");
  if (tags == nullptr)
    tags = surface.GetPointData()->GetArray("id");
  const auto tone = vtkSmartPointer<vtkDoubleArray>::New();
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i)
    tone->InsertNextValue(tags == nullptr ? 0.5 : std::fmod(golden * tags->GetTuple1(i), 1.0));
  return tone;
}

} // namespace

Colours make_colours(double fastest_body, double fastest_fluid) {
  constexpr std::array<Stop, 5> plasma = {
      {{0.24, 0.06, 0.46}, {0.55, 0.09, 0.60}, {0.83, 0.28, 0.46}, {0.97, 0.55, 0.29}, {0.97, 0.90, 0.28}}};
  return {scale(plasma, round_up(fastest_body)), scale(kBlues, round_up(fastest_fluid))};
}

Colours colours_at_rest(double fastest_fluid) {
  constexpr std::array<Stop, 3> sand = {{{0.62, 0.47, 0.31}, {0.80, 0.65, 0.44}, {0.93, 0.82, 0.62}}};
  return {scale(sand, 1), scale(kBlues, round_up(fastest_fluid)), true};
}

vtkSmartPointer<vtkPolyData> with_speed(vtkPolyData* points) {
  vtkDataArray* velocity = velocity_of(*points);
  const auto speed = vtkSmartPointer<vtkDoubleArray>::New();
  speed->SetName("speed");
  speed->SetNumberOfTuples(points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    Vector v{};
    if (velocity != nullptr)
      velocity->GetTuple(i, v.data());
    speed->SetValue(i, std::hypot(v[0], v[1], v[2]));
  }
  points->GetPointData()->AddArray(speed);
  return points;
}

double nearly_largest(std::vector<double> values) {
  if (values.empty())
    return 0;
  constexpr double share = 0.98;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void add_bodies(vtkRenderer& renderer, vtkPolyData& bodies, const Colours& colours, const Keep& keep) {
  const auto surface = BodySurfaces(bodies, kMostTriangles).of(bodies, keep);
  if (surface->GetNumberOfPolys() == 0)
    return;
  if (colours.at_rest)
    surface->GetPointData()->SetScalars(tones(*surface));
  else
    surface->GetPointData()->SetActiveScalars("speed");
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(surface);
  mapper->SetScalarModeToUsePointData();
  mapper->SetLookupTable(colours.bodies);
  mapper->UseLookupTableScalarRangeOn();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  shade(*actor->GetProperty());
  renderer.AddActor(actor);
}

vtkSmartPointer<vtkActor> flow_slice(vtkUnstructuredGrid& flow, const Colours& colours, const Vector& origin,
                                     const Vector& normal) {
  const auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetOrigin(origin.data());
  plane->SetNormal(normal.data());
  const auto cut = vtkSmartPointer<vtkCutter>::New();
  cut->SetInputData(&flow);
  cut->SetCutFunction(plane);
  const auto speed = vtkSmartPointer<vtkArrayCalculator>::New();
  speed->SetInputConnection(cut->GetOutputPort());
  speed->AddVectorArrayName("U");
  speed->SetFunction("mag(U)");
  speed->SetResultArrayName("fluid speed");
  const auto mapper = vtkSmartPointer<vtkDataSetMapper>::New();
  mapper->SetInputConnection(speed->GetOutputPort());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("fluid speed");
  mapper->SetLookupTable(colours.fluid);
  mapper->UseLookupTableScalarRangeOn();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> plain_actor(vtkAlgorithmOutput* geometry, double grey) {
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputConnection(geometry);
  mapper->ScalarVisibilityOff();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(grey, grey, grey);
  return actor;
}

void add_line(vtkRenderer& renderer, const Vector& a, const Vector& b) {
  const auto source = vtkSmartPointer<vtkLineSource>::New();
  source->SetPoint1(a.data());
  source->SetPoint2(b.data());
  const auto actor = plain_actor(source->GetOutputPort(), 0.25);
  actor->GetProperty()->SetLineWidth(3);
  renderer.AddActor(actor);
}

void look(vtkRenderer& renderer, const Vector& centre, const Vector& from, const Vector& up, double half_height) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(centre.data());
  camera.SetPosition(centre[0] + from[0], centre[1] + from[1], centre[2] + from[2]);
  camera.SetViewUp(up.data());
  camera.SetParallelScale(half_height);
  renderer.ResetCameraClippingRange();
}

void add_text(vtkRenderer& renderer, const std::string& text, int size, double x, double y) {
  const auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetFontSize(size);
  actor->GetTextProperty()->SetColor(0, 0, 0);
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetTextProperty()->SetVerticalJustificationToCentered();
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->GetPositionCoordinate()->SetValue(x, y);
  renderer.AddViewProp(actor);
}

void add_bar(vtkRenderer& renderer, vtkColorTransferFunction* colours, const char* title, double x, double width) {
  const auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(colours);
  bar->SetOrientationToHorizontal();
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.2g");
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(x, 0.1);
  bar->SetWidth(width);
  bar->SetHeight(0.55);
  bar->SetUnconstrainedFontSize(true);
  vtkTextProperty& text = *bar->GetLabelTextProperty();
  text.SetColor(0, 0, 0);
  text.SetFontSize(kTextSize);
  text.SetBold(false);
  text.SetItalic(false);
  text.SetShadow(false);
  renderer.AddViewProp(bar);
  add_text(renderer, title, kTextSize, x + width / 2, 0.86);
}

} // namespace eccentra::report
