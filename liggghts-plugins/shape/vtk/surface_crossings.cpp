// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edges against triangles, and coplanar triangles by separating lines.
#include "shape/vtk/surface_crossings.h"

#include "shape/vtk/poly_data.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkStaticCellLocator.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::shape {
namespace {

/// A triangle ready to be asked; its normal is a unit vector.
struct Facet {
  std::array<int, 3> vertex;
  std::array<Eigen::Vector3d, 3> corner;
  Eigen::Vector3d normal;
  double height(const Eigen::Vector3d& point) const { return normal.dot(point - corner[0]); }
  bool has(int v) const { return std::find(vertex.begin(), vertex.end(), v) != vertex.end(); }
  /// True if a point of its plane lies within it, or within `margin` of it.
  bool holds(const Eigen::Vector3d& point, double margin) const {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d edge = corner[(k + 1) % 3] - corner[k];
      if (normal.dot(edge.cross(point - corner[k])) < -margin * edge.norm())
        return false;
    }
    return true;
  }
};

/// Least distance from a vertex to the opposite edge.
double thickness(const std::array<Eigen::Vector3d, 3>& c) {
  const double longest = std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  return longest > 0 ? (c[1] - c[0]).cross(c[2] - c[0]).norm() / longest : 0;
}

/// Where an edge of `a` that ends at no vertex of `b` pierces b.
std::optional<Eigen::Vector3d> pierced(const Facet& a, const Facet& b, double tolerance) {
  for (int k = 0; k < 3; ++k) {
    const int n = (k + 1) % 3;
    if (b.has(a.vertex[k]) || b.has(a.vertex[n]))
      continue;
    const double from = b.height(a.corner[k]), to = b.height(a.corner[n]);
    if (std::min(std::abs(from), std::abs(to)) <= tolerance || (from > 0) == (to > 0))
      continue;
    const Eigen::Vector3d place = a.corner[k] + from / (from - to) * (a.corner[n] - a.corner[k]);
    if (b.holds(place, tolerance))
      return place;
  }
  return std::nullopt;
}

/// Where two triangles of one plane overlap by more than the tolerance in every direction.
std::optional<Eigen::Vector3d> covered(const Facet& a, const Facet& b, double tolerance) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(a.height(b.corner[k])) > tolerance || std::abs(b.height(a.corner[k])) > tolerance)
      return std::nullopt;
  for (const Facet* own : {&a, &b})
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d across = (own->corner[(k + 1) % 3] - own->corner[k]).cross(a.normal).normalized();
      double low[2], high[2];
      int which = 0;
      for (const Facet* f : {&a, &b}) {
        const double d0 = across.dot(f->corner[0]), d1 = across.dot(f->corner[1]), d2 = across.dot(f->corner[2]);
        low[which] = std::min({d0, d1, d2});
        high[which++] = std::max({d0, d1, d2});
      }
      if (std::min(high[0], high[1]) - std::max(low[0], low[1]) <= tolerance)
        return std::nullopt;
    }
  // A point of both: a corner of one in the other, else their middle.
  for (const auto& [f, g] : {std::pair{&a, &b}, {&b, &a}})
    for (int k = 0; k < 3; ++k)
      if (!g->has(f->vertex[k]) && g->holds(f->corner[k], tolerance))
        return f->corner[k];
  return (a.corner[0] + a.corner[1] + a.corner[2] + b.corner[0] + b.corner[1] + b.corner[2]) / 6;
}

} // namespace

std::optional<Crossing> find_crossing(const Surface& given, double given_tolerance) {
  const UnitFrame frame(given);
  const Surface surface = frame.to_unit(given);
  const double tolerance = given_tolerance / frame.size;
  std::vector<Facet> facets;
  std::vector<bool> thin;
  for (const auto& t : surface.triangles) {
    Facet f{t, {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]}, {}};
    thin.push_back(thickness(f.corner) <= tolerance);
    f.normal = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).normalized();
    facets.push_back(f);
  }
  const auto data = poly_data(surface);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->SetNumberOfCellsPerNode(1); // small bins: the list of those near is searched for each one that is added
  locator->BuildLocator();
  vtkNew<vtkIdList> near;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (thin[i])
      continue;
    const Facet& a = facets[i];
    std::array<double, 6> box{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({a.corner[0][axis], a.corner[1][axis], a.corner[2][axis]});
      box[2 * axis] = low - tolerance;
      box[2 * axis + 1] = high + tolerance;
    }
    locator->FindCellsWithinBounds(box.data(), near);
    for (vtkIdType n = 0; n < near->GetNumberOfIds(); ++n) {
      const auto j = static_cast<std::size_t>(near->GetId(n));
      if (j <= i || thin[j])
        continue;
      const Facet& b = facets[j];
      std::optional<Eigen::Vector3d> place = pierced(a, b, tolerance);
      if (!place)
        place = pierced(b, a, tolerance);
      if (!place)
        place = covered(a, b, tolerance);
      if (place)
        return Crossing{static_cast<int>(i), static_cast<int>(j), frame.middle + frame.size * *place};
    }
  }
  return std::nullopt;
}

} // namespace eccentra::shape
