// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Search for near sub-spheres: first against the other body's bounding sphere, then each against each. All loops are
// plain and vectorise for whatever the compiler aims at.
#include "cluster/candidates.h"

#include <algorithm>
#include <cmath>

namespace eccentra::cluster {

void CandidateStore::clear() {
  for (auto* v : {&ax, &ay, &az, &bx, &by, &bz, &reach})
    v->clear();
  id.clear();
}

int CandidateStore::reserve(int count) {
  const int first = size();
  for (auto* v : {&ax, &ay, &az, &bx, &by, &bz, &reach})
    v->resize(first + count);
  id.resize(first + count);
  return first;
}

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

void CandidateSearch::write(const SurfaceSpheres& a, float extra_a, const SurfaceSpheres& b, float extra_b,
                            CandidateStore& store, int first) const {
  const int count = static_cast<int>(found_.size());
  for (int n = 0; n < padded(count); ++n) {
    const int m = first + n;
    if (n >= count) {
      // Far apart, whatever the pose.
      constexpr float nowhere = 1e6f;
      store.ax[m] = nowhere;
      store.ay[m] = store.az[m] = store.bx[m] = store.by[m] = store.bz[m] = store.reach[m] = 0;
      store.id[m] = 0;
      continue;
    }
    const int i = contact_sphere_a(found_[n]), j = contact_sphere_b(found_[n]);
    store.ax[m] = a.xf[i];
    store.ay[m] = a.yf[i];
    store.az[m] = a.zf[i];
    store.bx[m] = b.xf[j];
    store.by[m] = b.yf[j];
    store.bz[m] = b.zf[j];
    store.reach[m] = a.rf[i] + extra_a + b.rf[j] + extra_b;
    store.id[m] = found_[n];
  }
}

int overlapping_candidates(const CandidateStore& store, int first, int count, const RelativePose& pose, float margin,
                           int* hits) {
  const float t[9] = {pose.row[0][0], pose.row[0][1], pose.row[0][2], pose.row[1][0], pose.row[1][1],
                      pose.row[1][2], pose.row[2][0], pose.row[2][1], pose.row[2][2]};
  const float tx = pose.row[0][3], ty = pose.row[1][3], tz = pose.row[2][3];
  int kept = 0;
  constexpr int width = CandidateStore::width;
  for (int start = 0; start < count; start += width) {
    const std::size_t at = first + start;
    const float *ax = store.ax.data() + at, *ay = store.ay.data() + at, *az = store.az.data() + at;
    const float *bx = store.bx.data() + at, *by = store.by.data() + at, *bz = store.bz.data() + at;
    const float* reach = store.reach.data() + at;
    const int* id = store.id.data() + at;
    float gap[width];
    for (int k = 0; k < width; ++k) {
      const float u = t[0] * bx[k] + t[1] * by[k] + t[2] * bz[k] + (tx - ax[k]);
      const float v = t[3] * bx[k] + t[4] * by[k] + t[5] * bz[k] + (ty - ay[k]);
      const float w = t[6] * bx[k] + t[7] * by[k] + t[8] * bz[k] + (tz - az[k]);
      const float r = reach[k] + margin;
      gap[k] = u * u + v * v + w * w - r * r;
    }
    for (int k = 0; k < width; ++k) {
      hits[kept] = id[k];
      kept += gap[k] < 0;
    }
  }
  return kept;
}

float least_gap(const CandidateStore& store, int first, int count, const RelativePose& pose) {
  const float t[9] = {pose.row[0][0], pose.row[0][1], pose.row[0][2], pose.row[1][0], pose.row[1][1],
                      pose.row[1][2], pose.row[2][0], pose.row[2][1], pose.row[2][2]};
  const float tx = pose.row[0][3], ty = pose.row[1][3], tz = pose.row[2][3];
  constexpr int width = CandidateStore::width;
  float least[width];
  std::fill(least, least + width, 1e30f);
  for (int start = 0; start < count; start += width) {
    const std::size_t at = first + start;
    const float *ax = store.ax.data() + at, *ay = store.ay.data() + at, *az = store.az.data() + at;
    const float *bx = store.bx.data() + at, *by = store.by.data() + at, *bz = store.bz.data() + at;
    const float* reach = store.reach.data() + at;
    for (int k = 0; k < width; ++k) {
      const float u = t[0] * bx[k] + t[1] * by[k] + t[2] * bz[k] + (tx - ax[k]);
      const float v = t[3] * bx[k] + t[4] * by[k] + t[5] * bz[k] + (ty - ay[k]);
      const float w = t[6] * bx[k] + t[7] * by[k] + t[8] * bz[k] + (tz - az[k]);
      const float gap = std::sqrt(u * u + v * v + w * w) - reach[k];
      least[k] = gap < least[k] ? gap : least[k];
    }
  }
  return *std::min_element(least, least + width);
}

} // namespace eccentra::cluster
