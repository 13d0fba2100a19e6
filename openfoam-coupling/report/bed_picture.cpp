// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements bed_picture.h with VTK.
#include "report/bed_picture.h"

#include "report/picture_file.h"

#include <vtkActor.h>
#include <vtkArrayCalculator.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkCutter.h>
#include <vtkDataSetMapper.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLineSource.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace eccentra::report {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int text_size = 22;
constexpr double legend_pixels = 130;
constexpr double title_pixels = 70;

/// Everything of one case that is drawn, and the shared scales.
struct Scene {
  const Case* data = nullptr;
  vtkSmartPointer<vtkPolyData> spheres;
  vtkSmartPointer<vtkUnstructuredGrid> flow;
};

struct Colours {
  vtkSmartPointer<vtkColorTransferFunction> bodies;
  vtkSmartPointer<vtkColorTransferFunction> fluid;
};

using Stop = std::array<double, 3>;

/// Even steps through colours of rising lightness; readable in grey, too.
template <std::size_t n>
vtkSmartPointer<vtkColorTransferFunction> scale(const std::array<Stop, n>& stops, double highest) {
  const auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (std::size_t i = 0; i < n; ++i)
    function->AddRGBPoint(highest * static_cast<double>(i) / static_cast<double>(n - 1), stops[i][0], stops[i][1],
                          stops[i][2]);
  return function;
}

Colours make_colours(double fastest_body, double fastest_fluid) {
  constexpr std::array<Stop, 5> plasma = {
      {{0.24, 0.06, 0.46}, {0.55, 0.09, 0.60}, {0.83, 0.28, 0.46}, {0.97, 0.55, 0.29}, {0.97, 0.90, 0.28}}};
  constexpr std::array<Stop, 4> blues = {
      {{0.95, 0.97, 1.0}, {0.72, 0.83, 0.93}, {0.42, 0.65, 0.83}, {0.13, 0.40, 0.66}}};
  return {scale(plasma, fastest_body), scale(blues, fastest_fluid)};
}

/// The drawn spheres with their speed as scalars.
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

/// Value below which 98 % lie: one body that has just bounced does not set the scale for all.
double nearly_largest(std::vector<double> values) {
  if (values.empty())
    return 0;
  constexpr double share = 0.98;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The next larger number whose quarters are short: the scale has five labels.
double round_up(double value) {
  constexpr std::array<double, 10> steps = {0.1, 0.12, 0.16, 0.2, 0.24, 0.32, 0.4, 0.6, 0.8, 1.0};
  const double decade = std::pow(10.0, std::ceil(std::log10(value)));
  return decade * *std::find_if(steps.begin(), steps.end() - 1, [&](double s) { return s * decade >= value; });
}

/// `keep` decides by position which spheres are drawn.
template <class Keep>
vtkSmartPointer<vtkActor> sphere_actor(const Scene& scene, const Colours& colours, const Keep& keep) {
  const auto chosen = vtkSmartPointer<vtkPolyData>::New();
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto speed = vtkSmartPointer<vtkDoubleArray>::New();
  const auto diameter = vtkSmartPointer<vtkDoubleArray>::New();
  speed->SetName("speed");
  diameter->SetName("diameter");
  vtkDataArray* radii = scene.spheres->GetPointData()->GetArray("radius");
  vtkDataArray* speeds = scene.spheres->GetPointData()->GetArray("speed");
  for (vtkIdType i = 0; i < scene.spheres->GetNumberOfPoints(); ++i) {
    Vector p{};
    scene.spheres->GetPoint(i, p.data());
    if (radii == nullptr || !keep(p))
      continue;
    points->InsertNextPoint(p.data());
    speed->InsertNextValue(speeds->GetTuple1(i));
    diameter->InsertNextValue(2 * radii->GetTuple1(i));
  }
  chosen->SetPoints(points);
  chosen->GetPointData()->SetScalars(speed);
  chosen->GetPointData()->AddArray(diameter);
  const auto sphere = vtkSmartPointer<vtkSphereSource>::New(); // of diameter 1
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  const auto mapper = vtkSmartPointer<vtkGlyph3DMapper>::New();
  mapper->SetInputData(chosen);
  mapper->SetSourceConnection(sphere->GetOutputPort());
  mapper->SetScaleModeToScaleByMagnitude();
  mapper->SetScaleArray("diameter");
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("speed");
  mapper->SetLookupTable(colours.bodies);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetSpecular(0.25);
  actor->GetProperty()->SetSpecularPower(20);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.8);
  return actor;
}

