// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fits planes and cylinders to faces.
#include "link/wall_pieces.h"

#include "base/linear_algebra.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace eccentra::link {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Faces that meet at less than this belong together [degrees]: those of an uneven octagon (55), not those of a box.
constexpr double kEdge = 60.0;
/// Points this close, in parts of the whole surface, are one.
constexpr double kSamePoint = 1e-7;
/// Corners of a plane may leave it by this part of its extent.
constexpr double kFlat = 1e-3;
/// Mean square of the normals' component along the axis of a cylinder, and the least across it.
constexpr double kAlong = 1e-3, kAcross = 1e-2;
/// Relative spread of the radii of a cylinder: that of an octagon is 0.076, with faces of 55 degrees 0.113.
constexpr double kRound = 0.12;
/// A wider cylinder is a bent plane.
constexpr double kWidest = 20.0;
/// Height of an arc over its chord, as part of chord times angle between neighbours: 1/8, and as much again for
/// neighbours of unequal length.
constexpr double kArc = 0.25;

double bounding_diagonal(const std::vector<Facet>& facets, const std::vector<int>& which) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const int f : which)
    for (const Vector3d& x : facets[f].corners) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  return which.empty() ? 0 : (high - low).norm();
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

double angle_between(const Facet& a, const Facet& b) {
  return std::acos(std::min(1.0, std::abs(a.normal.dot(b.normal))));
}

using Edge = std::pair<int, int>;

/// Pairs of faces that share an edge.
std::vector<Edge> neighbours(const std::vector<Facet>& facets, double extent) {
  std::map<std::array<std::int64_t, 3>, int> numbers;
  std::map<Edge, int> first;
  std::vector<Edge> pairs;
  const double grid = std::max(kSamePoint * extent, std::numeric_limits<double>::min());
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    std::vector<int> ids;
    for (const Vector3d& x : facets[f].corners) {
      const std::array<std::int64_t, 3> key{std::llround(x[0] / grid), std::llround(x[1] / grid),
                                            std::llround(x[2] / grid)};
      ids.push_back(numbers.try_emplace(key, static_cast<int>(numbers.size())).first->second);
    }
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const Edge edge = std::minmax(ids[k], ids[(k + 1) % ids.size()]);
      const auto [at, is_new] = first.try_emplace(edge, f);
      if (!is_new)
        pairs.push_back({at->second, f});
    }
  }
  return pairs;
}

bool fit_plane(const std::vector<Facet>& facets, SurfacePiece& piece) {
  Vector3d mean = Vector3d::Zero();
  double count = 0;
  for (const int f : piece.facets)
    for (const Vector3d& x : facets[f].corners) {
      mean += x;
      ++count;
    }
  mean /= count;
  Matrix3d spread = Matrix3d::Zero();
  for (const int f : piece.facets)
    for (const Vector3d& x : facets[f].corners)
      spread += (x - mean) * (x - mean).transpose();
  const base::SymmetricModes axes = base::symmetric_modes(spread);
  piece.point = mean;
  piece.direction = axes.vectors.col(0);
  for (const int f : piece.facets)
    for (const Vector3d& x : facets[f].corners)
      if (std::abs((x - mean).dot(piece.direction)) > kFlat * piece.extent)
        return false;
  return true;
}

/// Centre and radius of the circle through points of a plane, by linear least squares.
std::pair<Eigen::Vector2d, double> fit_circle(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points)
    mean += p / double(points.size());
  // |p|^2 = 2 c . p + (R^2 - |c|^2), about the mean for the sake of round-off.
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (const Eigen::Vector2d& p : points) {
    const Vector3d row(p[0] - mean[0], p[1] - mean[1], 1);
    normal += row * row.transpose();
    right += row * (p - mean).squaredNorm();
  }
  const Vector3d solved = normal.ldlt().solve(right);
  const Eigen::Vector2d centre = 0.5 * solved.head<2>();
  return {centre + mean, std::sqrt(std::max(0.0, solved[2] + centre.squaredNorm()))};
}

