// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements bed_picture.h with VTK.
#include "report/bed_picture.h"

#include "report/case_parameters.h"
#include "report/flow_fields.h"
#include "report/picture_file.h"
#include "report/picture_parts.h"
#include "report/picture_scales.h"
#include "report/scene_picture.h"

#include <vtkActor.h>
#include <vtkLineSource.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace eccentra::report {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Everything of one case that is drawn, and the shared scales.
struct Scene {
  const Case* data = nullptr;
  vtkSmartPointer<vtkPolyData> spheres;
  vtkSmartPointer<vtkUnstructuredGrid> flow;
};

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

void side_view(vtkRenderer& renderer, const Scene& scene, const Colours& colours, double half_height) {
  const Section& section = scene.data->section;
  if (scene.flow != nullptr)
    renderer.AddActor(flow_slice(*scene.flow, colours, {0, 0, 0}, {1, 0, 0}));
  renderer.AddActor(pipe_actor(section));
  add_bodies(renderer, *scene.spheres, colours, [](const Vector& p) { return p[0] < 0; });
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
    renderer.AddActor(flow_slice(*scene.flow, colours, {0, 0, middle}, {0, 0, 1}));
  const double slab = 0.75 * (section.hole_radius - section.pipe_radius) / 2;
  add_bodies(renderer, *scene.spheres, colours, [&](const Vector& p) { return p[2] > middle && p[2] < middle + slab; });
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
  const Colours colours = make_colours(std::max(nearly_largest(body_speeds), least), std::max(fastest_fluid, least));

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
  constexpr double widest = 8000; // pixels of a picture
  const double scale = std::min(pixels_per_hole / hole, widest / std::accumulate(widths.begin(), widths.end(), 0.0));
  constexpr double narrowest = 1000; // pixels: room for the numbers of the scales of colour
  const double stretch = std::max(1.0, narrowest / scale / std::accumulate(widths.begin(), widths.end(), 0.0));
  for (double& w : widths)
    w *= stretch;
  const double cross_height = margin * hole;
  double width = 0;
  std::vector<std::vector<std::string>> lines;
  std::size_t most_lines = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    width += widths[i] * scale;
    lines.push_back(wrapped(caption_of_parameters(*scenes[i].data), widths[i] * scale));
    most_lines = std::max(most_lines, lines.back().size());
  }
  const double titles = title_pixels(most_lines), bottom = kLegendPixels + kScalePixels;
  const double height = (side_height + cross_height) * scale + bottom + titles;

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
    const double side_bottom = bottom + cross_height * scale;
    side_view(*viewport(left, right, side_bottom, height - titles), scenes[i], colours, side_height / 2);
    cross_section(*viewport(left, right, bottom, side_bottom), scenes[i], colours, cross_height / 2);
    const double angle = scenes[i].data->inclination * pi / 180;
    add_scales(*viewport(left, right, kLegendPixels, bottom),
               {right - left, scale, true, {std::sin(angle), std::cos(angle)}});
    add_title(*viewport(left, right, height - titles, height), title_of(*scenes[i].data), lines[i], titles);
    left = right;
  }
  const auto legend = viewport(0, width, 0, kLegendPixels);
  add_bar(*legend, colours.bodies, "speed of the bodies [m/s]", 0.08);
  if (fastest_fluid > 0)
    add_bar(*legend, colours.fluid, "speed of the fluid [m/s]", 0.56);
  window->Render();
  write_png(*window, file);
}

} // namespace eccentra::report
