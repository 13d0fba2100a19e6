// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bipolar grid of an eccentric annulus.
#include "mesh/annulus_grid.h"

#include <cmath>

namespace eccentra::mesh {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Below this eccentricity the foci of the bipolar coordinates are too far away to compute with; the offset is lost in
// it.
constexpr double kConcentric = 1e-6;
constexpr int kBisections = 60;
constexpr int kAreaIterations = 8;

using Points = std::vector<std::array<double, 2>>;

/// Fractions 0 .. 1 of the gap, symmetric geometric growth from the walls to the middle.
std::vector<double> gap_fractions(std::size_t cells, double grading) {
  std::vector<double> fraction(cells + 1, 0.0);
  const double half = 0.5 * double(cells - 1);
  for (std::size_t i = 0; i < cells; ++i) {
    const double from_wall = half > 0 ? 1.0 - std::abs(double(i) - half) / half : 0.0;
    fraction[i + 1] = fraction[i] + std::pow(grading, from_wall);
  }
  for (double& f : fraction) {
    f /= fraction[cells];
  }
  return fraction;
}

Points polar_points(double pipe, double hole, const std::vector<double>& fraction, std::size_t around) {
  Points points;
  for (double f : fraction) {
    const double r = pipe + f * (hole - pipe);
    for (std::size_t j = 0; j < around; ++j) {
      const double angle = 2 * kPi * double(j) / double(around);
      points.push_back({-r * std::sin(angle), r * std::cos(angle)});
    }
  }
  return points;
}

/// Bipolar coordinates (tau, sigma) about foci on the y axis: circles of constant tau, arcs of constant sigma.
class Bipolar {
 public:
  Bipolar(double pipe, double hole, double offset) : offset_(offset) {
    const double c = (hole * hole - pipe * pipe - offset * offset) / (2 * offset);
    focus_ = std::sqrt(c * c - pipe * pipe);
    tau_pipe_ = std::asinh(focus_ / pipe);
    tau_hole_ = std::asinh(focus_ / hole);
    shift_ = focus_ / std::tanh(tau_hole_);
  }

  std::array<double, 2> point(double tau, double sigma) const {
    const double d = std::cosh(tau) - std::cos(sigma);
    return {-focus_ * std::sin(sigma) / d, focus_ * std::sinh(tau) / d - shift_};
  }
  /// Circle of this radius.
  double tau(double radius) const { return std::asinh(focus_ / radius); }

  /// The sigma in [0, pi] whose points on both walls have this mean polar angle about the centres of their walls.
  double sigma(double angle) const {
    double low = 0, high = kPi;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (low + high);
      const auto pipe = point(tau_pipe_, middle);
      const auto hole = point(tau_hole_, middle);
      const double mean = 0.5 * (std::atan2(-pipe[0], pipe[1] + offset_) + std::atan2(-hole[0], hole[1]));
      (mean < angle ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  double offset_, focus_, tau_pipe_, tau_hole_, shift_;
};

Points bipolar_points(double pipe, double hole, double offset, const std::vector<double>& fraction,
                      std::size_t around) {
  const Bipolar bipolar(pipe, hole, offset);
  std::vector<double> sigma(around);
  for (std::size_t j = 0; j < around; ++j) {
    const double angle = 2 * kPi * double(j) / double(around);
    sigma[j] = angle <= kPi ? bipolar.sigma(angle) : 2 * kPi - bipolar.sigma(2 * kPi - angle);
  }
  Points points;
  for (double f : fraction) {
    const double tau = bipolar.tau(pipe + f * (hole - pipe));
    for (double s : sigma) {
      points.push_back(bipolar.point(tau, s));
    }
  }
  return points;
}

double polygon_area(const Points& points, std::size_t first, std::size_t count) {
  double twice = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const auto& p = points[first + j];
    const auto& q = points[first + (j + 1) % count];
    twice += p[0] * q[1] - q[0] * p[1];
  }
  return 0.5 * twice;
}

} // namespace

double AnnulusSection::area() const {
  return kPi * (hole_radius * hole_radius - pipe_radius * pipe_radius);
}

Points annulus_points(const AnnulusSection& section, const GridOptions& options) {
  const std::vector<double> fraction = gap_fractions(options.radial, options.wall_grading);
  const auto build = [&](double pipe, double hole) {
    return section.eccentricity < kConcentric ? polar_points(pipe, hole, fraction, options.around)
                                              : bipolar_points(pipe, hole, section.offset(), fraction, options.around);
  };
  double pipe = section.pipe_radius, hole = section.hole_radius;
  Points points = build(pipe, hole);
  if (options.vertices == WallVertices::kEqualArea) {
    for (int i = 0; i < kAreaIterations; ++i) {
      const double pipe_area = polygon_area(points, 0, options.around);
      const double hole_area = polygon_area(points, options.radial * options.around, options.around);
      pipe *= std::sqrt(kPi * section.pipe_radius * section.pipe_radius / pipe_area);
      hole *= std::sqrt(kPi * section.hole_radius * section.hole_radius / hole_area);
      points = build(pipe, hole);
    }
  }
  return points;
}

} // namespace eccentra::mesh
