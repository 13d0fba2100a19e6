// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Search for near sub-spheres: first against the other body's bounding sphere, then each against each. All loops are
// plain and vectorise for whatever the compiler aims at.
#include "contact/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::contact {

SearchResult CandidateSearch::search(const SurfaceSpheres& a, float extra_a, const SurfaceSpheres& b, float extra_b,
                                     const RelativePose& pose, float skin) {
  found_.clear();
  const float tx = pose.row[0][3], ty = pose.row[1][3], tz = pose.row[2][3];
  const float bound_a = static_cast<float>(a.bounding_radius) + extra_a;
  const float bound_b = static_cast<float>(b.bounding_radius) + extra_b;
  const float clearance = std::sqrt(tx * tx + ty * ty + tz * tz) - bound_a - bound_b;
  if (clearance >= skin)
    return {0, clearance};
  const SearchResult nothing = {0, skin};

  // B's sub-spheres in A's frame, and those that reach A's bounding sphere.
  const std::size_t room = std::max(a.padded, b.padded);
  if (px_.size() < room)
    for (auto* v : {&px_, &py_, &pz_, &gap_, &nx_, &ny_, &nz_, &nr_, &distance_})
      v->resize(room);
  if (near_a_.size() < room) {
    near_a_.resize(room);
    near_b_.resize(room);
  }
  const float t[9] = {pose.row[0][0], pose.row[0][1], pose.row[0][2], pose.row[1][0], pose.row[1][1],
                      pose.row[1][2], pose.row[2][0], pose.row[2][1], pose.row[2][2]};
  const float reach_a = bound_a + extra_b + skin;
  {
    float *px = px_.data(), *py = py_.data(), *pz = pz_.data(), *gap = gap_.data();
    const float *x = b.xf.data(), *y = b.yf.data(), *z = b.zf.data(), *r = b.rf.data();
#pragma GCC ivdep
    for (int k = 0; k < b.padded; ++k) {
      const float u = t[0] * x[k] + t[1] * y[k] + t[2] * z[k] + tx;
      const float v = t[3] * x[k] + t[4] * y[k] + t[5] * z[k] + ty;
      const float w = t[6] * x[k] + t[7] * y[k] + t[8] * z[k] + tz;
      const float reach = r[k] + reach_a;
      px[k] = u;
      py[k] = v;
      pz[k] = w;
      gap[k] = u * u + v * v + w * w - reach * reach;
    }
  }
  int count_b = 0;
  for (int k = 0; k < b.count; ++k) {
    near_b_[count_b] = k;
    count_b += gap_[k] < 0;
  }
  if (count_b == 0)
    return nothing;

  // A's that reach B's bounding sphere.
  const float reach_b = bound_b + extra_a + skin;
  {
    float* gap = gap_.data();
    const float *x = a.xf.data(), *y = a.yf.data(), *z = a.zf.data(), *r = a.rf.data();
#pragma GCC ivdep
    for (int k = 0; k < a.padded; ++k) {
      const float u = x[k] - tx, v = y[k] - ty, w = z[k] - tz;
      const float reach = r[k] + reach_b;
      gap[k] = u * u + v * v + w * w - reach * reach;
    }
  }
  int count_a = 0;
  for (int k = 0; k < a.count; ++k) {
    near_a_[count_a] = k;
    count_a += gap_[k] < 0;
  }
  if (count_a == 0)
    return nothing;

  // Each near one of A against the near ones of B.
  for (int m = 0; m < count_b; ++m) {
    const int k = near_b_[m];
    nx_[m] = px_[k];
    ny_[m] = py_[k];
    nz_[m] = pz_[k];
    nr_[m] = b.rf[k];
  }
  const float extra = extra_a + extra_b + skin;
  for (int n = 0; n < count_a; ++n) {
    const int k = near_a_[n];
    const float x = a.xf[k], y = a.yf[k], z = a.zf[k], r = a.rf[k] + extra;
    float* distance = distance_.data();
    const float *qx = nx_.data(), *qy = ny_.data(), *qz = nz_.data(), *qr = nr_.data();
#pragma GCC ivdep
    for (int m = 0; m < count_b; ++m) {
      const float u = qx[m] - x, v = qy[m] - y, w = qz[m] - z;
      const float reach = qr[m] + r;
      distance[m] = u * u + v * v + w * w - reach * reach;
    }
    const std::size_t before = found_.size();
    found_.resize(before + count_b);
    int* out = found_.data() + before;
    int kept = 0;
    for (int m = 0; m < count_b; ++m) {
      out[kept] = contact_id(k, near_b_[m]);
      kept += distance_[m] < 0;
    }
    found_.resize(before + kept);
  }
  return {static_cast<int>(found_.size()), skin};
}

namespace {

/// The vector from A's sub-sphere to B's in A's frame; fourth lane: what `extra` starts with, minus the sum of their
/// radii. One candidate after the other in one register: lists are short, and each knows where its spheres are.
class Separation {
 public:
  Separation(const PosedShapes& s, float extra) : a_(s.a.sphere.data()), b_(s.b.sphere.data()) {
    for (int k = 0; k < 4; ++k)
      column_[k] = Float4{s.pose.row[0][k], s.pose.row[1][k], s.pose.row[2][k], 0.f};
    column_[3][3] = -extra;
  }
  Float4 operator()(int id) const {
    const Float4 a = __builtin_convertvector(a_[contact_sphere_a(id)], Float4);
    const Float4 b = __builtin_convertvector(b_[contact_sphere_b(id)], Float4);
    constexpr Float4 radius = {0, 0, 0, 1};
    return column_[0] * b[0] + column_[1] * b[1] + column_[2] * b[2] + column_[3] - a - b * radius;
  }

 private:
  const Double4 *a_, *b_;
  Float4 column_[4];
};

} // namespace

int overlapping_candidates(const PosedShapes& shapes, const int* ids, int count, float margin, int* hits) {
  const Separation separation(shapes, shapes.extra + margin);
  int kept = 0;
  for (int n = 0; n < count; ++n) {
    const Float4 d = separation(ids[n]), square = d * d;
    hits[kept] = ids[n];
    kept += square[0] + square[1] + square[2] < square[3];
  }
  return kept;
}

float min_gap(const PosedShapes& shapes, const int* ids, int count) {
  const Separation separation(shapes, shapes.extra);
  float least = std::numeric_limits<float>::max();
  for (int n = 0; n < count; ++n) {
    const Float4 d = separation(ids[n]), square = d * d;
    least = std::min(least, std::sqrt(square[0] + square[1] + square[2]) + d[3]);
  }
  return least;
}

} // namespace eccentra::contact
