// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Layouts of spheres, cubes and disks whose unions have the sphericities of Akhshik, Behzad & Rajabi (2016), Table 1.
#include "shape/builtin_shapes.h"

#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

// Radius over spacing. The sphericity of the union is a function of this ratio alone; these give the values of Table 1.
constexpr double ratio_sphere6 = 2.604;  ///< sphericity 0.98
constexpr double ratio_cube8 = 0.97403;  ///< 0.91
constexpr double ratio_cube27 = 0.99674; ///< 0.87
constexpr double ratio_cube64 = 1.02872; ///< 0.85; larger cubes keep it
constexpr double ratio_disk7 = 0.59239;  ///< 0.68
constexpr double ratio_disk19 = 0.47127; ///< 0.75
constexpr double ratio_disk48 = 0.4476;  ///< 0.79

struct Ring {
  int count;
  double radius; ///< in units of the outermost ring's
};

std::vector<Sphere> octahedron() {
  std::vector<Sphere> spheres;
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-1.0, 1.0})
      spheres.push_back({side * Eigen::Vector3d::Unit(axis), ratio_sphere6});
  return spheres;
}

std::vector<Sphere> cube(int edge, double ratio) {
  std::vector<Sphere> spheres;
  const double middle = (edge - 1) / 2.0;
  for (int i = 0; i < edge; ++i)
    for (int j = 0; j < edge; ++j)
      for (int k = 0; k < edge; ++k)
        spheres.push_back({Eigen::Vector3d(i - middle, j - middle, k - middle), ratio});
  return spheres;
}

/// Cosine of index/count of a turn, exactly symmetric in the quadrants so that the shape is, too.
double cosine_of_turn(int index, int count) {
  index = ((index % count) + count) % count;
  if (2 * index > count)
    index = count - index;
  if (4 * index == count)
    return 0;
  return 4 * index > count ? -std::cos(2 * M_PI * (count - 2 * index) / (2 * count))
                           : std::cos(2 * M_PI * index / count);
}

std::vector<Sphere> rings(const std::vector<Ring>& layout, double ratio) {
  std::vector<Sphere> spheres;
  for (const Ring& ring : layout)
    for (int k = 0; k < ring.count; ++k) {
      // sin(t) = cos(t - quarter turn), in quarters of the ring's own steps
      const double c = cosine_of_turn(4 * k, 4 * ring.count), s = cosine_of_turn(4 * k - ring.count, 4 * ring.count);
      spheres.push_back({Eigen::Vector3d(ring.radius * c, ring.radius * s, 0), ratio});
    }
  return spheres;
}

} // namespace

const std::vector<BuiltinShape>& builtin_shapes() {
  static const std::vector<BuiltinShape> shapes = {
      {"sphere", 1, "smooth sphere (S1)"},
      {"sphere", 6, "non-smooth sphere (S6): six spheres on an octahedron"},
      {"cube", 8, "cube (C8): 2 x 2 x 2 lattice"},
      {"cube", 27, "cube (C27): 3 x 3 x 3 lattice"},
      {"cube", 64, "cube (C64): 4 x 4 x 4 lattice"},
      {"disk", 7, "disk (D7): centre and a ring of 6"},
      {"disk", 19, "disk (D19): centre and rings of 6 and 12"},
      {"disk", 48, "disk (D48): rings of 8, 16 and 24"},
  };
  return shapes;
}

std::vector<Sphere> builtin_spheres(const std::string& family, long count) {
  if (family == "sphere") {
    if (count == 1)
      return {{Eigen::Vector3d::Zero(), 1.0}};
    if (count == 6)
      return octahedron();
    throw std::invalid_argument("shape sphere " + std::to_string(count) + " does not exist: choose 1 or 6");
  }
  if (family == "cube") {
    const int edge = static_cast<int>(std::lround(std::cbrt(static_cast<double>(count))));
    if (edge < 1 || edge > largest_cube || static_cast<long>(edge) * edge * edge != count)
      throw std::invalid_argument("shape cube " + std::to_string(count) +
                                  " does not exist: choose n^3 from 8, 27, 64 to " +
                                  std::to_string(largest_cube * largest_cube * largest_cube));
    return cube(edge, edge <= 2 ? ratio_cube8 : edge == 3 ? ratio_cube27 : ratio_cube64);
  }
  if (family == "disk") {
    switch (count) {
    case 7:
      return rings({{1, 0}, {6, 1}}, ratio_disk7);
    case 19:
      return rings({{1, 0}, {6, 0.5}, {12, 1}}, ratio_disk19);
    case 48:
      return rings({{8, 1 / 3.0}, {16, 2 / 3.0}, {24, 1}}, ratio_disk48);
    }
    throw std::invalid_argument("shape disk " + std::to_string(count) + " does not exist: choose 7, 19 or 48");
  }
  throw std::invalid_argument("shape '" + family + "' is unknown: choose sphere, cube, disk, file or stl");
}

} // namespace eccentra::shape
