// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements scene_picture.h with VTK.
#include "report/scene_picture.h"

#include "report/case_parameters.h"
#include "report/film.h"
#include "report/flow_fields.h"
#include "report/picture_file.h"
#include "report/picture_parts.h"
#include "report/picture_scales.h"
#include "report/wall_surfaces.h"

#include <vtkCubeSource.h>
#include <vtkCutter.h>
#include <vtkFeatureEdges.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace eccentra::report {
namespace {

constexpr double kPixels = 720;   // of the larger side of a column
constexpr double kSmallest = 300; // pixels of the smaller side
constexpr double kMargin = 1.06;  // around what is drawn
constexpr double kTilt = 0.12;    // [rad]: a scene without a fluid is seen from a little above
constexpr double kSlowest = 1e-2; // [m/s], of a scale of colour
constexpr double kAtRest = 1e-3;  // [m/s]
constexpr double kParallel = 0.9; // cosine from which a direction counts as that of another one

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector along(const Vector& a, double s, const Vector& b, double t) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}
Vector normalised(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// An upright box that grows.
struct Bounds {
  std::array<double, 6> sides = {1, -1, 1, -1, 1, -1};
  bool empty() const { return sides[0] > sides[1]; }
  void add(const std::array<double, 6>& more) {
    if (more[0] > more[1])
      return;
    for (std::size_t d = 0; d < 3; ++d) {
      sides[2 * d] = empty_ ? more[2 * d] : std::min(sides[2 * d], more[2 * d]);
      sides[2 * d + 1] = empty_ ? more[2 * d + 1] : std::max(sides[2 * d + 1], more[2 * d + 1]);
    }
    empty_ = false;
  }
  double size(std::size_t d) const { return sides[2 * d + 1] - sides[2 * d]; }
  Vector centre() const { return {(sides[0] + sides[1]) / 2, (sides[2] + sides[3]) / 2, (sides[4] + sides[5]) / 2}; }
  /// Half of the extent along a unit vector.
  double half(const Vector& direction) const {
    return (size(0) * std::abs(direction[0]) + size(1) * std::abs(direction[1]) + size(2) * std::abs(direction[2])) / 2;
  }

 private:
  bool empty_ = true;
};

/// What a column shows.
struct Column {
  const View* view = nullptr;
  vtkSmartPointer<vtkPolyData> bodies;
  vtkSmartPointer<vtkUnstructuredGrid> flow;
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  Bounds bounds;
  std::array<double, 6> seen{}; ///< a body whose centre is outside has rolled far away and is not drawn
  Vector up = {0, 0, 1};
  Vector away = {0, 1, 0}; ///< the direction of sight, across `up`
  Vector right = {1, 0, 0};
  double tilt = 0;
  double half_width = 0, half_height = 0; ///< [m] of the picture
};

/// Adds the bodies, and says which centres are seen: along a direction in which a few bodies have rolled so far away
/// that the others would be small, those of the others.
void add_bodies_to(Column& column) {
  vtkPolyData& bodies = *column.bodies;
  constexpr double endless = std::numeric_limits<double>::infinity();
  column.seen = {-endless, endless, -endless, endless, -endless, endless};
  const vtkIdType count = bodies.GetNumberOfPoints();
  if (count == 0)
    return;
  double largest = 0;
  if (vtkDataArray* radii = bodies.GetPointData()->GetArray("radius"))
    largest = radii->GetRange()[1];
  constexpr double outside = 0.03; // of all, on each side
  constexpr double far = 0.4;      // of the width of the others, from their side
  const auto skipped = static_cast<std::ptrdiff_t>(outside * static_cast<double>(count));
  std::array<double, 6> sides{};
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> places;
    for (vtkIdType i = 0; i < count; ++i)
      places.push_back(bodies.GetPoint(i)[d]);
    std::sort(places.begin(), places.end());
    double low = places.front(), high = places.back();
    const double first = places[static_cast<std::size_t>(skipped)], last = *(places.end() - 1 - skipped);
    const double tolerated = far * (last - first + 2 * largest);
    if (first - low > tolerated)
      low = column.seen[2 * d] = first;
    if (high - last > tolerated)
      high = column.seen[2 * d + 1] = last;
    sides[2 * d] = low - largest;
    sides[2 * d + 1] = high + largest;
  }
  column.bounds.add(sides);
}

