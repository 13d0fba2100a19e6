// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surface integrals over the free part of each sphere, and what they say of the union.
#include "shape/union_geometry.h"

#include "shape/sphere_exposure.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// Gauss-Legendre nodes and weights on [-1, 1], 12 points (symmetric: the positive half).
constexpr std::array<double, 6> gauss_node = {0.1252334085114689, 0.3678314989981802, 0.5873179542866175,
                                              0.7699026741943047, 0.9041172563704749, 0.9815606342467193};
constexpr std::array<double, 6> gauss_weight = {0.2491470458134028, 0.2334925365383548, 0.2031674267230659,
                                                0.1600783285433462, 0.1069393259953184, 0.0471753363865118};
/// Error allowed per piece of a sphere, for a union of size 1; and how often a piece may be halved to reach it.
constexpr double piece_tolerance = 1e-12;
constexpr int deepest_halving = 12;
/// A gap up to this many radii of the smaller sphere counts as touching: files are written with few digits.
constexpr double touch_tolerance = 1e-3;

enum Moment { area, volume, x, y, z, xx, yy, zz, xy, yz, zx, moment_count };
using Moments = Eigen::Matrix<double, moment_count, 1>;

/// Integrals of cos(k phi) and sin(k phi) over some arcs; index 0 of `cosine` is the arcs' length.
struct Harmonics {
  std::array<double, 5> cosine{}, sine{};
};

Harmonics harmonics_of(const std::vector<Arc>& arcs) {
  Harmonics h;
  for (const Arc& arc : arcs) {
    h.cosine[0] += arc.end - arc.begin;
    for (int k = 1; k <= 4; ++k) {
      h.cosine[k] += (std::sin(k * arc.end) - std::sin(k * arc.begin)) / k;
      h.sine[k] += (std::cos(k * arc.begin) - std::cos(k * arc.end)) / k;
    }
  }
  return h;
}

/// Contribution of one circle of latitude (height in units of the radius) per unit of height: the divergence theorem's
/// integrands for volume, first and second moments, with n the outward normal and powers of cos, sin as harmonics.
Moments latitude_integrand(const Sphere& sphere, double height, const Harmonics& h) {
  const double r = sphere.radius, ring = std::sqrt(std::max(0.0, 1 - height * height)), u = r * ring;
  const double X = sphere.centre.x(), Y = sphere.centre.y(), Z = sphere.centre.z() + r * height;
  const double one = h.cosine[0], c = h.cosine[1], s = h.sine[1];
  const double cc = (one + h.cosine[2]) / 2, ss = (one - h.cosine[2]) / 2, cs = h.sine[2] / 2;
  const double ccc = (3 * c + h.cosine[3]) / 4, sss = (3 * s - h.sine[3]) / 4, ccs = (s + h.sine[3]) / 4;
  const double cccc = (3 * one + 4 * h.cosine[2] + h.cosine[4]) / 8;
  const double ssss = (3 * one - 4 * h.cosine[2] + h.cosine[4]) / 8;
  const double cccs = (2 * h.sine[2] + h.sine[4]) / 8;
  const double x2n = ring * (X * X * c + 2 * X * u * cc + u * u * ccc); // of x^2 n_x
  const double y2n = ring * (Y * Y * s + 2 * Y * u * ss + u * u * sss);
  Moments m;
  m[area] = one;
  m[volume] = (ring * (X * c + Y * s) + (u * ring + Z * height) * one) / 3;
  m[x] = x2n / 2;
  m[y] = y2n / 2;
  m[z] = Z * Z * height * one / 2;
  m[xx] = ring * (X * X * X * c + 3 * X * X * u * cc + 3 * X * u * u * ccc + u * u * u * cccc) / 3;
  m[yy] = ring * (Y * Y * Y * s + 3 * Y * Y * u * ss + 3 * Y * u * u * sss + u * u * u * ssss) / 3;
  m[zz] = Z * Z * Z * height * one / 3;
  m[xy] = (Y * x2n + ring * (X * X * u * cs + 2 * X * u * u * ccs + u * u * u * cccs)) / 2;
  m[yz] = Z * y2n / 2;
  m[zx] = Z * x2n / 2;
  return m * (r * r);
}

/// Integral over the heights middle - half cos(theta), theta in [from, to]. In theta the square roots with which arcs
/// open and close at the ends of a piece are smooth.
Moments gauss(SphereExposure& exposure, const Sphere& sphere, double middle, double half, double from, double to) {
  Moments sum = Moments::Zero();
  for (std::size_t k = 0; k < gauss_node.size(); ++k)
    for (double side : {-1.0, 1.0}) {
      const double theta = (from + to) / 2 + side * (to - from) / 2 * gauss_node[k];
      const double height = middle - half * std::cos(theta);
      const std::vector<Arc>& arcs = exposure.free_arcs(height);
      if (!arcs.empty())
        sum += gauss_weight[k] * half * std::sin(theta) * latitude_integrand(sphere, height, harmonics_of(arcs));
    }
  return sum * (to - from) / 2;
}

