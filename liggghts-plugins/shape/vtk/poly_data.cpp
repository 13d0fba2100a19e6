// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Copies points and triangles one by one.
#include "shape/vtk/poly_data.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <Eigen/Geometry>

namespace eccentra::shape {

vtkSmartPointer<vtkPolyData> poly_data(const Surface& surface) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& v : surface.vertices)
    points->InsertNextPoint(v.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : surface.triangles) {
    const std::array<vtkIdType, 3> ids{t[0], t[1], t[2]};
    cells->InsertNextCell(3, ids.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

UnitFrame::UnitFrame(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const auto& t : surface.triangles)
    for (const int v : t)
      box.extend(surface.vertices[v]);
  middle = box.center();
  size = box.diagonal().norm();
}

Surface UnitFrame::to_unit(const Surface& surface) const {
  Surface unit = surface;
  for (Eigen::Vector3d& v : unit.vertices)
    v = to_unit(v);
  return unit;
}

Surface surface_of(vtkPolyData* data) {
  Surface surface;
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k) {
    std::array<double, 3> p{};
    data->GetPoint(k, p.data());
    surface.vertices.emplace_back(p[0], p[1], p[2]);
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray* polygons = data->GetPolys();
  polygons->InitTraversal();
  while (polygons->GetNextCell(corners))
    if (corners->GetNumberOfIds() == 3)
      surface.triangles.push_back({static_cast<int>(corners->GetId(0)), static_cast<int>(corners->GetId(1)),
                                   static_cast<int>(corners->GetId(2))});
  return surface;
}

} // namespace eccentra::shape
