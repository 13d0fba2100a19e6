// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of a section of annulus: concentration over the height, bed height, solid flux. Pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace eccentra::report {

using Vector = std::array<double, 3>;

/// The annulus: the hole's axis is the z axis; the pipe's axis is parallel to it. SI.
struct Section {
  double hole_radius = 0;                     ///< R [m]
  double pipe_radius = 0;                     ///< r [m]
  std::array<double, 2> pipe_centre = {0, 0}; ///< x and y of the pipe's axis [m]
  double length = 0;                          ///< [m]
  double volume() const;                      ///< pi (R^2 - r^2) L [m3]
};

/// Bodies at one time, world frame, SI; a cluster is one row.
struct Snapshot {
  double time = 0;
  std::vector<Vector> position, velocity;
  std::vector<double> volume;
  std::vector<double> radius = {}; ///< of the bounding spheres; empty if unknown
  std::vector<int> type = {};      ///< empty if unknown
};

/// Solid volume fraction in layers of equal thickness across the hole, from the low side (layer 0) to the high side.
/// `up`: unit vector in the x-y plane, towards the high side. Each body counts as the sphere of its volume, cut exactly
/// at the bounds of the layers; a part outside of the hole counts for the outermost layer.
/// Throws std::invalid_argument if `layers` is 0.
std::vector<double> concentration_profile(const Section& section, const Snapshot& snapshot,
                                          const std::array<double, 2>& up, std::size_t layers);

/// Volume of each of these layers [m3]; they sum to Section::volume().
std::vector<double> layer_volumes(const Section& section, const std::array<double, 2>& up, std::size_t layers);

/// Height above the hole's low side at which the concentration, coming from below, falls through half of what a bed of
/// random loose packing holds (0.55 / 2), interpolated between layer centres; 0 if no layer is that dense.
double bed_height(const std::vector<double>& profile, double hole_diameter);

/// Of all bodies, weighted by volume; heights along `up` from the origin.
struct SolidState {
  double volume = 0; ///< [m3]
  double centre = 0; ///< height of the centre [m]
  double top = 0;    ///< height that 98 % of the volume is below, each body counted at its centre [m]
  double speed = 0;  ///< mean speed [m/s]
};

/// `up`: unit vector. All 0 without bodies.
SolidState solid_state(const Snapshot& snapshot, const Vector& up);

/// Share of the solid volume that moves along the hole slower than `speed` [m/s].
double share_at_rest(const Snapshot& snapshot, double speed);

} // namespace eccentra::report