Moments integrate(SphereExposure& exposure, const Sphere& sphere, double middle, double half, double from, double to,
                  const Moments& whole, int halvings) {
  const double centre = (from + to) / 2;
  const Moments left = gauss(exposure, sphere, middle, half, from, centre);
  const Moments right = gauss(exposure, sphere, middle, half, centre, to);
  if (halvings >= deepest_halving || (left + right - whole).cwiseAbs().maxCoeff() < piece_tolerance)
    return left + right;
  return integrate(exposure, sphere, middle, half, from, centre, left, halvings + 1) +
         integrate(exposure, sphere, middle, half, centre, to, right, halvings + 1);
}

Moments sphere_moments(const std::vector<Sphere>& spheres, std::size_t index) {
  Moments sum = Moments::Zero();
  SphereExposure exposure(spheres, index);
  if (exposure.swallowed())
    return sum;
  const std::vector<double> heights = exposure.break_heights();
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const double middle = (heights[k] + heights[k + 1]) / 2, half = (heights[k + 1] - heights[k]) / 2;
    const Moments whole = gauss(exposure, spheres[index], middle, half, 0, M_PI);
    sum += integrate(exposure, spheres[index], middle, half, 0, M_PI, whole, 0);
  }
  return sum;
}

void require_valid(const std::vector<Sphere>& spheres) {
  if (spheres.empty())
    throw std::invalid_argument("a shape needs at least one sphere: none was given");
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const std::string who = "sphere " + std::to_string(i + 1) + " of " + std::to_string(spheres.size());
    if (!spheres[i].centre.allFinite() || !std::isfinite(spheres[i].radius))
      throw std::invalid_argument(who + " has a coordinate or radius that is not a finite number");
    if (spheres[i].radius <= 0)
      throw std::invalid_argument(who + " has radius " + std::to_string(spheres[i].radius) +
                                  ": radii must be greater than 0");
  }
}

} // namespace

UnionGeometry measure_union(const std::vector<Sphere>& spheres) {
  require_valid(spheres);
  // Work at size 1 about the middle, so that tolerances and round-off mean the same for every shape.
  Eigen::Vector3d low = spheres[0].centre, high = low;
  for (const Sphere& s : spheres) {
    low = low.cwiseMin((s.centre.array() - s.radius).matrix());
    high = high.cwiseMax((s.centre.array() + s.radius).matrix());
  }
  const Eigen::Vector3d middle = (low + high) / 2;
  const double size = (high - low).maxCoeff() / 2;
  std::vector<Sphere> unit;
  for (const Sphere& s : spheres)
    unit.push_back({(s.centre - middle) / size, s.radius / size});

  UnionGeometry result;
  Moments sum = Moments::Zero();
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const Moments m = sphere_moments(unit, i);
    result.exposed_area.push_back(m[area] * size * size);
    sum += m;
  }
  if (!(sum[volume] > 0))
    throw std::invalid_argument("the shape has no volume");
  const Eigen::Vector3d centre = Eigen::Vector3d(sum[x], sum[y], sum[z]) / sum[volume];
  Eigen::Matrix3d second;
  second << sum[xx], sum[xy], sum[zx], sum[xy], sum[yy], sum[yz], sum[zx], sum[yz], sum[zz];
  second = second / sum[volume] - centre * centre.transpose();
  result.properties.volume = sum[volume] * size * size * size;
  result.properties.surface = sum[area] * size * size;
  result.properties.centre = middle + centre * size;
  result.properties.inertia_per_mass = (second.trace() * Eigen::Matrix3d::Identity() - second) * size * size;
  return result;
}

void require_connected(const std::vector<Sphere>& spheres) {
  require_valid(spheres);
  std::vector<bool> reached(spheres.size(), false);
  std::vector<std::size_t> open{0};
  reached[0] = true;
  while (!open.empty()) {
    const Sphere a = spheres[open.back()];
    open.pop_back();
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      const double reach = a.radius + spheres[j].radius + touch_tolerance * std::min(a.radius, spheres[j].radius);
      if (!reached[j] && (a.centre - spheres[j].centre).norm() <= reach) {
        reached[j] = true;
        open.push_back(j);
      }
    }
  }
  for (std::size_t j = 0; j < spheres.size(); ++j)
    if (!reached[j])
      throw std::invalid_argument(
          "sphere " + std::to_string(j + 1) + " of " + std::to_string(spheres.size()) +
          " does not touch the spheres before it: move it or make it larger, a shape is one body");
}

} // namespace eccentra::shape