bool fit_cylinder(const std::vector<Facet>& facets, SurfacePiece& piece) {
  Matrix3d normals = Matrix3d::Zero();
  double area = 0;
  for (const int f : piece.facets) {
    normals += facets[f].area * facets[f].normal * facets[f].normal.transpose();
    area += facets[f].area;
  }
  if (!(area > 0))
    return false;
  const base::SymmetricModes axes = base::symmetric_modes(normals / area);
  if (axes.values[0] > kAlong || axes.values[1] < kAcross)
    return false;
  Vector3d axis = axes.vectors.col(0);
  if (axis.sum() < 0)
    axis = -axis;
  const Vector3d u = axes.vectors.col(1), v = axis.cross(u);
  std::vector<Eigen::Vector2d> corners;
  for (const int f : piece.facets)
    for (const Vector3d& x : facets[f].corners)
      corners.emplace_back(x.dot(u), x.dot(v));
  const auto [centre, radius] = fit_circle(corners);
  if (!(radius > 0) || radius > kWidest * piece.extent)
    return false;
  const Vector3d point = centre[0] * u + centre[1] * v;
  const auto from_axis = [&](const Vector3d& x) { return (x - point - (x - point).dot(axis) * axis).norm(); };
  piece.low = std::numeric_limits<double>::max();
  piece.begin = piece.low;
  piece.end = piece.high = -piece.low;
  for (const int f : piece.facets) {
    const std::vector<Vector3d>& c = facets[f].corners;
    piece.low = std::min(piece.low, from_axis(facets[f].centre));
    for (std::size_t k = 0; k < c.size(); ++k) {
      const double r = from_axis(c[k]), along = (c[k] - point).dot(axis);
      piece.high = std::max(piece.high, r);
      piece.low = std::min({piece.low, r, from_axis(0.5 * (c[k] + c[(k + 1) % c.size()]))});
      piece.begin = std::min(piece.begin, along);
      piece.end = std::max(piece.end, along);
    }
  }
  piece.point = point;
  piece.direction = axis;
  return piece.high - piece.low <= kRound * radius;
}

} // namespace

Facet::Facet(std::vector<Vector3d> all) : corners(std::move(all)), area(0) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& x : corners)
    mean += x / double(corners.size());
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  double weight = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector3d &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const Vector3d part = 0.5 * (a - mean).cross(b - mean);
    sum += part;
    moment += part.norm() * (a + b + mean) / 3;
    weight += part.norm();
  }
  centre = weight > 0 ? Vector3d(moment / weight) : mean;
  area = sum.norm();
  normal = area > 0 ? Vector3d(sum / area) : Vector3d::Zero();
}

std::vector<SurfacePiece> pieces_of(const std::vector<Facet>& facets) {
  std::vector<int> all(facets.size());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<Edge> pairs = neighbours(facets, bounding_diagonal(facets, all));
  const double edge = kEdge * std::acos(-1.0) / 180;
  std::vector<int> parent = all;
  for (const auto& [a, b] : pairs)
    if (angle_between(facets[a], facets[b]) < edge)
      parent[root_of(parent, a)] = root_of(parent, b);
  std::vector<SurfacePiece> pieces;
  std::unordered_map<int, int> piece_of_root;
  for (const int f : all) {
    const auto [at, is_new] = piece_of_root.try_emplace(root_of(parent, f), static_cast<int>(pieces.size()));
    if (is_new)
      pieces.emplace_back();
    pieces[at->second].facets.push_back(f);
  }
  for (const auto& [a, b] : pairs) {
    const int root = root_of(parent, a);
    if (root != root_of(parent, b))
      continue;
    SurfacePiece& piece = pieces[piece_of_root[root]];
    piece.chord = std::max(piece.chord,
                           kArc * angle_between(facets[a], facets[b]) * (facets[a].centre - facets[b].centre).norm());
  }
  for (SurfacePiece& piece : pieces) {
    piece.extent = bounding_diagonal(facets, piece.facets);
    if (fit_plane(facets, piece)) {
      piece.form = SurfaceForm::plane;
      piece.chord = 0;
    } else if (fit_cylinder(facets, piece)) {
      piece.form = SurfaceForm::cylinder;
      piece.chord = piece.high - piece.low;
    }
  }
  return pieces;
}

} // namespace eccentra::link
