// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements section_measures.h.
#include "report/section_measures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eccentra::report {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Area of the disc of radius r below the chord at signed distance h from its centre.
double disc_below(double r, double h) {
  if (h <= -r)
    return 0;
  if (h >= r)
    return pi * r * r;
  // r - h is exact near the rim, where acos(-h / r) and r * r - h * h would lose half of the digits.
  const double half_chord = std::sqrt((r - h) * (r + h));
  return r * r * std::atan2(half_chord, -h) + h * half_chord;
}

/// Volume of the sphere of radius r below the plane at signed distance h from its centre.
double sphere_below(double r, double h) {
  const double depth = std::clamp(h + r, 0.0, 2 * r);
  return pi * depth * depth * (3 * r - depth) / 3;
}

} // namespace

double Section::volume() const {
  return pi * (hole_radius * hole_radius - pipe_radius * pipe_radius) * length;
}

std::vector<double> layer_volumes(const Section& section, const std::array<double, 2>& up, std::size_t layers) {
  if (layers == 0)
    throw std::invalid_argument("a profile needs at least one layer");
  const double pipe = section.pipe_centre[0] * up[0] + section.pipe_centre[1] * up[1];
  const double thickness = 2 * section.hole_radius / static_cast<double>(layers);
  const auto below = [&](double height) {
    return disc_below(section.hole_radius, height) - disc_below(section.pipe_radius, height - pipe);
  };
  std::vector<double> volume(layers);
  for (std::size_t k = 0; k < layers; ++k) {
    const double low = -section.hole_radius + static_cast<double>(k) * thickness;
    volume[k] = (below(low + thickness) - below(low)) * section.length;
  }
  return volume;
}

std::vector<double> concentration_profile(const Section& section, const Snapshot& snapshot,
                                          const std::array<double, 2>& up, std::size_t layers) {
  const std::vector<double> capacity = layer_volumes(section, up, layers);
  const double thickness = 2 * section.hole_radius / static_cast<double>(layers);
  std::vector<double> solid(layers, 0.0);
  for (std::size_t i = 0; i < snapshot.position.size(); ++i) {
    const double radius = std::cbrt(3 * snapshot.volume[i] / (4 * pi));
    const double height = snapshot.position[i][0] * up[0] + snapshot.position[i][1] * up[1] + section.hole_radius;
    const auto layer_of = [&](double h) {
      return static_cast<std::size_t>(std::clamp(h / thickness, 0.0, static_cast<double>(layers) - 1));
    };
    const std::size_t first = layer_of(height - radius);
    const std::size_t last = layer_of(height + radius);
    double below = 0;
    for (std::size_t k = first; k <= last; ++k) {
      const double top = static_cast<double>(k + 1) * thickness;
      const double upto = k == last ? snapshot.volume[i] : sphere_below(radius, top - height);
      solid[k] += upto - below;
      below = upto;
    }
  }
  for (std::size_t k = 0; k < layers; ++k)
    solid[k] = capacity[k] > 0 ? solid[k] / capacity[k] : 0;
  return solid;
}

double bed_height(const std::vector<double>& profile, double hole_diameter) {
  constexpr double half_packed = 0.55 / 2;
  const double thickness = hole_diameter / static_cast<double>(profile.size());
  const auto dense = std::find_if(profile.begin(), profile.end(), [](double c) { return c >= half_packed; });
  if (dense == profile.end())
    return 0;
  for (auto k = static_cast<std::size_t>(dense - profile.begin()); k + 1 < profile.size(); ++k) {
    if (profile[k + 1] < half_packed) {
      const double share = (profile[k] - half_packed) / (profile[k] - profile[k + 1]);
      return (static_cast<double>(k) + 0.5 + share) * thickness;
    }
  }
  return hole_diameter;
}

double share_at_rest(const Snapshot& snapshot, double speed) {
  double resting = 0;
  double all = 0;
  for (std::size_t i = 0; i < snapshot.volume.size(); ++i) {
    all += snapshot.volume[i];
    if (std::abs(snapshot.velocity[i][2]) < speed)
      resting += snapshot.volume[i];
  }
  return all > 0 ? resting / all : 0;
}

SolidState solid_state(const Snapshot& snapshot, const Vector& up) {
  SolidState state;
  std::vector<std::pair<double, double>> heights; // with the volumes
  for (std::size_t i = 0; i < snapshot.position.size(); ++i) {
    const Vector& x = snapshot.position[i];
    const Vector& v = snapshot.velocity[i];
    const double height = x[0] * up[0] + x[1] * up[1] + x[2] * up[2];
    heights.emplace_back(height, snapshot.volume[i]);
    state.volume += snapshot.volume[i];
    state.centre += snapshot.volume[i] * height;
    state.speed += snapshot.volume[i] * std::hypot(v[0], v[1], v[2]);
  }
  if (!(state.volume > 0))
    return state;
  state.centre /= state.volume;
  state.speed /= state.volume;
  std::sort(heights.begin(), heights.end());
  constexpr double share = 0.98;
  double below = 0;
  for (const auto& [height, volume] : heights) {
    below += volume;
    state.top = height;
    if (below >= share * state.volume)
      break;
  }
  return state;
}

} // namespace eccentra::report
