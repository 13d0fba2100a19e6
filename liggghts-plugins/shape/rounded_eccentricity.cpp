// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// delta_e = |c x n|, c the point of the core below the contact, n the normal.
#include "shape/rounded_eccentricity.h"

#include "shape/over_directions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace eccentra::shape {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr int surface_points = 400000;

/// Point `index` of a sequence that fills the unit square evenly.
Eigen::Vector2d even_point(int index) {
  constexpr double root = 1.32471795724474602596; // of x^3 = x + 1
  const double u = 0.5 + (index + 1) / root, v = 0.5 + (index + 1) / (root * root);
  return {u - std::floor(u), v - std::floor(v)};
}

/// Samples of delta_e over the surface, each for the same area.
class SurfaceSamples {
 public:
  explicit SurfaceSamples(const RoundedHull& hull) : hull_(hull), per_area_(surface_points / hull.surface()) {
    if (const ConvexCore* core = hull.polyhedron())
      add(*core);
    else
      add(*hull.disk());
    // Corners: a ball's worth of normals, each at the point of the core that it belongs to.
    if (hull.polyhedron()) {
      const int count = points(4 * M_PI * hull.radius() * hull.radius());
      for (int k = 0; k < count; ++k) {
        const Vector3d n = fibonacci_direction(k, count);
        note(hull.support(n), n);
      }
    }
  }
  std::vector<double> samples;

 private:
  int points(double area) const { return static_cast<int>(std::lround(per_area_ * area)); }
  void note(const Vector3d& c, const Vector3d& n) { samples.push_back(c.cross(n).norm() / hull_.equivalent_radius()); }
  void add(const ConvexCore& core) {
    for (const CoreFace& face : core.faces)
      for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
        const Vector3d &a = core.vertices[face.corners[0]], &b = core.vertices[face.corners[k]],
                       &c = core.vertices[face.corners[k + 1]];
        const int count = points((b - a).cross(c - a).norm() / 2);
        for (int i = 0; i < count; ++i) {
          const Eigen::Vector2d u = even_point(i);
          const double root = std::sqrt(u[0]);
          note(a + root * (1 - u[1]) * (b - a) + root * u[1] * (c - a), face.normal);
        }
      }
    for (const CoreEdge& edge : core.edges) {
      const Vector3d &a = core.vertices[edge.from], along = core.vertices[edge.to] - a;
      const Vector3d n = edge.left < 0 ? along.unitOrthogonal() : core.faces[edge.left].normal,
                     m = along.normalized().cross(n);
      const double turn = core.turn(edge);
      const int count = points(hull_.radius() * turn * along.norm());
      for (int i = 0; i < count; ++i) {
        const Eigen::Vector2d u = even_point(i);
        note(a + u[0] * along, std::cos(u[1] * turn) * n + std::sin(u[1] * turn) * m);
      }
    }
  }
  /// One meridian is enough for a body of revolution, and its upper half by symmetry.
  void add(const DiskCore& core) {
    const double c = core.radius, k = core.half_height, r = hull_.radius();
    const int flat = points(2 * M_PI * c * c);
    for (int i = 0; i < flat; ++i)
      note({c * std::sqrt((i + 0.5) / flat), 0, k}, {0, 0, 1});
    const int side = points(4 * M_PI * (c + r) * k);
    for (int i = 0; i < side; ++i)
      note({c, 0, k * (i + 0.5) / side}, {1, 0, 0});
    // Rim: the area up to the angle p above the mid-plane goes with c p + r sin p.
    const int rim = points(2 * M_PI * r * (M_PI * c + 2 * r));
    for (int i = 0; i < rim; ++i) {
      const double part = (i + 0.5) / rim * (c * M_PI / 2 + r);
      double p = part / (c + r);
      for (int n = 0; n < 50; ++n)
        p -= (c * p + r * std::sin(p) - part) / (c + r); // converges, as the slope is at most c + r
      note({c, 0, k}, {std::cos(p), 0, std::sin(p)});
    }
  }

  const RoundedHull& hull_;
  double per_area_;
};

} // namespace

EccentricityDistribution eccentricity_plane(const RoundedHull& hull) {
  const double unit = hull.equivalent_radius();
  return over_directions([&](const Vector3d& n) { return hull.support(n).cross(n).norm() / unit; });
}

