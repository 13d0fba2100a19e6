// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements body_classes.h.
#include "report/body_classes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace eccentra::report {
namespace {

constexpr double kSphere = 4.18879020478639098; // 4 pi/3
constexpr double kEqual = 1e-3;                 // relative: files have single precision
constexpr double kSlow = 0.01;                  // [m/s]

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Type and slimness in steps of kEqual.
using Kind = std::pair<int, long>;

struct Body {
  Kind kind;
  double slimness;
  double radius; ///< of the sphere of equal volume [m]
};

Body body_of(const Snapshot& snapshot, std::size_t i) {
  Body body;
  body.radius = std::cbrt(snapshot.volume[i] / kSphere);
  body.slimness = snapshot.radius.empty() ? 1 : snapshot.radius[i] / body.radius;
  body.kind = {snapshot.type.empty() ? 1 : snapshot.type[i], std::lround(body.slimness / kEqual)};
  return body;
}

/// Upper ends of the ranges of radius that are classes, for each kind.
std::map<Kind, std::vector<double>> ranges_of(const std::vector<Snapshot>& snapshots, std::size_t most) {
  std::map<Kind, std::set<double>> radii;
  for (const Snapshot& snapshot : snapshots)
    for (std::size_t i = 0; i < snapshot.volume.size(); ++i) {
      const Body body = body_of(snapshot, i);
      std::set<double>& known = radii[body.kind];
      const auto next = known.lower_bound(body.radius * (1 - kEqual));
      if (next == known.end() || *next > body.radius * (1 + kEqual))
        known.insert(body.radius);
    }
  std::map<Kind, std::vector<double>> ranges;
  for (const auto& [kind, known] : radii) {
    std::vector<double>& ends = ranges[kind];
    if (known.size() <= most)
      ends.assign(known.begin(), known.end());
    else
      for (std::size_t k = 1; k <= most; ++k)
        ends.push_back(*known.begin() *
                       std::pow(*known.rbegin() / *known.begin(), static_cast<double>(k) / static_cast<double>(most)));
    for (double& end : ends)
      end *= 1 + 2 * kEqual;
  }
  return ranges;
}

} // namespace

std::vector<BodyClass> body_classes(const std::vector<Snapshot>& snapshots, const Vector& up, const Vector& flow,
                                    std::size_t most) {
  const auto ranges = ranges_of(snapshots, most);
  std::map<std::pair<Kind, std::size_t>, BodyClass> sums;
  double all = 0;
  for (const Snapshot& snapshot : snapshots)
    for (std::size_t i = 0; i < snapshot.volume.size(); ++i) {
      const Body body = body_of(snapshot, i);
      const std::vector<double>& ends = ranges.at(body.kind);
      const auto range =
          static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), body.radius) - ends.begin());
      BodyClass& sum = sums[{body.kind, std::min(range, ends.size() - 1)}];
      const double volume = snapshot.volume[i], speed = std::sqrt(dot(snapshot.velocity[i], snapshot.velocity[i]));
      sum.type = body.kind.first;
      sum.count += 1;
      sum.part += volume;
      sum.slimness += volume * body.slimness;
      sum.height += volume * dot(snapshot.position[i], up);
      sum.speed += volume * speed;
      sum.along += volume * dot(snapshot.velocity[i], flow);
      sum.slow += speed < kSlow ? volume : 0;
      all += volume;
    }
  std::vector<BodyClass> classes;
  for (const auto& entry : sums) {
    BodyClass one = entry.second;
    const double volume = one.part;
    one.diameter = 2 * std::cbrt(volume / one.count / kSphere);
    for (double* mean : {&one.slimness, &one.height, &one.speed, &one.along, &one.slow})
      *mean /= volume;
    one.part /= all;
    one.count /= static_cast<double>(snapshots.size());
    classes.push_back(one);
  }
  return classes;
}

} // namespace eccentra::report
