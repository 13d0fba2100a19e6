// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sphere meshes, each clipped where another sphere covers it; rounded bodies piece by piece.
#include "shape/vtk/union_surface.h"

#include "shape/drawn_surface.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSphereSource.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace eccentra::shape {

namespace {

/// Triangles with sides above `longest` [m] in halves: delta_e varies over a flat face.
TriangleSurface refined(TriangleSurface surface, double longest) {
  for (std::size_t n = 0; n < surface.triangles.size();) {
    const std::array<int, 3> t = surface.triangles[n];
    int side = 0;
    double length = 0;
    for (int k = 0; k < 3; ++k)
      if (const double l = (surface.points[t[(k + 1) % 3]].position - surface.points[t[k]].position).norm();
          l > length) {
        length = l;
        side = k;
      }
    if (length <= longest) {
      ++n;
      continue;
    }
    const int from = t[side], to = t[(side + 1) % 3], tip = t[(side + 2) % 3];
    const SurfacePoint a = surface.points[from], b = surface.points[to];
    const int middle = static_cast<int>(surface.points.size());
    surface.points.push_back({(a.position + b.position) / 2, (a.normal + b.normal).normalized(), a.vertex});
    surface.triangles[n] = {from, middle, tip};
    surface.triangles.push_back({middle, to, tip});
  }
  return surface;
}

vtkSmartPointer<vtkPolyData> surface_of_hull(const RoundedHull& hull, const Eigen::Vector3d& offset, int fineness) {
  const double unit = hull.equivalent_radius();
  const TriangleSurface surface = refined(drawn_surface(hull, std::max(2, fineness / 8)), 8 * unit / fineness);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> normal, eccentricity, number;
  normal->SetName("Normals");
  normal->SetNumberOfComponents(3);
  eccentricity->SetName(eccentricity_array);
  number->SetName(sphere_array);
  for (const SurfacePoint& p : surface.points) {
    points->InsertNextPoint((p.position + offset).eval().data());
    normal->InsertNextTuple3(p.normal.x(), p.normal.y(), p.normal.z());
    eccentricity->InsertNextValue(static_cast<float>(p.position.cross(p.normal).norm() / unit));
    number->InsertNextValue(static_cast<float>(p.vertex));
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& triangle : surface.triangles) {
    const vtkIdType corners[3] = {triangle[0], triangle[1], triangle[2]};
    triangles->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  data->GetPointData()->SetNormals(normal);
  data->GetPointData()->AddArray(number);
  data->GetPointData()->SetScalars(eccentricity);
  return data;
}

} // namespace

vtkSmartPointer<vtkPolyData> free_part(const std::vector<Sphere>& spheres, std::size_t index, int fineness,
                                       double margin) {
  const Sphere& self = spheres.at(index);
  std::vector<Sphere> neighbours;
  for (const Sphere& other : spheres)
    if (&other != &self && (other.centre - self.centre).norm() < other.radius + self.radius)
      neighbours.push_back(other);
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1);
  source->SetThetaResolution(fineness);
  source->SetPhiResolution(fineness / 2 + 1);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(source->GetOutput());
  vtkNew<vtkDoubleArray> clearance; // from the nearest other sphere: negative where covered
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k) {
    Eigen::Vector3d n;
    mesh->GetPoint(k, n.data());
    const Eigen::Vector3d point = self.centre + self.radius * n;
    double nearest = std::numeric_limits<double>::max();
    for (const Sphere& other : neighbours)
      nearest = std::min(nearest, (point - other.centre).norm() - other.radius);
    clearance->InsertNextValue(nearest);
    mesh->GetPoints()->SetPoint(k, point.data());
  }
  clearance->SetName("clearance");
  mesh->GetPointData()->SetScalars(clearance);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(mesh);
  clip->SetValue(-margin * self.radius);
  clip->Update();
  auto free = vtkSmartPointer<vtkPolyData>::New();
  free->DeepCopy(clip->GetOutput());
  vtkNew<vtkFloatArray> normal;
  normal->SetName("Normals");
  normal->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < free->GetNumberOfPoints(); ++k) {
    Eigen::Vector3d point;
    free->GetPoint(k, point.data());
    const Eigen::Vector3d n = (point - self.centre).normalized();
    normal->InsertNextTuple3(n.x(), n.y(), n.z());
  }
  free->GetPointData()->Initialize();
  free->GetPointData()->SetNormals(normal);
  return free;
}

vtkSmartPointer<vtkPolyData> union_surface(const ClusterShape& shape, const Eigen::Vector3d& offset, int fineness,
                                           double margin) {
  if (shape.hull())
    return surface_of_hull(*shape.hull(), offset, fineness);
  const double unit = shape.equivalent_radius();
  vtkNew<vtkAppendPolyData> whole;
  for (const int index : shape.surface_spheres()) {
    const Sphere& self = shape.spheres()[index];
    const vtkSmartPointer<vtkPolyData> free = free_part(shape.spheres(), index, fineness, margin);
    vtkNew<vtkFloatArray> eccentricity, number;
    eccentricity->SetName(eccentricity_array);
    number->SetName(sphere_array);
    for (vtkIdType k = 0; k < free->GetNumberOfPoints(); ++k) {
      Eigen::Vector3d point;
      free->GetPoint(k, point.data());
      const Eigen::Vector3d n = (point - self.centre).normalized(), moved = point + offset;
      eccentricity->InsertNextValue(static_cast<float>(self.centre.cross(n).norm() / unit));
      number->InsertNextValue(static_cast<float>(index));
      free->GetPoints()->SetPoint(k, moved.data());
    }
    free->GetPointData()->AddArray(number);
    free->GetPointData()->SetScalars(eccentricity);
    whole->AddInputData(free);
  }
  whole->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  whole->Update();
  return whole->GetOutput();
}

} // namespace eccentra::shape
