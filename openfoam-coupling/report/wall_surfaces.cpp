// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements wall_surfaces.h.
#include "report/wall_surfaces.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkSTLReader.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eccentra::report {
namespace {

using Eigen::Vector3d;

constexpr int kAround = 96;        // sides of a cylinder
constexpr double kBeyond = 1e-3;   // part of the box by which it is enlarged: a plane on a side of it counts
constexpr double kParallel = 1e-9; // of an edge and a plane

Vector3d vector_of(const Vector& v) {
  return {v[0], v[1], v[2]};
}

/// Two unit vectors across a third one.
std::array<Vector3d, 2> across(const Vector3d& axis) {
  const Vector3d u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

std::array<Vector3d, 8> corners_of(const std::array<double, 6>& box) {
  std::array<Vector3d, 8> corners;
  for (unsigned k = 0; k < 8; ++k)
    corners[k] = {box[k & 1U], box[2 + ((k >> 1U) & 1U)], box[4 + (k >> 2U)]};
  return corners;
}

vtkSmartPointer<vtkPolyData> polygon(const std::vector<Vector3d>& corners) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->InsertNextCell(static_cast<int>(corners.size()));
  for (const Vector3d& corner : corners)
    cells->InsertCellPoint(points->InsertNextPoint(corner.data()));
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

/// The polygon in which the plane cuts the box; null if it does not.
vtkSmartPointer<vtkPolyData> plane_in(const Wall& wall, std::array<double, 6> box) {
  for (std::size_t d = 0; d < 3; ++d) {
    const double more = kBeyond * (box[2 * d + 1] - box[2 * d]);
    box[2 * d] -= more;
    box[2 * d + 1] += more;
  }
  const Vector3d normal = vector_of(wall.axis), origin = vector_of(wall.point);
  const auto corners = corners_of(box);
  std::vector<Vector3d> cut;
  for (unsigned from = 0; from < 8; ++from)
    for (const unsigned side : {1U, 2U, 4U}) {
      if ((from & side) != 0)
        continue;
      const Vector3d a = corners[from], edge = corners[from | side] - a;
      const double rise = edge.dot(normal), part = (origin - a).dot(normal) / rise;
      if (std::abs(rise) > kParallel * edge.norm() && part >= 0 && part <= 1)
        cut.emplace_back(a + part * edge);
    }
  constexpr std::size_t triangle = 3;
  if (cut.size() < triangle)
    return nullptr;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : cut)
    middle += p / static_cast<double>(cut.size());
  const auto [u, v] = across(normal);
  const auto angle = [&, u = u, v = v](const Vector3d& p) {
    return std::atan2((p - middle).dot(v), (p - middle).dot(u));
  };
  std::sort(cut.begin(), cut.end(), [&](const Vector3d& a, const Vector3d& b) { return angle(a) < angle(b); });
  return polygon(cut);
}

vtkSmartPointer<vtkPolyData> cylinder_in(const Wall& wall, const std::array<double, 6>& box) {
  const Vector3d axis = vector_of(wall.axis), origin = vector_of(wall.point);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Vector3d& corner : corners_of(box)) {
    low = std::min(low, (corner - origin).dot(axis));
    high = std::max(high, (corner - origin).dot(axis));
  }
  const auto [u, v] = across(axis);
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (int k = 0; k < kAround; ++k) {
    const double angle = 2 * M_PI * k / kAround;
    const Vector3d rim = origin + wall.radius * (std::cos(angle) * u + std::sin(angle) * v);
    for (const double end : {low, high})
      points->InsertNextPoint((rim + end * axis).eval().data());
    const int next = (k + 1) % kAround;
    const std::array<vtkIdType, 4> corners = {2 * k, 2 * next, 2 * next + 1, 2 * k + 1};
    cells->InsertNextCell(4, corners.data());
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

} // namespace

vtkSmartPointer<vtkPolyData> mesh_of_wall(const Case& data, const WallMesh& mesh) {
  const std::filesystem::path file = mesh.file.is_absolute() ? mesh.file : data.folder / mesh.file;
  if (!std::filesystem::is_regular_file(file))
    throw std::runtime_error(file.string() +
                             ": cannot be read: log.liggghts names it as the mesh of a wall; keep it in "
                             "the case's folder");
  const auto reader = vtkSmartPointer<vtkSTLReader>::New();
  reader->SetFileName(file.c_str());
  const auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->PostMultiply();
  transform->Scale(mesh.scale, mesh.scale, mesh.scale);
  transform->Translate(mesh.move.data());
  const auto moved = vtkSmartPointer<vtkTransformPolyDataFilter>::New();
  moved->SetTransform(transform);
  moved->SetInputConnection(reader->GetOutputPort());
  moved->Update();
  return moved->GetOutput();
}

std::vector<WallSurface> wall_surfaces(const Case& data, const std::array<double, 6>& box) {
  std::vector<WallSurface> surfaces;
  for (const auto& [id, wall] : data.dem.walls)
    if (auto surface = wall.kind == Wall::Kind::plane ? plane_in(wall, box) : cylinder_in(wall, box))
      surfaces.push_back({id, surface});
  for (const WallMesh& mesh : data.dem.meshes)
    surfaces.push_back({mesh.id, mesh_of_wall(data, mesh)});
  return surfaces;
}

} // namespace eccentra::report