/// Walls enlarge the bounds of the bodies; a cylinder does so across its axis.
void add_walls_to(Bounds& bounds, const Case& data, const std::vector<vtkSmartPointer<vtkPolyData>>& meshes) {
  const Bounds bodies = bounds;
  for (const auto& [id, wall] : data.dem.walls) {
    if (wall.kind != Wall::Kind::cylinder)
      continue;
    std::array<double, 6> sides{};
    for (std::size_t d = 0; d < 3; ++d) {
      const bool axis = std::abs(wall.axis[d]) > kParallel;
      sides[2 * d] = axis ? bodies.sides[2 * d] : wall.point[d] - wall.radius;
      sides[2 * d + 1] = axis ? bodies.sides[2 * d + 1] : wall.point[d] + wall.radius;
    }
    bounds.add(sides);
  }
  for (const auto& mesh : meshes) {
    std::array<double, 6> sides{};
    mesh->GetBounds(sides.data());
    bounds.add(sides);
  }
}

/// The axis of a cylinder that lies and is wider than long, or nothing.
const Wall* drum_of(const Column& column) {
  for (const auto& [id, wall] : column.view->data->dem.walls)
    if (wall.kind == Wall::Kind::cylinder && std::abs(dot(wall.axis, column.up)) < 1 - kParallel &&
        2 * wall.radius > 2 * column.bounds.half(wall.axis))
      return &wall;
  return nullptr;
}

/// A hole or pipe is seen from its side, however short the piece of it is.
bool along_a_cylinder(const Column& column, const Vector& sight) {
  for (const auto& [id, wall] : column.view->data->dem.walls)
    if (wall.kind == Wall::Kind::cylinder && std::abs(dot(wall.axis, sight)) > kParallel)
      return true;
  return false;
}

void choose_sight(Column& column) {
  const Vector& g = column.view->data->dem.gravity;
  if (dot(g, g) > 0)
    column.up = normalised({-g[0], -g[1], -g[2]});
  const Wall* drum = drum_of(column);
  Vector sight = {0, 0, 0};
  if (drum != nullptr) {
    sight = drum->axis;
  } else {
    double shortest = 0;
    for (const std::size_t d : {1U, 0U, 2U}) { // along y where sides are equal
      Vector axis = {0, 0, 0};
      axis[d] = 1;
      if (std::abs(dot(axis, column.up)) > kParallel || along_a_cylinder(column, axis))
        continue;
      if (shortest == 0 || column.bounds.size(d) < 0.999 * shortest) {
        shortest = column.bounds.size(d);
        sight = axis;
      }
    }
  }
  column.away = normalised(along(sight, 1, column.up, -dot(sight, column.up)));
  column.right = cross(column.away, column.up);
  column.tilt = drum == nullptr && column.view->data->run.rows() == 0 ? kTilt : 0;
  const double depth = column.bounds.half(column.away);
  column.half_width = kMargin * column.bounds.half(column.right);
  column.half_height =
      kMargin * (column.bounds.half(column.up) * std::cos(column.tilt) + depth * std::sin(column.tilt));
}

Column column_of(const View& view) {
  Column column;
  column.view = &view;
  const Case& data = *view.data;
  column.bodies = vtkSmartPointer<vtkPolyData>::New();
  if (!data.spheres.empty())
    column.bodies = with_speed(read_points(data.spheres.at(view.file).path));
  const double time = time_of(data, data.spheres.at(view.file));
  column.flow = read_flow(data.folder, data.dem.time_step > 0 ? std::max(0.0, time) : -1);
  for (const WallMesh& mesh : data.dem.meshes)
    column.meshes.push_back(mesh_of_wall(data, mesh));
  add_bodies_to(column);
  add_walls_to(column.bounds, data, column.meshes);
  if (column.flow != nullptr) {
    std::array<double, 6> sides{};
    column.flow->GetBounds(sides.data());
    column.bounds.add(sides);
  }
  return column;
}

