// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edges, repeated facets, orientation, winding numbers and integrals of triangulated surfaces.
#include "shape/surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

std::array<int, 3> sorted(std::array<int, 3> triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

/// True if the triangle walks the edge from its lower to its higher vertex.
bool walks_up(const std::array<int, 3>& triangle, const std::pair<int, int>& edge) {
  for (int k = 0; k < 3; ++k)
    if (triangle[k] == edge.first && triangle[(k + 1) % 3] == edge.second)
      return true;
  return false;
}

Eigen::Vector3d area_vector(const Surface& surface, int index) {
  const auto& t = surface.triangles[static_cast<std::size_t>(index)];
  const Eigen::Vector3d &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
  return (b - a).cross(c - a) / 2;
}

double signed_volume(const Surface& surface, const std::vector<int>& triangles) {
  const Eigen::Vector3d origin = surface.vertices[surface.triangles[triangles.front()][0]];
  double volume = 0;
  for (const int k : triangles) {
    const auto& t = surface.triangles[k];
    volume +=
        (surface.vertices[t[0]] - origin).cross(surface.vertices[t[1]] - origin).dot(surface.vertices[t[2]] - origin) /
        6;
  }
  return volume;
}

} // namespace

EdgeFacets facets_of_edges(const Surface& surface) {
  EdgeFacets edges;
  for (std::size_t n = 0; n < surface.triangles.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const int a = surface.triangles[n][k], b = surface.triangles[n][(k + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(n));
    }
  return edges;
}

OpenEdges open_edges(const Surface& surface) {
  OpenEdges open;
  for (const auto& [edge, facets] : facets_of_edges(surface))
    if (facets.size() % 2 != 0) {
      if (open.total() == 0)
        open.first = {edge.first, edge.second};
      ++(facets.size() == 1 ? open.single : open.several);
    }
  return open;
}

int drop_degenerate(Surface& surface) {
  const auto end = std::remove_if(surface.triangles.begin(), surface.triangles.end(),
                                  [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  const auto count = static_cast<int>(surface.triangles.end() - end);
  surface.triangles.erase(end, surface.triangles.end());
  return count;
}

RepeatedFacets drop_repeated(Surface& surface) {
  std::map<std::array<int, 3>, int> count;
  for (const auto& t : surface.triangles)
    ++count[sorted(t)];
  if (count.size() == surface.triangles.size())
    return {};
  Surface once{surface.vertices, {}}, none{surface.vertices, {}};
  std::map<std::array<int, 3>, bool> seen;
  for (const auto& t : surface.triangles) {
    if (std::exchange(seen[sorted(t)], true))
      continue;
    once.triangles.push_back(t);
    if (count[sorted(t)] % 2 != 0)
      none.triangles.push_back(t);
  }
  const std::size_t before = surface.triangles.size();
  const bool walls = open_edges(once).total() > 0 && open_edges(none).total() == 0;
  surface.triangles = walls ? none.triangles : once.triangles;
  const auto dropped = static_cast<int>(before - surface.triangles.size());
  return walls ? RepeatedFacets{0, dropped} : RepeatedFacets{dropped, 0};
}

void drop_unused_vertices(Surface& surface) {
  std::vector<int> place(surface.vertices.size(), -1);
  std::vector<Eigen::Vector3d> used;
  for (auto& t : surface.triangles)
    for (int& v : t) {
      if (place[v] < 0) {
        place[v] = static_cast<int>(used.size());
        used.push_back(surface.vertices[v]);
      }
      v = place[v];
    }
  surface.vertices = used;
}

std::vector<Shell> orient_shells(Surface& surface, const std::string& where) {
  const EdgeFacets edges = facets_of_edges(surface);
  std::vector<std::vector<std::pair<int, bool>>> neighbours(surface.triangles.size()); // and whether it faces otherwise
  for (const auto& [edge, facets] : edges) {
    if (facets.size() != 2)
      continue;
    const bool against = walks_up(surface.triangles[facets[0]], edge) == walks_up(surface.triangles[facets[1]], edge);
    neighbours[facets[0]].emplace_back(facets[1], against);
    neighbours[facets[1]].emplace_back(facets[0], against);
  }
  std::vector<int> turn(surface.triangles.size(), -1);
  std::vector<Shell> shells;
  for (std::size_t start = 0; start < surface.triangles.size(); ++start) {
    if (turn[start] >= 0)
      continue;
    Shell shell{{static_cast<int>(start)}, 0, 0};
    turn[start] = 0;
    for (std::size_t k = 0; k < shell.triangles.size(); ++k) {
      const int facet = shell.triangles[k];
      for (const auto& [other, against] : neighbours[facet]) {
        const int wanted = against ? 1 - turn[facet] : turn[facet];
        if (turn[other] < 0) {
          turn[other] = wanted;
          shell.triangles.push_back(other);
        } else if (turn[other] != wanted) {
          throw std::invalid_argument(where + "has no inside: its facets cannot be turned the same way round (a "
                                              "one-sided surface); expected the closed surface of a solid");
        }
      }
    }
    double turned_area = 0, area = 0;
    for (const int facet : shell.triangles) {
      const double own = area_vector(surface, facet).norm();
      area += own;
      turned_area += turn[facet] * own;
    }
    if (turned_area > area / 2)
      for (const int facet : shell.triangles)
        turn[facet] = 1 - turn[facet];
    for (const int facet : shell.triangles)
      if (turn[facet] > 0) {
        std::swap(surface.triangles[facet][1], surface.triangles[facet][2]);
        ++shell.turned;
      }
    shell.volume = signed_volume(surface, shell.triangles);
    shells.push_back(shell);
  }
  return shells;
}

int winding_number(const Surface& surface, const std::vector<int>& triangles, const Eigen::Vector3d& point) {
  double angle = 0; // solid angles of the facets, van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125
  for (const int k : triangles) {
    const auto& t = surface.triangles[k];
    const Eigen::Vector3d a = surface.vertices[t[0]] - point, b = surface.vertices[t[1]] - point,
                          c = surface.vertices[t[2]] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.cross(b).dot(c), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<int>(std::lround(angle / (4 * M_PI)));
}

MassProperties solid_properties(const Surface& surface) {
  const Eigen::Vector3d origin = surface.vertices[surface.triangles.front()[0]];
  double volume = 0, area = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d a = surface.vertices[t[0]] - origin, b = surface.vertices[t[1]] - origin,
                          c = surface.vertices[t[2]] - origin;
    const Eigen::Vector3d sum = a + b + c;
    const double tetrahedron = a.cross(b).dot(c) / 6;
    volume += tetrahedron;
    area += (b - a).cross(c - a).norm() / 2;
    first += tetrahedron * sum / 4;
    second += tetrahedron / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const Eigen::Vector3d centre = first / volume;
  second = (second / volume - centre * centre.transpose()).eval();
  return {volume, area, origin + centre, second.trace() * Eigen::Matrix3d::Identity() - second};
}

} // namespace eccentra::shape
