// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// STL through VTK's reader, sign and distance through VTK's implicit distance, integrals over the triangles by
// ourselves.
#include "shape/vtk/solid.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

namespace eccentra::shape {
namespace {

using Triangles = std::vector<std::array<int, 3>>;
using Vertices = std::vector<Eigen::Vector3d>;

/// Vertices closer than this part of the size are one: STL repeats each vertex, with the digits of a float.
constexpr double merge_tolerance = 1e-6;

/// How the triangles' edges fit: each must be walked once either way round.
struct EdgeCheck {
  int open = 0;     ///< edges with a triangle on one side only, or with more than two
  int reversed = 0; ///< edges that both neighbours walk the same way
};

EdgeCheck check_edges(const Triangles& triangles) {
  std::map<std::pair<int, int>, std::pair<int, int>> walks; // low, high vertex -> times up, times down
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      auto& count = walks[{std::min(a, b), std::max(a, b)}];
      ++(a < b ? count.first : count.second);
    }
  EdgeCheck check;
  for (const auto& [edge, count] : walks) {
    if (count.first + count.second == 1 || (count.first + count.second) % 2)
      ++check.open;
    else if (count.first != count.second)
      ++check.reversed;
  }
  return check;
}

/// Switches VTK's own messages off while it lives: ours say what is wrong.
class QuietVtk {
 public:
  QuietVtk() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before_); }

 private:
  int before_;
};

void take(vtkPolyData* data, Vertices& vertices, Triangles& triangles) {
  vertices.clear();
  triangles.clear();
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k) {
    std::array<double, 3> p;
    data->GetPoint(k, p.data());
    vertices.emplace_back(p[0], p[1], p[2]);
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray* polygons = data->GetPolys();
  polygons->InitTraversal();
  while (polygons->GetNextCell(corners)) {
    const std::array<int, 3> t{static_cast<int>(corners->GetId(0)), static_cast<int>(corners->GetId(1)),
                               static_cast<int>(corners->GetId(2))};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
      triangles.push_back(t);
  }
}

vtkSmartPointer<vtkPolyData> to_vtk(const Vertices& vertices, const Triangles& triangles) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& v : vertices)
    points->InsertNextPoint(v.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : triangles) {
    const std::array<vtkIdType, 3> ids{t[0], t[1], t[2]};
    cells->InsertNextCell(3, ids.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

/// Sums over the tetrahedra that the triangles span with `origin`: exact for a closed surface.
MassProperties integrate(const Vertices& vertices, const Triangles& triangles, const Eigen::Vector3d& origin) {
  double volume = 0, surface = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& t : triangles) {
    const Eigen::Vector3d a = vertices[t[0]] - origin, b = vertices[t[1]] - origin, c = vertices[t[2]] - origin;
    const Eigen::Vector3d sum = a + b + c;
    const double tetrahedron = a.cross(b).dot(c) / 6;
    volume += tetrahedron;
    surface += (b - a).cross(c - a).norm() / 2;
    first += tetrahedron * sum / 4;
    second += tetrahedron / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  MassProperties p;
  p.volume = volume;
  p.surface = surface;
  const Eigen::Vector3d centre = first / volume;
  second = (second / volume - centre * centre.transpose()).eval();
  p.centre = origin + centre;
  p.inertia_per_mass = second.trace() * Eigen::Matrix3d::Identity() - second;
  return p;
}

} // namespace

struct Solid::DistanceField {
  vtkNew<vtkImplicitPolyDataDistance> function;
};

Solid::Solid(const std::string& path, double scale) : path_(path) {
  const std::string who = "STL file '" + path + "'";
  if (!std::ifstream(path))
    throw std::invalid_argument("cannot read the " + who + ": check the name and the folder");
  const QuietVtk quiet;
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(reader->GetOutput());
  clean->SetTolerance(merge_tolerance);
  clean->Update();
  take(clean->GetOutput(), vertices_, triangles_);
  if (triangles_.empty())
    throw std::invalid_argument(who + " holds no triangles: is it ASCII or binary STL?");
  for (Eigen::Vector3d& v : vertices_) {
    v *= scale;
    if (!v.allFinite())
      throw std::invalid_argument(who + " has a coordinate that is not a finite number");
  }
  EdgeCheck check = check_edges(triangles_);
  if (check.open > 0)
    throw std::invalid_argument(who + " is not a closed surface: " + std::to_string(check.open) +
                                " edges lack a neighbour; close the holes first");
  if (check.reversed > 0) { // let VTK turn neighbours the same way
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(to_vtk(vertices_, triangles_));
    normals->ConsistencyOn();
    normals->SplittingOff();
    normals->ComputeCellNormalsOn();
    normals->Update();
    take(normals->GetOutput(), vertices_, triangles_);
    check = check_edges(triangles_);
    if (check.open > 0 || check.reversed > 0)
      throw std::invalid_argument(who + " has no inside: its triangles cannot be turned the same way round");
  }
  low_ = high_ = vertices_[triangles_[0][0]];
  for (const Eigen::Vector3d& v : vertices_) {
    low_ = low_.cwiseMin(v);
    high_ = high_.cwiseMax(v);
  }
  const Eigen::Vector3d middle = (low_ + high_) / 2;
  properties_ = integrate(vertices_, triangles_, middle);
  if (properties_.volume < 0) {
    for (auto& t : triangles_)
      std::swap(t[1], t[2]);
    properties_ = integrate(vertices_, triangles_, middle);
  }
  const double box = (high_ - low_).prod(), min_part = 1e-9;
  if (!(properties_.volume > min_part * box))
    throw std::invalid_argument(who + " encloses no volume");
  field_ = std::make_shared<DistanceField>();
  field_->function->SetInput(to_vtk(vertices_, triangles_));
}

double Solid::distance(const Eigen::Vector3d& point) const {
  std::array<double, 3> x{point.x(), point.y(), point.z()};
  return field_->function->EvaluateFunction(x.data());
}

} // namespace eccentra::shape
