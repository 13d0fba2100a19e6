// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Renders union surfaces off screen.
#include "shape/vtk/picture.h"

#include "shape/rounded_hull.h"
#include "shape/vtk/union_surface.h"
#include "shape/vtk/virtual_display.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkImageResize.h>
#include <vtkImageSincInterpolator.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataWriter.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr int meridians = 64;             ///< per sphere of a drawn surface
constexpr double crack_margin = 0.05;     ///< radii of covered surface that a picture keeps
constexpr int max_meridian_spheres = 200; ///< more spheres get fewer meridians each
constexpr int panel_width = 720, panel_height = 760;
constexpr int supersampling = 2; ///< drawn this many times larger and averaged down: smooth edges
constexpr double gap = 1.15;     ///< distance of neighbours in sums of bounding radii

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

int fineness_for(const ClusterShape& shape) {
  const int count = static_cast<int>(shape.surface_spheres().size());
  return std::max(16, count <= max_meridian_spheres ? meridians : meridians * max_meridian_spheres / count);
}

void require_writable(const std::string& path) {
  if (!std::ofstream(path, std::ios::app))
    throw std::invalid_argument("cannot write '" + path + "': check the folder and the space on the disk");
}

/// Blue to red through pale grey: where delta_e is small and where it is large, for every kind of eyes.
vtkSmartPointer<vtkColorTransferFunction> colours(double largest) {
  auto map = vtkSmartPointer<vtkColorTransferFunction>::New();
  map->SetColorSpaceToLab();
  map->AddRGBPoint(0.0, 0.20, 0.36, 0.63);
  map->AddRGBPoint(0.35 * largest, 0.55, 0.73, 0.84);
  map->AddRGBPoint(0.65 * largest, 0.97, 0.84, 0.60);
  map->AddRGBPoint(largest, 0.78, 0.28, 0.18);
  return map;
}

void add_text(vtkRenderer* renderer, const std::string& text, double x, double y, int size, bool bold) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontSize(size * supersampling);
  property->SetColor(0.15, 0.17, 0.20);
  property->SetBold(bold);
  property->SetJustificationToCentered();
  renderer->AddActor2D(actor);
}

void add_light(vtkRenderer* renderer, double x, double y, double z, double intensity) {
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(x, y, z);
  light->SetFocalPoint(0, 0, 0);
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

/// One shape in its part of the window; `scale` [m] is half the height that the camera sees.
void add_panel(vtkRenderWindow* window, const ClusterShape& shape, double left, double right, double scale,
               double largest) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(union_surface(shape, Eigen::Vector3d::Zero(), fineness_for(shape), crack_margin));
  mapper->SetLookupTable(colours(largest));
  mapper->UseLookupTableScalarRangeOn();
  mapper->SetInterpolateScalarsBeforeMapping(false);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPhong();
  actor->GetProperty()->SetAmbient(0.18);
  actor->GetProperty()->SetDiffuse(0.80);
  actor->GetProperty()->SetSpecular(0.25);
  actor->GetProperty()->SetSpecularPower(30);
  vtkNew<vtkRenderer> renderer;
  renderer->SetViewport(left, 0, right, 1);
  renderer->SetBackground(1, 1, 1);
  renderer->SetBackground2(0.90, 0.92, 0.95);
  renderer->GradientBackgroundOn();
  renderer->AutomaticLightCreationOff();
  add_light(renderer, -0.6, 1.0, 1.2, 0.85);
  add_light(renderer, 1.2, 0.1, 0.6, 0.30);
  renderer->AddActor(actor);
  add_text(renderer, shape.name(), 0.5, 0.93, 24, true);
  add_text(renderer,
           fmt::format("{}   R_eq {:.4g} m   sphericity {:.3f}",
                       shape.hull() ? fmt::format("corners of {:.3g} m", shape.hull()->radius())
                                    : fmt::format("{} spheres", shape.spheres().size()),
                       shape.equivalent_radius(), shape.sphericity()),
           0.5, 0.885, 15, false);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  const Eigen::Vector3d from = Eigen::Vector3d(1.0, -1.7, 1.15).normalized() * 20 * scale;
  camera->SetPosition(from.data());
  camera->SetViewUp(0, 0, 1);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(scale);
  renderer->ResetCameraClippingRange();
  window->AddRenderer(renderer);
}

