// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Convex hulls by qhull, thinned greedily.
#include "shape/convex_hull.h"

#include <libqhull_r/qhull_ra.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

namespace eccentra::shape {
namespace {

using Eigen::Vector3d;

/// Part of the size by which the coordinates of STL files, in single precision, miss a plane.
constexpr double coordinate_error = 1e-6;
/// Points that stand out less than this part of the size add nothing.
constexpr double negligible_height = 1e-6;

/// qhull's state, and a file that takes its messages.
class Qhull {
 public:
  Qhull() : messages_(std::tmpfile()) { qh_zero(&state_, messages_); }
  ~Qhull() {
    qh_freeqhull(&state_, !qh_ALL);
    int left = 0, pieces = 0;
    qh_memfreeshort(&state_, &left, &pieces);
    if (messages_)
      std::fclose(messages_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  bool run(std::vector<double>& coordinates, double tolerance) {
    char options[64];
    std::snprintf(options, sizeof options, "qhull C-%.3g", tolerance); // facets that nearly lie in one plane are one
    return qh_new_qhull(&state_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(), False, options,
                        nullptr, messages_) == 0;
  }
  qhT* state() { return &state_; }

 private:
  qhT state_{};
  std::FILE* messages_;
};

double size_of(const std::vector<Vector3d>& points) {
  Vector3d low = points[0], high = low;
  for (const Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

double height_over(const ConvexCore& core, const Vector3d& point) {
  double most = -std::numeric_limits<double>::max();
  for (const CoreFace& face : core.faces)
    most = std::max(most, face.normal.dot(point) - face.offset);
  return most;
}

/// Four points that span a volume.
std::vector<Vector3d> first_tetrahedron(const std::vector<Vector3d>& points) {
  const auto farthest = [&](auto distance) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vector3d& p, const Vector3d& q) { return distance(p) < distance(q); });
  };
  const Vector3d first = points[0];
  const Vector3d a = farthest([&](const Vector3d& p) { return (p - first).norm(); });
  const Vector3d b = farthest([&](const Vector3d& p) { return (p - a).norm(); });
  const Vector3d ab = (b - a).normalized();
  const Vector3d c = farthest([&](const Vector3d& p) { return (p - a).cross(ab).norm(); });
  const Vector3d n = ab.cross(c - a).normalized();
  const Vector3d d = farthest([&](const Vector3d& p) { return std::abs(n.dot(p - a)); });
  return {a, b, c, d};
}

} // namespace

ConvexCore convex_hull(const std::vector<Vector3d>& points) {
  constexpr const char* flat = "the points of a hull lie in one plane: they enclose no volume";
  if (points.size() < 4)
    throw std::invalid_argument(flat);
  std::vector<double> coordinates;
  for (const Vector3d& p : points)
    coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  Qhull qhull;
  if (!qhull.run(coordinates, coordinate_error * size_of(points)))
    throw std::invalid_argument(flat);
  qhT* qh = qhull.state(); // the name that qhull's macros want
  std::vector<std::vector<int>> faces;
  std::map<int, int> number; // point -> vertex
  facetT* facet;
  FORALLfacets {
    std::vector<int> corners;
    setT* around = qh_facet3vertex(qh, facet);
    vertexT *vertex, **vertexp;
    FOREACHvertex_(around) corners.push_back(qh_pointid(qh, vertex->point));
    qh_settempfree(qh, &around);
    faces.push_back(corners);
    for (const int k : corners)
      number.insert({k, 0});
  }
  std::vector<Vector3d> vertices;
  for (auto& [point, vertex] : number) {
    vertex = static_cast<int>(vertices.size());
    vertices.push_back(points[point]);
  }
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& v : vertices)
    middle += v / static_cast<double>(vertices.size());
  for (auto& corners : faces) {
    for (int& k : corners)
      k = number[k];
    const Vector3d normal =
        (vertices[corners[1]] - vertices[corners[0]]).cross(vertices[corners[2]] - vertices[corners[1]]);
    if (normal.dot(vertices[corners[0]] - middle) < 0)
      std::reverse(corners.begin(), corners.end());
  }
  return make_core(vertices, faces);
}

ThinnedHull thinned_hull(const std::vector<Vector3d>& points, int vertices) {
  if (points.size() < 4)
    return {convex_hull(points), 0};
  const double enough = negligible_height * size_of(points);
  std::vector<Vector3d> chosen = first_tetrahedron(points);
  for (;;) {
    ConvexCore core = convex_hull(chosen);
    double most = 0;
    const Vector3d* next = nullptr;
    for (const Vector3d& p : points) {
      const double height = height_over(core, p);
      if (height > most) {
        most = height;
        next = &p;
      }
    }
    if (most <= enough || static_cast<int>(core.vertices.size()) >= vertices)
      return {std::move(core), most};
    chosen.push_back(*next);
  }
}

} // namespace eccentra::shape
