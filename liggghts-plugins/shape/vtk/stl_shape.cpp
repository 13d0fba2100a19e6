// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// STL arguments, and the measures of how spheres stand for a solid.
#include "shape/vtk/stl_shape.h"

#include "base/refusal.h"
#include "shape/directions.h"
#include "shape/eccentricity.h"
#include "shape/shape_family.h"
#include "shape/shape_keywords.h"
#include "shape/union_geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// Made at the first call: libeccentra installs the family while it is loaded.
const std::vector<ShapeOption>& stl_options() {
  static const std::vector<ShapeOption> options = {
      {"spheres", "stop at this number of spheres, 1 to 4096"},
      {"error", "stop where this part of the volume is still missing, e.g. 0.05"},
      {"resolution", "grid points along the longest side, 8 to 400; default 48, or more for thin solids"},
      {"scale", "multiply the lengths of a file, e.g. 1e-3 for millimetres"},
      {"mass", "mass, centre and inertia of: union (the spheres; default) or solid"},
      {"cover", "inside (default), or balanced: spheres grow until their union has the volume of the solid"},
      {"missing", "part of the volume that spheres may lack before they are refused; default 0.5"}};
  return options;
}
constexpr int kMaxSpheres = 4096, kMinResolution = 8, kMaxResolution = 400;
/// Missing part of the volume that a note remarks upon.
constexpr double kMuchMissing = 0.2;
/// Spheres that stand out by more than this part of the equivalent radius: remarked upon.
constexpr double kMuchOutside = 0.1;
constexpr double kRoundOff = 1e-6;
/// The largest spheres come first: so many are checked by winding numbers.
constexpr std::size_t kCheckedSpheres = 32;
constexpr int surface_samples = 4000;
constexpr int max_directions = 20000;
constexpr double max_vertex_visits = 4e8; ///< directions times vertices
/// Steps of the additive recurrence of least discrepancy in two dimensions (roots of x^3 = x + 1).
constexpr double first_step = 0.7548776662466927, second_step = 0.5698402909980532;

/// Points spread evenly over the solid's surface, always the same.
std::vector<Eigen::Vector3d> surface_points(const Solid& solid) {
  std::vector<double> reached;
  double area = 0;
  for (const auto& t : solid.triangles()) {
    const Eigen::Vector3d &a = solid.vertices()[t[0]], &b = solid.vertices()[t[1]], &c = solid.vertices()[t[2]];
    reached.push_back(area += (b - a).cross(c - a).norm() / 2);
  }
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < surface_samples; ++k) {
    const double place = (k + 0.5) / surface_samples * area;
    const std::size_t which = std::lower_bound(reached.begin(), reached.end(), place) - reached.begin();
    const auto& t = solid.triangles()[std::min(which, reached.size() - 1)];
    double u = std::fmod(k * first_step, 1.0), v = std::fmod(k * second_step, 1.0);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Eigen::Vector3d &a = solid.vertices()[t[0]], &b = solid.vertices()[t[1]], &c = solid.vertices()[t[2]];
    points.push_back(a + u * (b - a) + v * (c - a));
  }
  return points;
}

double equivalent_radius(double volume) {
  return std::cbrt(3 * volume / (4 * M_PI));
}

std::string percent(double part) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", 100 * part);
  return text.data();
}

MassProperties properties_of(const Solid& solid, const std::vector<Sphere>& spheres, MassOf mass_of) {
  return mass_of == MassOf::solid ? solid.properties() : measure_union(spheres).properties;
}

ClusterShape make(base::OptionReader& words, double diameter, Notes& notes) {
  const StlRequest request = read_stl_request(words);
  const Solid solid(request.path, request.scale);
  return shape_of_solid(solid, cover_of(solid, request), request, diameter, notes);
}

} // namespace

StlRequest read_stl_request(base::OptionReader& words) {
  StlRequest request;
  request.path = words.value("the name of an STL file");
  std::set<std::string> given;
  const auto is_option = [](const std::string& word) {
    return std::any_of(stl_options().begin(), stl_options().end(),
                       [&](const ShapeOption& option) { return option.name == word; });
  };
  while (words.more() && is_option(words.peek())) {
    const std::string& key = words.keyword();
    if (!given.insert(key).second)
      base::refuse("shape stl '{}': '{}' is given twice; expected it once", request.path, key);
    if (key == "spheres") {
      request.options.spheres = words.count(1, "spheres");
      if (request.options.spheres > kMaxSpheres)
        base::refuse("keyword 'spheres': '{}' is too many; expected at most {}", request.options.spheres, kMaxSpheres);
    } else if (key == "error") {
      request.options.volume_error = words.between(0, 1, "the part of the volume that may be missing");
    } else if (key == "missing") {
      request.max_missing = words.between(0, 1, "the part of the volume that may be missing");
    } else if (key == "resolution") {
      request.options.resolution = words.count(kMinResolution, "points along the longest side");
      if (request.options.resolution > kMaxResolution)
        base::refuse("keyword 'resolution': '{}' is too many; expected {} to {} points along the longest side",
                     request.options.resolution, kMinResolution, kMaxResolution);
    } else if (key == "scale") {
      request.scale = words.positive();
      request.scale_given = true;
    } else if (key == "mass") {
      request.mass_of = words.choice({"union", "solid"}) == "solid" ? MassOf::solid : MassOf::spheres;
    } else {
      request.cover = words.choice({"inside", "balanced"}) == "balanced" ? Cover::balanced : Cover::inside;
    }
  }
  if (request.options.spheres == 0 && request.options.volume_error == 0)
    base::refuse("shape stl '{}': no word says how many spheres; expected 'spheres N' or 'error E' (clusterShape: "
                 "--spheres N, --error E)",
                 request.path);
  return request;
}