EccentricityDistribution eccentricity_sphere(const RoundedHull& hull, double radius) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw std::invalid_argument("the radius of the sphere that a shape meets must be a number greater than 0");
  const double unit = hull.equivalent_radius(), reach = hull.radius() + radius;
  return over_directions([&](const Vector3d& direction) {
    // The distance grows along a ray, ever faster: Newton's steps from outside never go too far.
    double along = hull.bounding_radius() + radius;
    CoreDistance at{};
    for (int k = 0; k < 60; ++k) {
      at = hull.distance_to_core(along * direction);
      const double step = (at.distance - reach) / at.normal.dot(direction);
      along -= step;
      if (step < 1e-13 * along)
        break;
    }
    return along * direction.cross(at.normal).norm() / unit;
  });
}

EccentricityDistribution eccentricity_surface(const RoundedHull& hull) {
  SurfaceSamples all(hull);
  const double most = *std::max_element(all.samples.begin(), all.samples.end());
  return {std::move(all.samples), 0, most}; // where the surface is nearest to the centre
}

namespace {

/// A ball, or a rounded body; `turn` body to world, `centre` of the body or of the ball, from the body's centre.
struct Part {
  const RoundedHull* hull;
  Matrix3d turn;
  Vector3d centre;
  double radius;

  /// Distance of the core from a point, world axes from the body's centre.
  CoreDistance distance(const Vector3d& point) const {
    if (!hull) {
      const Vector3d apart = point - centre;
      const double length = apart.norm();
      return {length, length > 0 ? Vector3d(apart / length) : Vector3d(Vector3d::UnitZ())};
    }
    CoreDistance d = hull->distance_to_core(turn.transpose() * point);
    d.normal = (turn * d.normal).eval();
    return d;
  }
};

std::vector<Part> parts_of(const ClusterShape& shape, const Matrix3d& turn) {
  if (shape.hull())
    return {{shape.hull(), turn, Vector3d::Zero(), shape.hull()->radius()}};
  std::vector<Part> parts;
  for (const int k : shape.surface_spheres())
    parts.push_back({nullptr, turn, turn * shape.spheres()[k].centre, shape.spheres()[k].radius});
  return parts;
}

/// The closest points of two cores that are apart, `offset` from A's centre to B's: projections in turn.
struct Closest {
  double distance;
  Vector3d on_a, normal; ///< normal from B to A
};
Closest closest_points(const Part& a, const Part& b, const Vector3d& offset) {
  constexpr int limit = 1000;
  constexpr double precision = 1e-9;
  Vector3d on_b = offset + b.centre, on_a = a.centre;
  double before = std::numeric_limits<double>::max();
  CoreDistance d{};
  for (int k = 0; k < limit; ++k) {
    if (a.hull) {
      const CoreDistance from_a = a.distance(on_b);
      on_a = on_b - from_a.distance * from_a.normal;
    }
    d = b.distance(on_a - offset);
    on_b = on_a - d.distance * d.normal;
    if (!a.hull || !b.hull || before - d.distance < precision * d.distance)
      break;
    before = d.distance;
  }
  return {d.distance, on_a, d.normal};
}

} // namespace

EccentricityDistribution rounded_eccentricity_cluster(const ClusterShape& shape, const ClusterShape& other, int count) {
  const double unit = shape.equivalent_radius(), outside = shape.bounding_radius() + other.bounding_radius();
  const std::vector<Part> own = parts_of(shape, Matrix3d::Identity());
  std::vector<double> samples(count);
  for (int s = 0; s < count; ++s) {
    const DirectionAndRotation way = even_direction_and_rotation(s);
    double farthest = 0;
    for (const Part& b : parts_of(other, way.rotation.toRotationMatrix()))
      for (const Part& a : own) {
        // As in eccentricity_sphere, Newton's steps from outside; parts that pass each other never touch.
        double along = outside;
        for (int k = 0; k < 60 && along > farthest; ++k) {
          const Closest c = closest_points(a, b, along * way.direction);
          const double slope = -c.normal.dot(way.direction), gap = c.distance - a.radius - b.radius;
          if (slope <= 1e-9)
            break;
          along -= gap / slope;
          if (gap < 1e-9 * outside) {
            if (along > farthest) {
              farthest = along;
              samples[s] = c.on_a.cross(c.normal).norm() / unit;
            }
            break;
          }
        }
      }
  }
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  const double least = *low, most = *high;
  return {std::move(samples), least, most};
}

} // namespace eccentra::shape
