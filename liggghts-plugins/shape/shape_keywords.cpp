// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shape arguments as users type them, in LIGGGHTS scripts and on the command line.
#include "shape/shape_keywords.h"

#include "shape/builtin_shapes.h"
#include "shape/clump_file.h"
#include "shape/cluster_shape.h"
#include "shape/union_geometry.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace eccentra::shape {

const std::string& word_at(const std::vector<std::string>& arguments, std::size_t index, const std::string& need) {
  if (index >= arguments.size())
    throw std::invalid_argument("the shape ends too early: " + need + " is missing");
  return arguments[index];
}

long whole_number(const std::string& word, const std::string& what) {
  char* end = nullptr;
  errno = 0;
  const long value = std::strtol(word.c_str(), &end, 10);
  if (word.empty() || *end || errno || value <= 0)
    throw std::invalid_argument(what + " is '" + word + "': give a whole number greater than 0");
  return value;
}

double positive_number(const std::string& word, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end || !std::isfinite(value) || value <= 0)
    throw std::invalid_argument(what + " is '" + word + "': give a number greater than 0");
  return value;
}

void resize(std::vector<Sphere>& spheres, MassProperties& properties, double scale) {
  for (Sphere& s : spheres) {
    s.centre *= scale;
    s.radius *= scale;
  }
  properties.volume *= scale * scale * scale;
  properties.surface *= scale * scale;
  properties.centre *= scale;
  properties.inertia_per_mass *= scale * scale;
}

namespace {

StlMaker stl_maker = nullptr;

/// Factor that gives volume `volume` the equivalent diameter asked for.
double scale_to_diameter(double volume, double diameter) {
  return diameter / std::cbrt(6 * volume / M_PI);
}

ClusterShape from_spheres(const std::string& name, std::vector<Sphere> spheres, double scale, double diameter) {
  require_connected(spheres);
  MassProperties p = measure_union(spheres).properties;
  resize(spheres, p, diameter > 0 ? scale_to_diameter(p.volume, diameter) : scale);
  return ClusterShape(name, std::move(spheres), p);
}

} // namespace

void install_stl_maker(StlMaker maker) {
  stl_maker = maker;
}

ClusterShape make_shape(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                        double diameter) {
  if (!std::isfinite(diameter))
    throw std::invalid_argument("the diameter of a shape must be a finite number");
  const std::string& family = word_at(arguments, first, "sphere, cube, disk, file or stl");
  if (family == "file") {
    const std::string& path = word_at(arguments, first + 1, "the name of a .clump file after 'file'");
    double scale = 1;
    used = 2;
    if (first + 2 < arguments.size() && arguments[first + 2] == "scale") {
      scale = positive_number(word_at(arguments, first + 3, "a number after 'scale'"), "scale of '" + path + "'");
      used = 4;
    }
    return from_spheres(path, read_clump(path), scale, diameter);
  }
  if (family == "stl") {
    if (stl_maker)
      return stl_maker(arguments, first, used, diameter);
    throw std::invalid_argument("shape stl is not read here: make a sphere list of it with `clusterShape stl NAME.stl "
                                "--spheres N -o NAME.clump` and write `shape file NAME.clump`");
  }
  const long count = family == "sphere" || family == "cube" || family == "disk"
                         ? whole_number(word_at(arguments, first + 1, "the number of spheres after '" + family + "'"),
                                        "number of spheres of shape " + family)
                         : 0;
  std::vector<Sphere> spheres = builtin_spheres(family, count);
  used = 2;
  if (diameter <= 0)
    throw std::invalid_argument("shape " + family + " " + std::to_string(count) +
                                " has no size of its own: give the diameter [m] of the sphere of equal volume, > 0");
  return from_spheres(family + " " + std::to_string(count), std::move(spheres), 1, diameter);
}

} // namespace eccentra::shape