void add_outline(vtkRenderer& renderer, vtkAlgorithmOutput* geometry) {
  const auto actor = plain_actor(geometry, 0.25);
  actor->GetProperty()->SetLineWidth(3);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

void add_wall(vtkRenderer& renderer, const Column& column, const Wall& wall) {
  const Bounds& bounds = column.bounds;
  if (wall.kind == Wall::Kind::plane) {
    if (std::abs(dot(wall.axis, column.away)) > kParallel)
      return; // before or behind everything
    const auto box = vtkSmartPointer<vtkCubeSource>::New();
    constexpr double around = 1e-3; // of the size: a plane on the bounds' own side is cut, too
    std::array<double, 6> sides = bounds.sides;
    for (std::size_t d = 0; d < 3; ++d) {
      const double more = around * bounds.half(column.right) + 1e-9;
      sides[2 * d] -= more;
      sides[2 * d + 1] += more;
    }
    box->SetBounds(sides.data());
    const auto plane = vtkSmartPointer<vtkPlane>::New();
    plane->SetOrigin(wall.point.data());
    plane->SetNormal(wall.axis.data());
    const auto cut = vtkSmartPointer<vtkCutter>::New();
    cut->SetInputConnection(box->GetOutputPort());
    cut->SetCutFunction(plane);
    add_outline(renderer, cut->GetOutputPort());
    return;
  }
  const double half = bounds.half(wall.axis);
  const Vector middle = along(wall.point, 1, wall.axis, dot(along(bounds.centre(), 1, wall.point, -1), wall.axis));
  for (const double end : {-half, half}) {
    const Vector centre = along(middle, 1, wall.axis, end);
    const auto circle = vtkSmartPointer<vtkRegularPolygonSource>::New();
    circle->SetNumberOfSides(180);
    circle->SetRadius(wall.radius);
    circle->SetCenter(centre.data());
    circle->SetNormal(wall.axis.data());
    circle->GeneratePolygonOff();
    add_outline(renderer, circle->GetOutputPort());
  }
  const Vector side = cross(wall.axis, column.away);
  if (dot(side, side) < 1 - kParallel * kParallel)
    return; // seen along its axis
  for (const double sign : {-wall.radius, wall.radius}) {
    const Vector foot = along(middle, 1, normalised(side), sign);
    add_line(renderer, along(foot, 1, wall.axis, -half), along(foot, 1, wall.axis, half));
  }
}

void add_mesh(vtkRenderer& renderer, vtkPolyData* mesh) {
  const auto surface = vtkSmartPointer<vtkTransformPolyDataFilter>::New();
  surface->SetTransform(vtkSmartPointer<vtkTransform>::New());
  surface->SetInputData(mesh);
  const auto glass = plain_actor(surface->GetOutputPort(), 0.55);
  constexpr double opacity = 0.15;
  glass->GetProperty()->SetOpacity(opacity);
  glass->GetProperty()->LightingOff();
  renderer.AddActor(glass);
  const auto edges = vtkSmartPointer<vtkFeatureEdges>::New();
  edges->SetInputData(mesh);
  edges->ManifoldEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  constexpr double sharp = 40; // degrees
  edges->SetFeatureAngle(sharp);
  add_outline(renderer, edges->GetOutputPort());
}

void draw_column(vtkRenderer& renderer, const Column& column, const Colours& colours, double half_height) {
  const Vector centre = column.bounds.centre();
  if (column.flow != nullptr)
    renderer.AddActor(flow_slice(*column.flow, colours, centre, column.away));
  const bool cut = column.flow != nullptr;
  add_bodies(renderer, *column.bodies, colours, [&](const Vector& p) {
    for (std::size_t d = 0; d < 3; ++d)
      if (p[d] < column.seen[2 * d] || p[d] > column.seen[2 * d + 1])
        return false;
    return !cut || dot(along(p, 1, centre, -1), column.away) < 0;
  });
  for (const auto& [id, wall] : column.view->data->dem.walls)
    add_wall(renderer, column, wall);
  for (const auto& mesh : column.meshes)
    add_mesh(renderer, mesh);
  const double far = 10 * (column.half_width + column.half_height);
  const Vector from =
      along(along(column.away, -1, column.up, 0), far * std::cos(column.tilt), column.up, far * std::sin(column.tilt));
  look(renderer, centre, from, column.up, half_height);
}

/// Direction of the mean velocity of the fluid, as it is seen; zero if it goes along the sight or is none.
std::array<double, 2> flow_in_picture(const Column& column) {
  if (column.flow == nullptr)
    return {0, 0};
  vtkDataArray& U = *column.flow->GetPointData()->GetArray("U");
  Vector mean = {0, 0, 0};
  for (vtkIdType i = 0; i < U.GetNumberOfTuples(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      mean[d] += U.GetComponent(i, static_cast<int>(d)) / static_cast<double>(U.GetNumberOfTuples());
  const double right = dot(mean, column.right), up = dot(mean, column.up);
  constexpr double across = 0.3; // of the whole: less is not a direction of the picture
  return std::hypot(right, up) > across * std::sqrt(dot(mean, mean)) ? std::array<double, 2>{right, up}
                                                                     : std::array<double, 2>{0, 0};
}

/// Speeds that set the scales of colour.
Colours colours_of(const std::vector<Column>& columns) {
  std::vector<double> speeds;
  double fluid = kSlowest;
  for (const Column& column : columns) {
    if (vtkDataArray* speed = column.bodies->GetPointData()->GetArray("speed"))
      for (vtkIdType i = 0; i < speed->GetNumberOfTuples(); ++i)
        speeds.push_back(speed->GetTuple1(i));
    if (column.flow != nullptr) {
      std::array<double, 2> range{};
      column.flow->GetPointData()->GetArray("U")->GetRange(range.data(), -1); // of the magnitude
      fluid = std::max(fluid, range[1]);
    }
  }
  const double fastest = nearly_largest(speeds);
  if (fastest < kAtRest)
    return colours_at_rest(fluid);
  return make_colours(std::max(fastest, kSlowest), fluid);
}

std::string caption_of(const Case& data, const ParticleFile& file) {
  const double time = time_of(data, file);
  if (data.dem.time_step > 0 && std::abs(time) < data.dem.time_step)
    return "t = 0 s";
  return !(data.dem.time_step > 0) ? fmt::format("step {}", file.step) : fmt::format("t = {:.3g} s", time);
}

void share_bounds(Column& column, const Bounds& bounds, const std::array<double, 6>& seen) {
  column.bounds.add(bounds.sides);
  for (std::size_t d = 0; d < 3; ++d) {
    column.seen[2 * d] = std::min(column.seen[2 * d], seen[2 * d]);
    column.seen[2 * d + 1] = std::max(column.seen[2 * d + 1], seen[2 * d + 1]);
  }
}

/// Pictures of one case have one scale.
void share_bounds(std::vector<Column>& columns) {
  for (Column& column : columns)
    for (const Column& other : columns)
      if (&other != &column && other.view->data == column.view->data)
        share_bounds(column, other.bounds, other.seen);
  for (Column& column : columns)
    choose_sight(column);
}

bool any_flow(const std::vector<Column>& columns) {
  return std::any_of(columns.begin(), columns.end(), [](const Column& column) { return column.flow != nullptr; });
}

/// The columns beside each other; `fluid`: with a scale of colour for it.
void draw_columns(const std::vector<Column>& columns, const Colours& colours, bool fluid,
                  const std::filesystem::path& file) {
  double height = kSmallest;
  std::vector<double> scales; // pixels per metre
  for (const Column& column : columns) {
    scales.push_back(kPixels / (2 * std::max(column.half_width, column.half_height)));
    height = std::max(height, 2 * column.half_height * scales.back());
  }
  double width = 0;
  std::vector<double> widths;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    widths.push_back(std::max(kSmallest, 2 * columns[i].half_width * scales[i]));
    width += widths.back();
  }
  const double least_width = fluid ? 1000 : 640; // room for the numbers of the scales of colour
  const double stretch = std::max(1.0, least_width / width);
  for (double& w : widths)
    w *= stretch;
  width *= stretch;
  const double bottom = kLegendPixels + kScalePixels;
  std::vector<std::vector<std::string>> lines;
  std::size_t most_lines = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const View& view = *columns[i].view;
    const bool said = i > 0 && columns[i - 1].view->data == view.data; // once for several pictures of a case
    lines.push_back(said ? std::vector<std::string>{} : wrapped(caption_of_parameters(*view.data), widths[i]));
    most_lines = std::max(most_lines, lines.back().size());
  }
  const double titles = title_pixels(most_lines);
  const double total = bottom + height + titles;

  const auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetSize(static_cast<int>(width), static_cast<int>(total));
  window->SetMultiSamples(8);
  const auto viewport = [&](double x0, double x1, double y0, double y1) {
    const auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetBackground(1, 1, 1);
    renderer->SetViewport(x0 / width, y0 / total, x1 / width, y1 / total);
    window->AddRenderer(renderer);
    return renderer;
  };
  double left = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double right = left + widths[i];
    draw_column(*viewport(left, right, bottom, bottom + height), columns[i], colours, height / 2 / scales[i]);
    const Vector& g = columns[i].view->data->dem.gravity;
    add_scales(*viewport(left, right, kLegendPixels, bottom),
               {widths[i], scales[i], dot(g, g) > 0, flow_in_picture(columns[i])});
    add_title(*viewport(left, right, bottom + height, total), columns[i].view->caption, lines[i], titles);
    left = right;
  }
  const auto legend = viewport(0, width, 0, kLegendPixels);
  if (colours.at_rest)
    add_text(*legend, "the bodies are at rest", kTextSize, fluid ? 0.26 : 0.5, 0.86);
  else
    add_bar(*legend, colours.bodies, "speed of the bodies [m/s]", fluid ? 0.08 : 0.18, fluid ? 0.36 : 0.64);
  if (fluid)
    add_bar(*legend, colours.fluid, "speed of the fluid [m/s]", 0.56, 0.36);
  window->Render();
  write_png(*window, file);
}

} // namespace

