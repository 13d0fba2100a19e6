// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which sub-spheres of two near bodies can touch soon: the search, and the list that it leaves behind.
#pragma once

#include "contact/body_state.h"
#include "contact/surface_spheres.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace eccentra::contact {

/// A pair of sub-spheres as one number: a's index in the upper half, b's in the lower.
constexpr int contact_id(int a, int b) {
  return a << 16 | b;
}
/// Index of A's sub-sphere in an id.
inline int contact_sphere_a(int id) {
  return id >> 16;
}
/// Index of B's sub-sphere in an id.
inline int contact_sphere_b(int id) {
  return id & 0xffff;
}
constexpr int max_surface_spheres = 1 << 15; ///< of a body, so that two indices are one id

/// Where body B lies in the body frame of A. Single precision: this only preselects.
struct RelativePose {
  RelativePose() = default;
  /// offset: from A's centre to B's [m], world frame.
  RelativePose(const BodyState& a, const BodyState& b, const double* offset) {
    Float4 full[3]; // B's rotation by rows, and the offset
    for (int k = 0; k < 3; ++k)
      full[k] = Float4{static_cast<float>(b.column[0][k]), static_cast<float>(b.column[1][k]),
                       static_cast<float>(b.column[2][k]), static_cast<float>(offset[k])};
    for (int i = 0; i < 3; ++i) {
      const Float4 axis = __builtin_convertvector(a.column[i], Float4);
      row[i] = axis[0] * full[0] + axis[1] * full[1] + axis[2] * full[2];
    }
  }

  /// How far at most matter of B within `radius` of its centre has moved in A's frame since the pose `before` [m]. A
  /// turn by theta moves it by at most 2 sin(theta/2) radius, and the Frobenius norm of the difference of the two
  /// matrices is 2 sqrt(2) sin(theta/2); (s + t)^2 <= 2 s^2 + 2 t^2 for shift s and turn t.
  float moved_since(const RelativePose& before, float radius) const {
    const Float4 weight = {radius * radius, radius * radius, radius * radius, 2.f};
    Float4 sum = {0, 0, 0, 0};
    for (int i = 0; i < 3; ++i) {
      const Float4 change = row[i] - before.row[i];
      sum += weight * change * change;
    }
    return std::sqrt(sum[0] + sum[1] + sum[2] + sum[3]);
  }

  Float4 row[3]; ///< rotation from B's frame to A's by rows; fourth lane: B's centre [m]
};

/// The contact_id of candidates of many pairs of bodies, each pair's one after the other. Ids alone: the shapes'
/// spheres stay in the cache, whereas coordinates for each candidate would be most of a body's memory.
class CandidateStore {
 public:
  /// Lists may be read in whole chunks of so many ids.
  static constexpr int chunk = 8;

  /// Empties the store and keeps its memory.
  void clear() {
    ids_.clear();
    used_ = 0;
  }
  /// Room for `count` more; returns the index of the first.
  int reserve(int count) {
    const int first = used_;
    used_ += count;
    const std::size_t needed = std::size_t(used_) + chunk;
    if (needed > ids_.capacity())
      ids_.reserve(needed + needed / 8); // twice as much, as a vector would, is most of a body's memory
    ids_.resize(needed);
    return first;
  }
  /// The list that begins at `index`.
  int* at(int index) { return ids_.data() + index; }
  const int* at(int index) const { return ids_.data() + index; }
  /// Memory [bytes].
  std::size_t bytes() const { return ids_.capacity() * sizeof(int); }

 private:
  std::vector<int> ids_;
  int used_ = 0;
};

/// What a search found.
struct SearchResult {
  int count;   ///< pairs of sub-spheres within the skin
  float slack; ///< relative motion that cannot bring any other pair into touch [m]
};

/// Finds the pairs of sub-spheres of A and B that are closer than `skin`, in ascending order of contact_id.
class CandidateSearch {
 public:
  /// extra: added to all radii (plain spheres).
  SearchResult search(const SurfaceSpheres& a, float extra_a, const SurfaceSpheres& b, float extra_b,
                      const RelativePose& pose, float skin);
  /// The pairs found by the last search, ascending.
  const std::vector<int>& found() const { return found_; }

 private:
  std::vector<int> found_;
  std::vector<float> px_, py_, pz_, gap_; ///< B's sub-spheres in A's frame
  std::vector<int> near_a_, near_b_;
  std::vector<float> nx_, ny_, nz_, nr_, distance_; ///< the near ones of B, compact
};

/// Two shapes and how their bodies lie to each other, for the two functions below.
struct PosedShapes {
  const SurfaceSpheres &a, &b; ///< of the two bodies
  float extra;                 ///< added to the sum of two radii [m]
  const RelativePose& pose;    ///< of B relative to A
};

/// Writes to `hits` (room for count) those of `ids` that overlap or are closer than `margin` [m]; returns how many.
int overlapping_candidates(const PosedShapes& shapes, const int* ids, int count, float margin, int* hits);

/// The least gap between the sub-spheres of the candidates [m].
float min_gap(const PosedShapes& shapes, const int* ids, int count);

} // namespace eccentra::contact
