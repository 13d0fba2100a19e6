// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// STL arguments, and the measures of how spheres stand for a solid.
#include "shape/vtk/stl_shape.h"

#include "shape/directions.h"
#include "shape/eccentricity.h"
#include "shape/shape_keywords.h"
#include "shape/union_geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace eccentra::shape {
namespace {

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

ClusterShape from_stl_keywords(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                               double diameter) {
  const std::string path = word_at(arguments, first + 1, "the name of an STL file after 'stl'");
  InscribedOptions options;
  double scale = 1;
  MassOf mass_of = MassOf::spheres;
  used = 2;
  for (std::size_t k = first + 2; k < arguments.size(); k += 2, used += 2) {
    const std::string& key = arguments[k];
    if (key != "spheres" && key != "scale" && key != "mass" && key != "resolution" && key != "error")
      break;
    const std::string& value = word_at(arguments, k + 1, "a value after '" + key + "'");
    if (key == "spheres")
      options.spheres = static_cast<int>(whole_number(value, "number of spheres of '" + path + "'"));
    else if (key == "error")
      options.volume_error = positive_number(value, "volume error of '" + path + "'");
    else if (key == "resolution")
      options.resolution = static_cast<int>(whole_number(value, "resolution of '" + path + "'"));
    else if (key == "scale")
      scale = positive_number(value, "scale of '" + path + "'");
    else if (value == "solid" || value == "union")
      mass_of = value == "solid" ? MassOf::solid : MassOf::spheres;
    else
      throw std::invalid_argument("mass of '" + path + "' is '" + value + "': choose solid or union");
  }
  if (options.spheres == 0 && options.volume_error == 0)
    throw std::invalid_argument("shape stl '" + path + "' needs to know where to stop: give 'spheres N' or 'error E'");
  const Solid solid(path, scale);
  return shape_of_solid(solid, inscribed_spheres(solid, options), mass_of, diameter);
}

} // namespace

ClusterShape shape_of_solid(const Solid& solid, std::vector<Sphere> spheres, MassOf mass_of, double diameter) {
  MassProperties p = mass_of == MassOf::solid ? solid.properties() : measure_union(spheres).properties;
  if (mass_of == MassOf::solid)
    p.surface = solid.properties().surface;
  if (diameter > 0)
    resize(spheres, p, diameter / (2 * equivalent_radius(p.volume)));
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
  const EccentricityDistribution plane = eccentricity_plane(shape_of_solid(solid, spheres, mass_of, 0));
  fit.mean_eccentricity = plane.mean() - own.mean;
  fit.max_eccentricity = plane.max() - own.max;
  return fit;
}

void install_stl_keywords() {
  install_stl_maker(from_stl_keywords);
}

} // namespace eccentra::shape
