// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes STL files of simple solids for tests.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

namespace eccentra::test {

using Facet = std::array<Eigen::Vector3d, 3>;

inline void write_stl(const std::string& name, const std::vector<Facet>& facets) {
  std::ofstream out(name);
  out << std::setprecision(9) << "solid test\n";
  for (const Facet& f : facets) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const Eigen::Vector3d& v : f)
      out << "vertex " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid test\n";
}

/// Box with corners at +-half, moved by `centre`.
inline std::vector<Facet> box(const Eigen::Vector3d& half, const Eigen::Vector3d& centre) {
  std::vector<Facet> facets;
  for (int axis = 0; axis < 3; ++axis)
    for (int side : {-1, 1}) {
      const Eigen::Vector3d a = Eigen::Vector3d::Unit((axis + 1) % 3), b = Eigen::Vector3d::Unit((axis + 2) % 3);
      const Eigen::Vector3d n = side * Eigen::Vector3d::Unit(axis);
      auto corner = [&](double u, double v) -> Eigen::Vector3d {
        return centre + half.cwiseProduct(n + u * a + side * v * b);
      };
      facets.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
      facets.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
    }
  return facets;
}

/// Upright cylinder about the z axis, an inscribed prism of `sides` sides.
inline std::vector<Facet> cylinder(double radius, double height, int sides) {
  std::vector<Facet> facets;
  auto rim = [&](int k, double z) {
    const double angle = 2 * M_PI * k / sides;
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  const double z = height / 2;
  const Eigen::Vector3d top(0, 0, z), bottom(0, 0, -z);
  for (int k = 0; k < sides; ++k) {
    facets.push_back({top, rim(k, z), rim(k + 1, z)});
    facets.push_back({bottom, rim(k + 1, -z), rim(k, -z)});
    facets.push_back({rim(k, -z), rim(k + 1, -z), rim(k + 1, z)});
    facets.push_back({rim(k, -z), rim(k + 1, z), rim(k, z)});
  }
  return facets;
}

/// Sphere as an octahedron whose faces are divided `levels` times.
inline std::vector<Facet> ball(double radius, int levels) {
  std::vector<Facet> facets;
  for (int x : {-1, 1})
    for (int y : {-1, 1})
      for (int z : {-1, 1}) {
        Facet f{Eigen::Vector3d(x, 0, 0), Eigen::Vector3d(0, y, 0), Eigen::Vector3d(0, 0, z)};
        if (x * y * z < 0)
          std::swap(f[1], f[2]);
        facets.push_back(f);
      }
  for (int level = 0; level < levels; ++level) {
    std::vector<Facet> finer;
    for (const Facet& f : facets) {
      const Eigen::Vector3d a = (f[0] + f[1]).normalized(), b = (f[1] + f[2]).normalized(),
                            c = (f[2] + f[0]).normalized();
      for (const Facet& g : {Facet{f[0], a, c}, Facet{a, f[1], b}, Facet{c, b, f[2]}, Facet{a, b, c}})
        finer.push_back(g);
    }
    facets = finer;
  }
  for (Facet& f : facets)
    for (Eigen::Vector3d& v : f)
      v *= radius;
  return facets;
}

} // namespace eccentra::test