double time_of(const Case& data, const ParticleFile& file) {
  if (!(data.dem.time_step > 0))
    return -1;
  if (data.run.rows() > 0 && !data.bodies.empty()) // the script may have poured before the flow began
    return data.run.columns.at("time").back() -
           static_cast<double>(data.bodies.back().step - file.step) * data.dem.time_step;
  return static_cast<double>(file.step) * data.dem.time_step;
}

std::string title_of(const Case& data) {
  return data.spheres.empty() ? data.name : data.name + ", " + caption_of(data, data.spheres.back());
}

std::vector<View> last_views(const std::vector<Case>& cases) {
  std::vector<View> views;
  for (const Case& data : cases) {
    if (data.spheres.empty())
      throw std::runtime_error(data.folder.string() + ": no files of particles: dump cluster/vtk or custom/vtk to "
                                                      "postProcessing/eccentra/grains_*.vtp or particles_*.vtk");
    views.push_back({&data, data.spheres.size() - 1, title_of(data)});
  }
  return views;
}

std::vector<View> strip(const Case& data, std::size_t count) {
  if (count == 0)
    throw std::invalid_argument("a strip of 0 pictures: give 1 or more");
  if (data.spheres.empty())
    return last_views({data});
  std::vector<View> views;
  const std::size_t last = data.spheres.size() - 1;
  std::size_t first = 0;
  if (data.dem.time_step > 0)
    while (first < last && time_of(data, data.spheres[first]) < -data.dem.time_step)
      ++first;
  while (first < last && read_points(data.spheres[first].path)->GetNumberOfPoints() == 0)
    ++first;
  count = std::min(count, last - first + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t file = count == 1 ? last : first + i * (last - first) / (count - 1);
    views.push_back({&data, file, caption_of(data, data.spheres[file])});
  }
  return views;
}