vtkSmartPointer<vtkActor> flow_slice(const Scene& scene, const Colours& colours, const Vector& origin,
                                     const Vector& normal) {
  const auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetOrigin(origin.data());
  plane->SetNormal(normal.data());
  const auto cut = vtkSmartPointer<vtkCutter>::New();
  cut->SetInputData(scene.flow);
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

vtkSmartPointer<vtkActor> pipe_actor(const Section& section) {
  const auto axis = vtkSmartPointer<vtkLineSource>::New();
  axis->SetPoint1(section.pipe_centre[0], section.pipe_centre[1], 0);
  axis->SetPoint2(section.pipe_centre[0], section.pipe_centre[1], section.length);
  const auto tube = vtkSmartPointer<vtkTubeFilter>::New();
  tube->SetInputConnection(axis->GetOutputPort());
  tube->SetRadius(section.pipe_radius);
  tube->SetNumberOfSides(96);
  tube->CappingOn();
  const auto actor = plain_actor(tube->GetOutputPort(), 0.72);
  actor->GetProperty()->SetSpecular(0.3);
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

/// Camera that looks along x (the flow goes to the right) or against the hole's axis from far away, `half_height` of
/// the world above and below the centre.
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

void side_view(vtkRenderer& renderer, const Scene& scene, const Colours& colours, double half_height) {
  const Section& section = scene.data->section;
  if (scene.flow != nullptr)
    renderer.AddActor(flow_slice(scene, colours, {0, 0, 0}, {1, 0, 0}));
  renderer.AddActor(pipe_actor(section));
  renderer.AddActor(sphere_actor(scene, colours, [](const Vector& p) { return p[0] < 0; }));
  for (const double y : {-section.hole_radius, section.hole_radius})
    add_line(renderer, {0, y, 0}, {0, y, section.length});
  // Gravity is (0, -sin, -cos) of the inclination: its opposite is up in the picture.
  const double angle = scene.data->inclination * pi / 180;
  look(renderer, {0, 0, section.length / 2}, {-10 * section.length, 0, 0}, {0, std::sin(angle), std::cos(angle)},
       half_height);
}

void cross_section(vtkRenderer& renderer, const Scene& scene, const Colours& colours, double half_height) {
  const Section& section = scene.data->section;
  const double middle = section.length / 2;
  if (scene.flow != nullptr)
    renderer.AddActor(flow_slice(scene, colours, {0, 0, middle}, {0, 0, 1}));
  const double slab = 0.75 * (section.hole_radius - section.pipe_radius) / 2;
  renderer.AddActor(
      sphere_actor(scene, colours, [&](const Vector& p) { return p[2] > middle && p[2] < middle + slab; }));
  for (const bool hole : {false, true}) {
    const auto circle = vtkSmartPointer<vtkRegularPolygonSource>::New();
    circle->SetNumberOfSides(180);
    circle->SetRadius(hole ? section.hole_radius : section.pipe_radius);
    circle->SetCenter(hole ? 0 : section.pipe_centre[0], hole ? 0 : section.pipe_centre[1],
                      middle + (hole ? 0 : 2 * slab)); // the pipe's end hides no body: none is inside
    circle->SetGeneratePolygon(!hole);
    const auto actor = plain_actor(circle->GetOutputPort(), hole ? 0.25 : 0.72);
    actor->GetProperty()->SetLineWidth(3);
    actor->GetProperty()->LightingOff();
    renderer.AddActor(actor);
  }
  look(renderer, {0, 0, middle}, {0, 0, 10 * section.length}, {0, 1, 0}, half_height);
}

void add_bar(vtkRenderer& renderer, vtkColorTransferFunction* colours, const char* title, double x) {
  const auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(colours);
  bar->SetOrientationToHorizontal();
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.2g");
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(x, 0.1);
  bar->SetWidth(0.36);
  bar->SetHeight(0.55);
  bar->SetUnconstrainedFontSize(true);
  vtkTextProperty& text = *bar->GetLabelTextProperty();
  text.SetColor(0, 0, 0);
  text.SetFontSize(text_size);
  text.SetBold(false);
  text.SetItalic(false);
  text.SetShadow(false);
  renderer.AddViewProp(bar);
  add_text(renderer, title, text_size, x + 0.18, 0.86);
}

} // namespace

void draw_beds(const std::vector<Case>& cases, const std::filesystem::path& file) {
  std::vector<Scene> scenes;
  std::vector<double> body_speeds;
  double fastest_fluid = 0;
  for (const Case& data : cases) {
    Scene scene{&data, vtkSmartPointer<vtkPolyData>::New(), read_flow(data.folder)};
    if (!data.spheres.empty())
      scene.spheres = with_speed(read_points(data.spheres.back().path));
    if (vtkDataArray* speed = scene.spheres->GetPointData()->GetArray("speed"))
      for (vtkIdType i = 0; i < speed->GetNumberOfTuples(); ++i)
        body_speeds.push_back(speed->GetTuple1(i));
    if (scene.flow != nullptr) {
      std::array<double, 2> range{};
      scene.flow->GetPointData()->GetArray("U")->GetRange(range.data(), -1); // of the magnitude
      fastest_fluid = std::max(fastest_fluid, range[1]);
    }
    scenes.push_back(scene);
  }
  constexpr double least = 1e-6; // m/s: a scale of colours needs a length
  const Colours colours =
      make_colours(round_up(std::max(nearly_largest(body_speeds), least)), round_up(std::max(fastest_fluid, least)));

  // One scale of length for all: the widths that the holes take as they lie, and the height of the highest.
  constexpr double margin = 1.08;
  constexpr double pixels_per_hole = 330;
  std::vector<double> widths;
  double side_height = 0;
  double hole = 0;
  for (const Scene& scene : scenes) {
    const double angle = scene.data->inclination * pi / 180;
    const double length = scene.data->section.length;
    const double diameter = 2 * scene.data->section.hole_radius;
    widths.push_back(margin *
                     std::max(length * std::abs(std::sin(angle)) + diameter * std::abs(std::cos(angle)), diameter));
    side_height =
        std::max(side_height, margin * (length * std::abs(std::cos(angle)) + diameter * std::abs(std::sin(angle))));
    hole = std::max(hole, diameter);
  }
  const double scale = pixels_per_hole / hole;
  const double cross_height = margin * hole;
  double width = 0;
  for (const double w : widths)
    width += w * scale;
  const double height = (side_height + cross_height) * scale + legend_pixels + title_pixels;

  const auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetSize(static_cast<int>(width), static_cast<int>(height));
  window->SetMultiSamples(8);
  const auto viewport = [&](double x0, double x1, double y0, double y1) {
    const auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetBackground(1, 1, 1);
    renderer->SetViewport(x0 / width, y0 / height, x1 / width, y1 / height);
    window->AddRenderer(renderer);
    return renderer;
  };
  double left = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const double right = left + widths[i] * scale;
    const double side_bottom = legend_pixels + cross_height * scale;
    side_view(*viewport(left, right, side_bottom, height - title_pixels), scenes[i], colours, side_height / 2);
    cross_section(*viewport(left, right, legend_pixels, side_bottom), scenes[i], colours, cross_height / 2);
    add_text(*viewport(left, right, height - title_pixels, height), scenes[i].data->name, text_size + 4, 0.5, 0.4);
    left = right;
  }
  const auto legend = viewport(0, width, 0, legend_pixels);
  add_bar(*legend, colours.bodies, "speed of the bodies [m/s]", 0.08);
  if (fastest_fluid > 0)
    add_bar(*legend, colours.fluid, "speed of the fluid [m/s]", 0.56);
  window->Render();
  write_png(*window, file);
}

} // namespace eccentra::report
