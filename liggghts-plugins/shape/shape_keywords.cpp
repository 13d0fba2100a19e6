// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shape arguments as users type them, in LIGGGHTS scripts and on the command line.
#include "shape/shape_keywords.h"

#include "base/refusal.h"
#include "shape/cluster_shape.h"
#include "shape/shape_family.h"
#include "shape/union_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace eccentra::shape {
namespace {

/// Bodies longer than this [m] are rare, those of files in millimetres are not.
constexpr double kLargeBody = 0.5;

} // namespace

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
    base::refuse("shape {} has no size of its own; expected the diameter [m] of the sphere of equal volume, > 0", name);
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
    base::refuse("the diameter of a shape: '{}' is not a finite number; expected metres", diameter);
  base::OptionReader words(
      {arguments.begin() + static_cast<std::ptrdiff_t>(std::min(first, arguments.size())), arguments.end()});
  const ShapeFamily& family = shape_family(words.keyword("the name of a shape"));
  ClusterShape shape = family.make(words, diameter, notes);
  used = words.at();
  return shape;
}

ClusterShape make_shape(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                        double diameter) {
  Notes dropped;
  return make_shape(arguments, first, used, diameter, dropped);
}

} // namespace eccentra::shape