std::vector<Sphere> cover_of(const Solid& solid, const StlRequest& request) {
  const bool balanced = request.cover == Cover::balanced;
  std::vector<Sphere> spheres =
      balanced ? balanced_spheres(solid, request.options) : inscribed_spheres(solid, request.options);
  const double missing = 1 - measure_union(spheres).properties.volume / solid.properties().volume;
  const std::string who = "STL file '" + solid.path() + "': ";
  bool inside = missing > -kRoundOff;
  for (std::size_t k = 0; k < std::min(spheres.size(), kCheckedSpheres); ++k)
    inside = inside && solid.holds(spheres[k].centre);
  if (!inside)
    throw std::invalid_argument(who + "spheres would lie outside of it, because its facets do not part inside from "
                                      "outside; expected the clean surface of one solid: remesh it");
  if (!balanced && missing > std::max(request.max_missing, request.options.volume_error))
    throw std::invalid_argument(who + std::to_string(spheres.size()) + " spheres lack " + percent(missing) +
                                " of the volume of the solid; expected at most " + percent(request.max_missing) +
                                ": give more spheres, write 'cover balanced', or allow it by 'missing " +
                                std::to_string(std::min(0.99, missing + 0.01)).substr(0, 4) + "'");
  return spheres;
}

ClusterShape shape_of_solid(const Solid& solid, std::vector<Sphere> spheres, const StlRequest& request, double diameter,
                            Notes& notes) {
  notes.insert(notes.end(), solid.notes().begin(), solid.notes().end());
  const std::string who = "STL file '" + solid.path() + "': ";
  const double missing = 1 - measure_union(spheres).properties.volume / solid.properties().volume;
  if (request.cover == Cover::inside) {
    notes.push_back({who + std::to_string(spheres.size()) +
                         (spheres.size() == 1 ? " sphere holds " : " spheres hold ") + percent(1 - missing) +
                         " of the volume of the solid, " + percent(missing) + " are missing" +
                         (missing > kMuchMissing ? ": give more spheres, or write cover balanced" : ""),
                     missing > kMuchMissing});
  } else {
    double out = 0;
    for (const Sphere& s : spheres)
      out = std::max(out, s.radius + solid.distance(s.centre));
    const bool much = out > kMuchOutside * equivalent_radius(solid.properties().volume);
    notes.push_back({who + std::to_string(spheres.size()) +
                         " spheres have the volume of the solid and stand out of it by " +
                         percent(out / equivalent_radius(solid.properties().volume)) + " of its equivalent radius" +
                         (much ? ": give more spheres" : ""),
                     much});
  }
  if (diameter <= 0 && !request.scale_given)
    note_size(spheres, "STL file '" + solid.path() + "'", notes);
  MassProperties p = properties_of(solid, spheres, request.mass_of);
  if (diameter > 0)
    resize(spheres, p, scale_to_diameter(p.volume, diameter));
  return ClusterShape(solid.path(), std::move(spheres), p);
}

SolidEccentricity solid_eccentricity(const Solid& solid) {
  const Eigen::Vector3d centre = solid.properties().centre;
  Eigen::Matrix3Xd corners(3, solid.vertices().size());
  for (std::size_t k = 0; k < solid.vertices().size(); ++k)
    corners.col(k) = solid.vertices()[k] - centre;
  const int directions =
      static_cast<int>(std::min<double>(max_directions, max_vertex_visits / static_cast<double>(corners.cols())));
  const double unit = equivalent_radius(solid.properties().volume);
  SolidEccentricity e{0, 0};
  for (int k = 0; k < directions; ++k) {
    const Eigen::Vector3d n = fibonacci_direction(k, directions);
    int touched = 0;
    (n.transpose() * corners).maxCoeff(&touched);
    const double value = corners.col(touched).cross(n).norm() / unit;
    e.mean += value / directions;
    e.max = std::max(e.max, value);
  }
  return e;
}

FitQuality fit_quality(const Solid& solid, const SolidEccentricity& own, const std::vector<Sphere>& spheres,
                       MassOf mass_of) {
  const MassProperties &p = solid.properties(), q = measure_union(spheres).properties;
  const double unit = equivalent_radius(p.volume);
  FitQuality fit{};
  fit.spheres = static_cast<int>(spheres.size());
  fit.volume = 1 - q.volume / p.volume;
  fit.inertia = (q.inertia_per_mass - p.inertia_per_mass).norm() / p.inertia_per_mass.norm();
  const std::vector<Eigen::Vector3d> points = surface_points(solid);
  for (const Eigen::Vector3d& x : points) {
    double distance = std::numeric_limits<double>::max();
    for (const Sphere& s : spheres)
      distance = std::min(distance, (x - s.centre).norm() - s.radius);
    distance = std::max(distance, 0.0) / unit;
    fit.mean_distance += distance / static_cast<double>(points.size());
    fit.max_distance = std::max(fit.max_distance, distance);
  }
  for (const Sphere& s : spheres)
    fit.protrusion = std::max(fit.protrusion, (s.radius + solid.distance(s.centre)) / unit);
  const EccentricityDistribution plane =
      eccentricity_plane(ClusterShape(solid.path(), spheres, properties_of(solid, spheres, mass_of)));
  fit.mean_eccentricity = plane.mean() - own.mean;
  fit.max_eccentricity = plane.max() - own.max;
  return fit;
}

void install_stl_keywords() {
  ShapeFamily family{"stl", "stl NAME.stl spheres N|error E", true, make};
  family.extensions = ".stl";
  family.options = stl_options();
  add_shape_family(family);
}

} // namespace eccentra::shape
