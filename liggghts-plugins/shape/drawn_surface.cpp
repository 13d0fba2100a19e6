// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Faces, strips along edges and patches about vertices; bodies of revolution by their profile.
#include "shape/drawn_surface.h"

#include "base/linear_algebra.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace eccentra::shape {
namespace {

using Eigen::Vector3d;

/// Between two unit vectors that are not opposite.
Vector3d between(const Vector3d& a, const Vector3d& b, double part) {
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  if (angle < 1e-12)
    return a;
  return ((std::sin((1 - part) * angle) * a + std::sin(part * angle) * b) / std::sin(angle)).normalized();
}

class Builder {
 public:
  Builder(const RoundedHull& hull, int steps) : hull_(hull), steps_(std::max(1, steps)) {}
  TriangleSurface surface;

  void polyhedron(const ConvexCore& core) {
    for (const CoreFace& face : core.faces) {
      std::vector<int> corner;
      for (const int k : face.corners)
        corner.push_back(point(core.vertices[k], face.normal, k));
      for (std::size_t k = 2; k < corner.size(); ++k)
        surface.triangles.push_back({corner[0], corner[k - 1], corner[k]});
    }
    // From the left face's normal to the right's, about the edge; the same directions bound the patches at its ends.
    std::vector<std::vector<std::vector<Vector3d>>> arcs(core.vertices.size());
    for (const CoreEdge& edge : core.edges) {
      const Vector3d along = (core.vertices[edge.to] - core.vertices[edge.from]).normalized(),
                     left = core.faces[edge.left].normal;
      const double turn = core.turn(edge);
      std::vector<Vector3d> directions;
      for (int k = 0; k <= steps_; ++k)
        directions.push_back(Eigen::AngleAxisd(turn * k / steps_, along) * left);
      for (int k = 0; k < steps_; ++k)
        quad(point(core.vertices[edge.from], directions[k], edge.from),
             point(core.vertices[edge.from], directions[k + 1], edge.from),
             point(core.vertices[edge.to], directions[k + 1], edge.to),
             point(core.vertices[edge.to], directions[k], edge.to));
      arcs[edge.from].emplace_back(directions.rbegin(), directions.rend());
      arcs[edge.to].push_back(std::move(directions));
    }
    for (std::size_t v = 0; v < arcs.size(); ++v)
      patch(core.vertices[v], arcs[v], static_cast<int>(v));
  }

  /// Circles about z, from the top to the bottom; `half_height` of the profile's straight part, `rim` its distance from
  /// the axis.
  void revolution(double rim, double half_height, int per_rim) {
    const int around = 4 * std::max(6, 2 * steps_);
    const double r = hull_.radius();
    std::vector<std::vector<int>> circles;
    const auto circle = [&](double distance, double height, double elevation) {
      const double out = std::cos(elevation), up = std::sin(elevation);
      std::vector<int> row;
      for (int k = 0; k < around; ++k) {
        const double angle = 2 * M_PI * k / around;
        const Vector3d radial(std::cos(angle), std::sin(angle), 0);
        const int nearest = per_rim > 0 ? static_cast<int>(std::lround(angle * per_rim / (2 * M_PI))) % per_rim : 0;
        const int below = height < 0 && half_height > 0 ? std::max(1, per_rim) : 0;
        surface.points.push_back({distance * radial + Vector3d(0, 0, height) + r * (out * radial + Vector3d(0, 0, up)),
                                  out * radial + Vector3d(0, 0, up), below + nearest});
        row.push_back(static_cast<int>(surface.points.size()) - 1);
      }
      circles.push_back(std::move(row));
    };
    circle(0, half_height, M_PI / 2);
    if (rim > 0)
      circle(rim, half_height, M_PI / 2);
    const int quarter = 2 * steps_;
    for (int k = 1; k <= quarter; ++k)
      circle(rim, half_height, M_PI / 2 * (1 - static_cast<double>(k) / quarter));
    for (int k = half_height > 0 ? 0 : 1; k < quarter; ++k)
      circle(rim, -half_height, -M_PI / 2 * k / quarter);
    if (rim > 0)
      circle(rim, -half_height, -M_PI / 2);
    circle(0, -half_height, -M_PI / 2);
    for (std::size_t row = 1; row < circles.size(); ++row)
      for (int k = 0; k < around; ++k) {
        const int next = (k + 1) % around;
        const bool first = row == 1, last = row + 1 == circles.size(); // about the poles triangles have no width
        if (!first)
          surface.triangles.push_back({circles[row - 1][k], circles[row][k], circles[row - 1][next]});
        if (!last)
          surface.triangles.push_back({circles[row - 1][next], circles[row][k], circles[row][next]});
      }
  }

  /// All that has been made turns so that z becomes `axis`.
  void turn_to(const Vector3d& axis) {
    const Eigen::Quaterniond turn = base::rotation_between(Vector3d::UnitZ(), axis);
    for (SurfacePoint& p : surface.points) {
      p.position = turn * p.position;
      p.normal = turn * p.normal;
    }
  }

 private:
  int point(const Vector3d& of_core, const Vector3d& normal, int vertex) {
    surface.points.push_back({of_core + hull_.radius() * normal, normal, vertex});
    return static_cast<int>(surface.points.size()) - 1;
  }
  void quad(int a, int b, int c, int d) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  }
  /// The part of a ball about a vertex that arcs of directions bound, counter-clockwise: rows from its middle out.
  void patch(const Vector3d& vertex, const std::vector<std::vector<Vector3d>>& arcs, int number) {
    Vector3d middle = Vector3d::Zero();
    for (const auto& arc : arcs)
      for (std::size_t k = 1; k < arc.size(); ++k)
        middle += (arc[k - 1] + arc[k]) * (arc[k - 1] - arc[k]).norm();
    middle.normalize();
    for (const auto& arc : arcs) {
      std::vector<int> inner(arc.size(), point(vertex, middle, number));
      for (int row = 1; row <= steps_; ++row) {
        std::vector<int> outer;
        for (const Vector3d& direction : arc)
          outer.push_back(point(vertex, between(middle, direction, static_cast<double>(row) / steps_), number));
        for (std::size_t k = 1; k < arc.size(); ++k) {
          surface.triangles.push_back({inner[k - 1], outer[k - 1], outer[k]});
          if (row > 1)
            surface.triangles.push_back({inner[k - 1], outer[k], inner[k]});
        }
        inner = std::move(outer);
      }
    }
  }

  const RoundedHull& hull_;
  int steps_;
};

} // namespace

TriangleSurface drawn_surface(const RoundedHull& hull, int steps) {
  Builder build(hull, steps);
  if (const DiskCore* disk = hull.disk()) {
    build.revolution(disk->radius, disk->half_height, points_on_rim);
  } else {
    const ConvexCore& core = *hull.polyhedron();
    if (core.dimension() >= 2) {
      build.polyhedron(core);
    } else {
      const Vector3d along = core.dimension() == 1 ? Vector3d(core.vertices[0] - core.vertices[1]) : Vector3d::Zero();
      build.revolution(0, along.norm() / 2, 0);
      if (core.dimension() == 1)
        build.turn_to(along.normalized());
    }
  }
  return std::move(build.surface);
}

} // namespace eccentra::shape
