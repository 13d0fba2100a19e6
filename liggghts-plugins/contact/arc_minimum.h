// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points of an arc of a disk's rim that are closest to something, or farthest from it.
#pragma once

#include "contact/contact_core.h"
#include "contact/hand_over.h"

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace eccentra::contact {

/// A rim of a posed disk: points about its centre by their angle.
struct Rim {
  Eigen::Vector3d centre, x, y; ///< of the rim; its half axes [m]
  /// `rim` is 0 for the one at +z of the disk, 1 for the other.
  Rim(const PosedCore& disk, int rim) {
    const ContactCore& core = *disk.core;
    centre = (rim == 0 ? core.half.z() : -core.half.z()) * disk.rotation.col(2);
    x = core.half.x() * disk.rotation.col(0);
    y = core.half.x() * disk.rotation.col(1);
  }
  /// Point at an angle [rad].
  Eigen::Vector3d at(double angle) const { return centre + std::cos(angle) * x + std::sin(angle) * y; }
  /// Derivative of at() with respect to the angle [m].
  Eigen::Vector3d tangent(double angle) const { return std::cos(angle) * y - std::sin(angle) * x; }
};

/// A point on a rim, its distance from something and the normal there, from that something to the point.
struct RimPoint {
  Eigen::Vector3d point;  ///< [m], world axes, from the body's centre
  shape::CoreDistance at; ///< distance [m] and normal
};

/// A point of a rim as something else sees it: with the slope of the distance along the rim, and how fast that changes.
struct RimSample {
  RimPoint point; ///< with its distance
  double slope;   ///< [-]
  double rate;    ///< per radian; NaN where it is not known
};

/// The closest point between two angles, at the first of which the distance falls and at the second of which it rises:
/// the root of its slope, by Newton's method within a bracket that the Illinois method keeps. `slope_low` < 0 <
/// `slope_high`. With `low` > `high` the farthest point. `sample(angle)` gives a RimSample.
/// Starts at `angle`.
template <typename Sampler>
RimPoint closest_on_arc(double low, double slope_low, double high, double slope_high, double angle,
                        const Sampler& sample) {
  constexpr double precision = 1e-13; // of slopes and angles
  constexpr double last = 1e-6;       // what Newton's next step leaves after one of this is round-off
  constexpr int limit = 60;
  int kept = 0;
  bool final = false;
  for (int k = 0;; ++k) {
    const RimSample at = sample(angle);
    if (final || k == limit || std::abs(at.slope) < precision || std::abs(high - low) < precision)
      return at.point;
    if (at.slope < 0) {
      low = angle;
      slope_low = at.slope;
      if (kept < 0)
        slope_high /= 2;
      kept = -1;
    } else {
      high = angle;
      slope_high = at.slope;
      if (kept > 0)
        slope_low /= 2;
      kept = 1;
    }
    const double newton = angle - at.slope / at.rate;
    if ((newton - low) * (newton - high) < 0) {
      final = std::abs(newton - angle) < last;
      angle = newton;
    } else {
      angle = high - slope_high * (high - low) / (slope_high - slope_low);
    }
  }
}

/// Where the chord of the slope has its root.
inline double chord_root(double low, double slope_low, double high, double slope_high) {
  return high - slope_high * (high - low) / (slope_high - slope_low);
}

/// A point at which the distance along an arc is least, or greatest.
struct ArcExtreme {
  RimPoint point; ///< with its distance
  bool closest;   ///< the distance is least there
};

/// Most pieces of an arc; slopes between them are found in one vector loop.
constexpr int max_pieces = lane_width;

/// Adds all of them between two angles, in order, as far as they can be told apart in so many equal pieces of the arc,
/// at most max_pieces. `sample.slopes(low, step, n, slopes)` gives those at low + step .. low + n step; there is
/// room for lane_width.
template <typename Sampler>
void extremes_on_arc(double low, double slope_low, double high, double slope_high, int pieces, const Sampler& sample,
                     std::vector<ArcExtreme>& extremes) {
  const double first = low, step = (high - low) / pieces;
  double slopes[lane_width];
  if (pieces > 1)
    sample.slopes(low, step, pieces - 1, slopes);
  for (int k = 1; k <= pieces; ++k) {
    const double next = k == pieces ? high : first + k * step;
    double slope_next = slope_high;
    if (k < pieces)
      slope_next = slopes[k - 1] == 0 ? 1e-300 : slopes[k - 1]; // a least one there belongs to one piece
    if (slope_low < 0 && slope_next > 0)
      extremes.push_back(
          {closest_on_arc(low, slope_low, next, slope_next, chord_root(low, slope_low, next, slope_next), sample),
           true});
    else if (slope_low >= 0 && slope_next <= 0 && slope_low - slope_next > 0)
      extremes.push_back(
          {closest_on_arc(next, slope_next, low, slope_low, chord_root(next, slope_next, low, slope_low), sample),
           false});
    low = next;
    slope_low = slope_next;
  }
}

/// The spring of an arc with S = sum of u over its closest points less that over its farthest ones, an end from which
/// u falls being one of the former: of the potential S (1 - u_0 / S) (1 - u_1 / S), u_0 and u_1 at the ends, what each
/// closest point counts (farthest ones: minus that), and what the springs of the ends lose.
struct ArcSpring {
  double share = 0;        ///< what each closest point counts [-]
  double loss[2] = {0, 0}; ///< part of the springs of the ends that is lost [-]

  /// `slope` of the distance at the ends, both the way in which the arc runs.
  ArcSpring(const double (&end_overlap)[2], const double (&slope)[2], const std::vector<ArcExtreme>& extremes,
            double reach) {
    const auto energy = [](double overlap) { return overlap > 0 ? spring_energy(overlap) : 0; };
    const double u[2] = {energy(end_overlap[0]), energy(end_overlap[1])};
    const bool closest[2] = {!(slope[0] < 0), !(slope[1] > 0)};
    double sum = (closest[0] ? u[0] : 0) + (closest[1] ? u[1] : 0);
    for (const ArcExtreme& e : extremes)
      sum += (e.closest ? 1 : -1) * energy(reach - e.point.at.distance);
    if (!(sum > 0))
      return;
    share = 1 - u[0] / sum * (u[1] / sum);
    for (int k = 0; k < 2; ++k)
      loss[k] = 1 - u[1 - k] / sum - (closest[k] ? share : 0);
  }
};

} // namespace eccentra::contact
