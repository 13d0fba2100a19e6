// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shape arguments as users type them, in LIGGGHTS scripts and on the command line.
#include "shape/shape_keywords.h"

#include "shape/cluster_shape.h"
#include "shape/decimal.h"
#include "shape/shape_family.h"
#include "shape/union_geometry.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// Bodies longer than this [m] are rare, those of files in millimetres are not.
constexpr double kLargeBody = 0.5;

} // namespace

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
  const std::optional<double> value = decimal(word);
  if (!value || !std::isfinite(*value) || *value <= 0)
    throw std::invalid_argument(what + " is '" + word + "': give a number greater than 0");
  return *value;
}

double scale_to_diameter(double volume, double diameter) {
  return diameter / std::cbrt(6 * volume / M_PI);
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

ClusterShape sized_shape(const std::string& name, std::vector<Sphere> spheres, double diameter) {
  if (diameter <= 0)
    throw std::invalid_argument("shape " + name +
                                " has no size of its own: give the diameter [m] of the sphere of equal volume, > 0");
  MassProperties p = measure_union(spheres).properties;
  resize(spheres, p, scale_to_diameter(p.volume, diameter));
  return ClusterShape(name, std::move(spheres), p);
}

void note_size(const std::vector<Sphere>& spheres, const std::string& where, Notes& notes) {
  Eigen::Vector3d low = spheres.front().centre, high = low;
  for (const Sphere& s : spheres) {
    low = low.cwiseMin((s.centre.array() - s.radius).matrix());
    high = high.cwiseMax((s.centre.array() + s.radius).matrix());
  }
  const double length = (high - low).maxCoeff();
  if (length < kLargeBody)
    return;
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", length);
  notes.push_back({where + ": lengths are taken as metres, which makes the body " + text +
                   " m long: give scale 1e-3 if the file is in millimetres, scale 1 if it is in metres"});
}

ClusterShape make_shape(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                        double diameter, Notes& notes) {
  if (!std::isfinite(diameter))
    throw std::invalid_argument("the diameter of a shape must be a finite number");
  return shape_family(word_at(arguments, first, "the name of a shape")).make({arguments, first, diameter}, used, notes);
}

ClusterShape make_shape(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                        double diameter) {
  Notes dropped;
  return make_shape(arguments, first, used, diameter, dropped);
}

} // namespace eccentra::shape