void draw_views(const std::vector<View>& views, const std::filesystem::path& file) {
  std::vector<Column> columns;
  for (const View& view : views)
    columns.push_back(column_of(view));
  share_bounds(columns);
  draw_columns(columns, colours_of(columns), any_flow(columns), file);
}

void draw_film(const std::vector<View>& views, const std::filesystem::path& file) {
  // A few of the pictures stand for all when scales are chosen: all at once would not fit into the memory.
  constexpr std::size_t samples = 8;
  std::vector<Column> sampled;
  for (std::size_t k = 0; k < std::min(samples, views.size()); ++k)
    sampled.push_back(
        column_of(views[k * (views.size() - 1) / std::max<std::size_t>(1, std::min(samples, views.size()) - 1)]));
  share_bounds(sampled);
  const Colours colours = colours_of(sampled);
  const Bounds bounds = sampled.front().bounds;
  const std::array<double, 6> seen = sampled.front().seen;
  const bool fluid = any_flow(sampled); // a film has pictures of one size, also from before the flow
  sampled.clear();
  std::vector<std::filesystem::path> pictures;
  for (const View& view : views) {
    Column column = column_of(view);
    column.bounds = bounds;
    column.seen = seen;
    choose_sight(column);
    pictures.push_back(file.string() + "." + std::to_string(pictures.size()));
    draw_columns({column}, colours, fluid, pictures.back());
  }
  constexpr double tenth = 0.1;
  write_film(pictures, tenth, file);
  for (const std::filesystem::path& picture : pictures)
    std::filesystem::remove(picture);
}

} // namespace eccentra::report
