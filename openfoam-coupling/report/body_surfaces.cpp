// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A surface is made once for each shape and copied to the place of each of its bodies.
#include "report/body_surfaces.h"

#include "shape/vtk/union_surface.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <Eigen/Geometry>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace eccentra::report {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Meridians of a sphere, from fine to coarse.
constexpr std::array<int, 4> kFineness = {20, 12, 8, 6};
constexpr double kMargin = 0.02; // so that no cracks show between the spheres of a body
constexpr const char* kCopied[] = {"body", "id", "type", "shape", "velocity", "v", "omega", "speed"};

/// The rows of one body: points with a radius that follow each other.
struct Body {
  vtkIdType first = 0;
  vtkIdType count = 1;
  int shape = -1; ///< -1: a plain sphere
  double radius = 0;
  Vector3d place{0, 0, 0}; ///< of its first sphere
  Quaterniond turn{1, 0, 0, 0};
};

Vector3d point_of(vtkPolyData& bodies, vtkIdType row) {
  Vector3d p;
  bodies.GetPoint(row, p.data());
  return p;
}

std::vector<Body> bodies_of(vtkPolyData& file) {
  vtkPointData& data = *file.GetPointData();
  vtkDataArray* radii = data.GetArray("radius");
  vtkDataArray* tags = data.GetArray("body");
  vtkDataArray* shapes = data.GetArray("shape");
  vtkDataArray* turns = data.GetArray("orientation");
  std::vector<Body> bodies;
  for (vtkIdType row = 0; radii != nullptr && row < file.GetNumberOfPoints(); ++row) {
    if (!(radii->GetTuple1(row) > 0))
      continue; // a corner of a rounded body's surface
    if (!bodies.empty() && bodies.back().shape >= 0 && bodies.back().first + bodies.back().count == row &&
        tags->GetTuple1(row) == tags->GetTuple1(bodies.back().first)) {
      ++bodies.back().count;
      continue;
    }
    Body body;
    body.first = row;
    body.radius = radii->GetTuple1(row);
    body.place = point_of(file, row);
    if (tags != nullptr && shapes != nullptr && turns != nullptr && shapes->GetTuple1(row) >= 0) {
      body.shape = static_cast<int>(shapes->GetTuple1(row));
      std::array<double, 4> q{};
      turns->GetTuple(row, q.data());
      body.turn = Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    }
    bodies.push_back(body);
  }
  return bodies;
}

} // namespace

/// A surface about the place of a body's first sphere, unturned. Named, since a class that other files know holds it.
struct Pattern {
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<std::array<vtkIdType, 3>> triangles;
};

namespace {

Pattern pattern_of(const std::vector<shape::Sphere>& spheres, int fineness) {
  Pattern pattern;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto part = shape::free_part(spheres, i, fineness, kMargin);
    const auto offset = static_cast<vtkIdType>(pattern.points.size());
    vtkDataArray* normals = part->GetPointData()->GetNormals();
    for (vtkIdType k = 0; k < part->GetNumberOfPoints(); ++k) {
      pattern.points.push_back(point_of(*part, k));
      Vector3d n;
      normals->GetTuple(k, n.data());
      pattern.normals.push_back(n);
    }
    const auto corners = vtkSmartPointer<vtkIdList>::New();
    vtkCellArray& cells = *part->GetPolys();
    for (cells.InitTraversal(); cells.GetNextCell(corners);)
      for (vtkIdType k = 2; k < corners->GetNumberOfIds(); ++k) // a clipped triangle may have four corners
        pattern.triangles.push_back(
            {offset + corners->GetId(0), offset + corners->GetId(k - 1), offset + corners->GetId(k)});
  }
  return pattern;
}

} // namespace

struct BodySurfaces::Patterns {
  int fineness = kFineness.front();
  std::map<std::pair<int, vtkIdType>, Pattern> made; ///< by the shape and its number of spheres

