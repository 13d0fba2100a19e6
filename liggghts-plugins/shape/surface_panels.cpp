// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Octahedral patterns on spheres, what other spheres leave of them, and panels of triangles.
#include "shape/surface_panels.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace eccentra::shape {
namespace {

/// Parts of an edge of a panel: 16 points a panel, one of them in its middle.
constexpr int kParts = 4;
/// Part of a body's size within which mirrored places are the same.
constexpr double kSamePlace = 1e-6;
/// Parts of a sphere's radius by which a point must lie inside another sphere to be cut away.
constexpr double kInside = 1e-9;
/// Factor between two trials of a panel's size.
constexpr double kCoarser = 1.05;

/// Solid angle of a triangle of unit vectors (van Oosterom & Strackee 1983).
double solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return 2 * std::atan2(std::abs(a.cross(b).dot(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// Calls each(a, b, c) for the n^2 equal parts of a flat triangle.
template <class Each>
void for_parts(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, int n, Each&& each) {
  const auto at = [&](int i, int j) -> Eigen::Vector3d { return a + (b - a) * i / n + (c - a) * j / n; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      each(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i + j + 1 < n)
        each(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

/// The eight faces of the octahedron about the origin.
template <class Each> void for_octants(Each&& each) {
  for (const int x : {1, -1})
    for (const int y : {1, -1})
      for (const int z : {1, -1}) {
        const Eigen::Vector3d a(x, 0, 0), b(0, y, 0), c(0, 0, z);
        if (x * y * z > 0)
          each(a, b, c);
        else
          each(a, c, b);
      }
}

bool on_the_kept_side(const Eigen::Vector3d& place, const MirrorPlanes& mirrors) {
  for (int k = 0; k < 3; ++k)
    if (mirrors[k] && place[k] < 0)
      return false;
  return true;
}

/// Sets centre, area and middle from the points.
void finish(Panel& panel) {
  panel.area = 0;
  panel.centre.setZero();
  for (const PanelPoint& point : panel.points) {
    panel.area += point.area;
    panel.centre += point.area * point.place;
  }
  panel.centre /= panel.area;
  panel.extent = 0;
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < panel.points.size(); ++k) {
    const double distance = (panel.points[k].place - panel.centre).norm();
    panel.extent = std::max(panel.extent, distance);
    if (distance < nearest) {
      nearest = distance;
      panel.middle = static_cast<int>(k);
    }
  }
}

/// A pattern on the unit sphere: points by panel.
using Pattern = std::vector<std::vector<PanelPoint>>;

Pattern pattern(int n) {
  Pattern panels;
  for_octants([&](const auto& a, const auto& b, const auto& c) {
    for_parts(a, b, c, n, [&](const auto& p, const auto& q, const auto& r) {
      panels.emplace_back();
      for_parts(p, q, r, kParts, [&](const auto& u, const auto& v, const auto& w) {
        const Eigen::Vector3d place = (u + v + w).normalized();
        panels.back().push_back({place, place, solid_angle(u.normalized(), v.normalized(), w.normalized())});
      });
    });
  });
  return panels;
}

/// Joins panels whose centres lie in one cell of a grid that is mirrored as the surface is.
std::vector<Panel> merged(const std::vector<Panel>& panels, double cell) {
  std::map<std::array<int, 6>, Panel> joined;
  for (const Panel& panel : panels) {
    std::array<int, 6> key{};
    for (int k = 0; k < 3; ++k) {
      key[k] = static_cast<int>(std::abs(panel.centre[k]) / cell);
      key[3 + k] = panel.centre[k] < 0;
    }
    Panel& into = joined[key];
    into.points.insert(into.points.end(), panel.points.begin(), panel.points.end());
  }
  std::vector<Panel> result;
  for (auto& [key, panel] : joined) {
    finish(panel);
    result.push_back(std::move(panel));
  }
  return result;
}

std::vector<Panel> at_most(std::vector<Panel> panels, std::size_t most) {
  double area = 0;
  for (const Panel& panel : panels)
    area += panel.area;
  if (panels.size() <= most)
    return panels;
  double cell = std::sqrt(area / double(most));
  std::vector<Panel> fewer = merged(panels, cell);
  while (fewer.size() > most)
    fewer = merged(panels, cell *= kCoarser);
  return fewer;
}

/// Panels of at most this size on what other spheres leave of each sphere.
std::vector<Panel> panels_of_size(const std::vector<Sphere>& spheres, const MirrorPlanes& mirrors, double size) {
  std::map<int, Pattern> patterns;
  std::vector<Panel> panels;
  for (const Sphere& sphere : spheres) {
    // 8 n^2 panels of this size on the whole sphere.
    const int n = std::max(1, static_cast<int>(std::ceil(sphere.radius * std::sqrt(M_PI / 2) / size)));
    auto [known, is_new] = patterns.try_emplace(n);
    if (is_new)
      known->second = pattern(n);
    std::vector<const Sphere*> near;
    for (const Sphere& other : spheres)
      if (&other != &sphere && (other.centre - sphere.centre).norm() < other.radius + sphere.radius)
        near.push_back(&other);
    for (const auto& points : known->second) {
      Panel panel;
      for (const PanelPoint& unit : points) {
        const Eigen::Vector3d place = sphere.centre + sphere.radius * unit.place;
        if (!on_the_kept_side(place, mirrors))
          continue;
        const bool hidden = std::any_of(near.begin(), near.end(), [&](const Sphere* other) {
          return (place - other->centre).norm() < other->radius * (1 - kInside);
        });
        if (!hidden)
          panel.points.push_back({place, unit.normal, unit.area * sphere.radius * sphere.radius});
      }
      if (panel.points.empty())
        continue;
      finish(panel);
      panels.push_back(std::move(panel));
    }
  }
  return panels;
}

/// True if each place has a partner in the mirror normal to axis k that `same` accepts.
template <class Item, class Place, class Same>
bool mirrored(const std::vector<Item>& items, int k, double size, Place&& place, Same&& same) {
  // Sorted by the coordinate along one of the other axes, partners are neighbours.
  const int along = (k + 1) % 3;
  std::vector<const Item*> sorted;
  for (const Item& item : items)
    sorted.push_back(&item);
  const auto less = [&](const Item* a, const Item* b) { return place(*a)[along] < place(*b)[along]; };
  std::sort(sorted.begin(), sorted.end(), less);
  for (const Item& item : items) {
    Eigen::Vector3d image = place(item);
    image[k] = -image[k];
    auto it = std::lower_bound(sorted.begin(), sorted.end(), image[along] - kSamePlace * size,
                               [&](const Item* a, double value) { return place(*a)[along] < value; });
    bool found = false;
    for (; it != sorted.end() && place(**it)[along] <= image[along] + kSamePlace * size && !found; ++it)
      found = (place(**it) - image).norm() <= kSamePlace * size && same(**it, item);
    if (!found)
      return false;
  }
  return true;
}

} // namespace

MirrorPlanes mirror_planes(const std::vector<Sphere>& spheres) {
  double size = 0;
  for (const Sphere& sphere : spheres)
    size = std::max(size, sphere.centre.norm() + sphere.radius);
  MirrorPlanes planes{};
  for (int k = 0; k < 3; ++k)
    planes[k] = mirrored(
        spheres, k, size, [](const Sphere& s) -> const Eigen::Vector3d& { return s.centre; },
        [&](const Sphere& a, const Sphere& b) { return std::abs(a.radius - b.radius) <= kSamePlace * size; });
  return planes;
}

MirrorPlanes mirror_planes(const Surface& surface) {
  double size = 0;
  std::vector<Eigen::Vector3d> middles;
  for (const auto& t : surface.triangles) {
    middles.push_back((surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3);
    size = std::max(size, middles.back().norm());
  }
  MirrorPlanes planes{};
  for (int k = 0; k < 3; ++k) {
    planes[k] = mirrored(
        middles, k, size, [](const Eigen::Vector3d& v) -> const Eigen::Vector3d& { return v; },
        [](const auto&, const auto&) { return true; });
    // A triangle across the plane is its own partner: there is nothing to gain from half of it.
    for (const auto& t : surface.triangles) {
      double low = 0, high = 0;
      for (const int v : t) {
        low = std::min(low, surface.vertices[v][k]);
        high = std::max(high, surface.vertices[v][k]);
      }
      planes[k] = planes[k] && !(low < -kSamePlace * size && high > kSamePlace * size);
    }
  }
  return planes;
}

std::vector<Panel> panels_of(const std::vector<Sphere>& spheres, const MirrorPlanes& mirrors, std::size_t most) {
  double largest = 0, area = 0;
  for (const Sphere& sphere : spheres) {
    largest = std::max(largest, sphere.radius);
    area += 4 * M_PI * sphere.radius * sphere.radius;
  }
  for (const bool plane : mirrors)
    area *= plane ? 0.5 : 1;
  std::vector<Panel> panels;
  for (double size = std::sqrt(area / double(most)) / 3;; size *= kCoarser) {
    panels = panels_of_size(spheres, mirrors, size);
    if (panels.size() <= most || size > 2 * largest)
      return at_most(std::move(panels), most);
  }
}

std::vector<Panel> panels_of(const Surface& surface, const MirrorPlanes& mirrors, std::size_t most) {
  std::vector<Panel> panels;
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
    if (!on_the_kept_side((a + b + c) / 3, mirrors))
      continue;
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    const double area = cross.norm() / 2;
    if (!(area > 0))
      continue;
    Panel panel;
    for_parts(a, b, c, kParts, [&](const auto& u, const auto& v, const auto& w) {
      panel.points.push_back({(u + v + w) / 3, cross.normalized(), area / (kParts * kParts)});
    });
    finish(panel);
    panels.push_back(std::move(panel));
  }
  return at_most(std::move(panels), most);
}

Surface octahedral_sphere(int n) {
  Surface surface;
  std::map<std::tuple<long, long, long>, int> known;
  const auto vertex = [&](const Eigen::Vector3d& flat) {
    const Eigen::Vector3d whole = flat * n; // whole numbers
    const std::tuple key{std::lround(whole.x()), std::lround(whole.y()), std::lround(whole.z())};
    const auto [it, is_new] = known.try_emplace(key, static_cast<int>(surface.vertices.size()));
    if (is_new)
      surface.vertices.push_back(
          Eigen::Vector3d(double(std::get<0>(key)), double(std::get<1>(key)), double(std::get<2>(key))).normalized());
    return it->second;
  };
  for_octants([&](const auto& a, const auto& b, const auto& c) {
    for_parts(a, b, c, n, [&](const auto& p, const auto& q, const auto& r) {
      surface.triangles.push_back({vertex(p), vertex(q), vertex(r)});
    });
  });
  return surface;
}

} // namespace eccentra::shape