void add_scale_bar(vtkRenderWindow* window, double largest) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetLayer(1);
  renderer->SetViewport(0, 0, 1, 1);
  renderer->InteractiveOff();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours(largest));

  bar->SetOrientationToHorizontal();
  bar->SetNumberOfLabels(5);
  bar->SetMaximumNumberOfColors(256);
  bar->SetLabelFormat("%.2f");
  bar->SetWidth(0.5);
  bar->SetHeight(0.06);
  bar->SetPosition(0.25, 0.02);
  add_text(renderer, "shape eccentricity  delta_e / R_eq", 0.5, 0.095, 14, false);
  bar->UnconstrainedFontSizeOn();
  vtkTextProperty* label = bar->GetLabelTextProperty();
  label->SetColor(0.15, 0.17, 0.20);
  label->SetItalic(false);
  label->SetBold(false);
  label->SetShadow(false);
  label->SetFontSize(14 * supersampling);
  renderer->AddActor2D(bar);
  window->SetNumberOfLayers(2);
  window->AddRenderer(renderer);
}

} // namespace

void write_surface(const std::vector<ClusterShape>& shapes, const std::string& path) {
  const bool xml = ends_with(path, ".vtp");
  if (!xml && !ends_with(path, ".vtk"))
    throw std::invalid_argument("surface file '" + path + "' must end in .vtp or .vtk");
  require_writable(path);
  vtkNew<vtkAppendPolyData> all;
  double place = 0, before = 0;
  for (const ClusterShape& shape : shapes) {
    place += before > 0 ? gap * (before + shape.bounding_radius()) : 0;
    before = shape.bounding_radius();
    all->AddInputData(union_surface(shape, Eigen::Vector3d(place, 0, 0), fineness_for(shape), 0));
  }
  all->Update();
  int written = 0;
  if (xml) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(all->GetOutput());
    written = writer->Write();
  } else {
    vtkNew<vtkPolyDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetFileTypeToBinary();
    writer->SetInputData(all->GetOutput());
    written = writer->Write();
  }
  if (!written)
    throw std::invalid_argument("cannot write '" + path + "': check the folder and the space on the disk");
}

void write_picture(const std::vector<ClusterShape>& shapes, const std::string& path) {
  if (!ends_with(path, ".png"))
    throw std::invalid_argument("picture file '" + path + "' must end in .png");
  require_writable(path);
  double scale = 0, largest = 0;
  for (const ClusterShape& shape : shapes) {
    scale = std::max(scale, shape.bounding_radius());
    for (const int k : shape.surface_spheres())
      largest = std::max(largest, shape.spheres()[k].centre.norm() / shape.equivalent_radius());
  }
  scale *= 1.35; // room for the titles and the colour bar
  largest = std::max(largest, 0.1);
  const VirtualDisplay display;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  const int panels = static_cast<int>(shapes.size());
  window->SetSize(panels * panel_width * supersampling, panel_height * supersampling);
  for (int k = 0; k < panels; ++k)
    add_panel(window, shapes[k], static_cast<double>(k) / panels, static_cast<double>(k + 1) / panels, scale, largest);
  add_scale_bar(window, largest);
  window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkImageResize> shrink;
  shrink->SetInputConnection(grab->GetOutputPort());
  vtkNew<vtkImageSincInterpolator> smooth;
  smooth->AntialiasingOn();
  shrink->SetInterpolator(smooth);
  shrink->SetOutputDimensions(panels * panel_width, panel_height, 1);
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputConnection(shrink->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw std::invalid_argument("cannot write '" + path + "': check the folder and the space on the disk");
}

} // namespace eccentra::shape