  const Pattern& of(vtkPolyData& file, const Body& body) {
    const auto [pattern, fresh] = made.try_emplace({body.shape, body.count});
    if (fresh) {
      std::vector<shape::Sphere> spheres;
      vtkDataArray& radii = *file.GetPointData()->GetArray("radius");
      if (body.shape < 0)
        spheres.push_back({Vector3d::Zero(), 1});
      for (vtkIdType k = 0; body.shape >= 0 && k < body.count; ++k)
        spheres.push_back(
            {body.turn.conjugate() * (point_of(file, body.first + k) - body.place), radii.GetTuple1(body.first + k)});
      pattern->second = pattern_of(spheres, fineness);
    }
    return pattern->second;
  }
};

BodySurfaces::BodySurfaces(vtkPolyData& bodies, std::size_t most) : patterns_(std::make_unique<Patterns>()) {
  const std::vector<Body> found = bodies_of(bodies);
  for (const int fineness : kFineness) {
    patterns_->fineness = fineness;
    patterns_->made.clear();
    std::size_t triangles = 0;
    for (const Body& body : found)
      triangles += patterns_->of(bodies, body).triangles.size();
    if (triangles <= most)
      break;
  }
}

BodySurfaces::~BodySurfaces() = default;

vtkSmartPointer<vtkPolyData> BodySurfaces::of(vtkPolyData& bodies, const Keep& keep) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto triangles = vtkSmartPointer<vtkCellArray>::New();
  const auto normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  std::vector<std::pair<vtkDataArray*, vtkSmartPointer<vtkDataArray>>> copied;
  for (const char* name : kCopied)
    if (vtkDataArray* array = bodies.GetPointData()->GetArray(name)) {
      copied.emplace_back(array, vtkSmartPointer<vtkDataArray>::Take(array->NewInstance()));
      copied.back().second->SetName(name == std::string("v") ? "velocity" : name);
      copied.back().second->SetNumberOfComponents(array->GetNumberOfComponents());
    }
  const auto add = [&](const Vector3d& place, const Vector3d& normal, vtkIdType row) {
    normals->InsertNextTuple(normal.data());
    for (const auto& [from, to] : copied)
      to->InsertNextTuple(row, from);
    return points->InsertNextPoint(place.data());
  };
  for (const Body& body : bodies_of(bodies)) {
    if (!keep({body.place.x(), body.place.y(), body.place.z()}))
      continue;
    const Pattern& pattern = patterns_->of(bodies, body);
    const double size = body.shape < 0 ? body.radius : 1;
    const vtkIdType first = points->GetNumberOfPoints();
    for (std::size_t k = 0; k < pattern.points.size(); ++k)
      add(body.place + size * (body.turn * pattern.points[k]), body.turn * pattern.normals[k], body.first);
    for (const auto& t : pattern.triangles) {
      const std::array<vtkIdType, 3> corners = {first + t[0], first + t[1], first + t[2]};
      triangles->InsertNextCell(3, corners.data());
    }
  }
  // Rounded bodies have their own triangles.
  vtkDataArray* tags = bodies.GetPointData()->GetArray("body");
  std::map<double, bool> kept; // by the number of the body
  const auto keeps = [&](vtkIdType row) {
    const Vector3d p = point_of(bodies, row);
    if (tags == nullptr)
      return keep({p.x(), p.y(), p.z()});
    const auto [at, fresh] = kept.try_emplace(tags->GetTuple1(row));
    if (fresh)
      at->second = keep({p.x(), p.y(), p.z()});
    return at->second;
  };
  vtkDataArray* own_normals = bodies.GetPointData()->GetArray("Normals");
  std::map<vtkIdType, vtkIdType> moved;
  const auto corners = vtkSmartPointer<vtkIdList>::New();
  vtkCellArray& polys = *bodies.GetPolys();
  for (polys.InitTraversal(); polys.GetNextCell(corners);) {
    if (!keeps(corners->GetId(0)))
      continue;
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
      const vtkIdType row = corners->GetId(k);
      const auto [at, fresh] = moved.try_emplace(row);
      if (fresh) {
        Vector3d normal = Vector3d::Zero();
        if (own_normals != nullptr)
          own_normals->GetTuple(row, normal.data());
        at->second = add(point_of(bodies, row), normal, row);
      }
      corners->SetId(k, at->second);
    }
    triangles->InsertNextCell(corners);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  surface->GetPointData()->SetNormals(normals);
  for (const auto& [from, to] : copied)
    surface->GetPointData()->AddArray(to);
  return surface;
}

} // namespace eccentra::report
