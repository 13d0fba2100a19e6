// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of points from boxes and disks and of edges from edges, eight at a time; pure.
#pragma once

#include "contact/contact_core.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>

namespace eccentra::contact {

/// Rows of doubles, each of the same length and aligned, that grow together.
template <int rows> class LaneRows {
 public:
  /// Row `k`, aligned to a whole vector.
  double* row(int k) { return values_.get() + static_cast<std::size_t>(k) * length_; }
  const double* row(int k) const { return values_.get() + static_cast<std::size_t>(k) * length_; }
  /// Lanes that each row has room for.
  int length() const { return length_; }
  /// Room for `count` and a whole vector more; keeps what is there.
  void reserve(int count) {
    if (count + lane_width <= length_)
      return;
    const int length = (2 * count + 2 * lane_width) / lane_width * lane_width + lane_width; // never a power of two
    std::unique_ptr<double, Free> fresh(
        static_cast<double*>(std::aligned_alloc(64, sizeof(double) * rows * static_cast<std::size_t>(length))));
    if (!fresh)
      throw std::bad_alloc();
    std::fill_n(fresh.get(), static_cast<std::size_t>(rows) * length, 1.);
    for (int k = 0; k < rows && length_ > 0; ++k)
      std::copy_n(row(k), length_, fresh.get() + static_cast<std::size_t>(k) * length);
    values_ = std::move(fresh);
    length_ = length;
  }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double, Free> values_;
  int length_ = 0;
};

/// Points and boxes, both in the box's frame.
class BoxLanes {
 public:
  /// Point, half edges, normal and distance, each in the frame of the box [m].
  enum Row { px, py, pz, hx, hy, hz, nx, ny, nz, distance, row_count };
  int count = 0; ///< lanes in use

  /// `point` from the centre of the box, and its half edges [m].
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& half) {
    rows_.reserve(count + 1);
    for (int k = 0; k < 3; ++k) {
      rows_.row(px + k)[count] = point[k];
      rows_.row(hx + k)[count] = half[k];
    }
    ++count;
  }
  /// A value of a lane, after evaluate().
  double at(Row row, int lane) const { return rows_.row(row)[lane]; }
  /// Unit normal of a lane, from box to point.
  Eigen::Vector3d normal(int lane) const { return {at(nx, lane), at(ny, lane), at(nz, lane)}; }

  /// Distances and normals; inside, minus the depth under the nearest face.
  void evaluate() {
    if (count == 0)
      return;
    const double *x = rows_.row(px), *y = rows_.row(py), *z = rows_.row(pz);
    const double *a = rows_.row(hx), *b = rows_.row(hy), *c = rows_.row(hz);
    double *u = rows_.row(nx), *v = rows_.row(ny), *w = rows_.row(nz), *d = rows_.row(distance);
    const int n = (count + lane_width - 1) / lane_width * lane_width;
#pragma GCC ivdep
    for (int k = 0; k < n; ++k) {
      const double gx = std::fabs(x[k]) - a[k], gy = std::fabs(y[k]) - b[k], gz = std::fabs(z[k]) - c[k];
      const double ox = gx > 0 ? gx : 0, oy = gy > 0 ? gy : 0, oz = gz > 0 ? gz : 0;
      const double square = ox * ox + oy * oy + oz * oz, root = std::sqrt(square);
      const bool inside = !(square > 0);
      const double most = gx > gy ? (gx > gz ? gx : gz) : (gy > gz ? gy : gz);
      const double inverse = 1 / (inside ? 1. : root);
      const double ix = inside ? (gx == most ? 1. : 0.) : ox * inverse;
      const double iy = inside ? (gy == most && gx != most ? 1. : 0.) : oy * inverse;
      const double iz = inside ? (gx != most && gy != most ? 1. : 0.) : oz * inverse;
      d[k] = inside ? most : root;
      u[k] = std::copysign(ix, x[k]);
      v[k] = std::copysign(iy, y[k]);
      w[k] = std::copysign(iz, z[k]);
    }
  }

 private:
  LaneRows<row_count> rows_;
};

/// Points and flat cylinders about the z axis, both in the cylinder's frame.
class DiskLanes {
 public:
  /// Point, radius, half height, normal and distance, each in the frame of the cylinder [m].
  enum Row { px, py, pz, wide, high, nx, ny, nz, distance, row_count };
  int count = 0; ///< lanes in use

  /// `half`: radius twice, half height.
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& half) {
    rows_.reserve(count + 1);
    for (int k = 0; k < 3; ++k)
      rows_.row(px + k)[count] = point[k];
    rows_.row(wide)[count] = half.x();
    rows_.row(high)[count] = half.z();
    ++count;
  }
  /// A value of a lane, after evaluate().
  double at(Row row, int lane) const { return rows_.row(row)[lane]; }
  /// Unit normal of a lane, from cylinder to point.
  Eigen::Vector3d normal(int lane) const { return {at(nx, lane), at(ny, lane), at(nz, lane)}; }

  /// Distances and normals; inside, minus the depth under the nearer of face and side.
  void evaluate() {
    if (count == 0)
      return;
    const double *x = rows_.row(px), *y = rows_.row(py), *z = rows_.row(pz), *a = rows_.row(wide), *h = rows_.row(high);
    double *u = rows_.row(nx), *v = rows_.row(ny), *w = rows_.row(nz), *d = rows_.row(distance);
    const int n = (count + lane_width - 1) / lane_width * lane_width;
#pragma GCC ivdep
    for (int k = 0; k < n; ++k) {
      const double rho = std::sqrt(x[k] * x[k] + y[k] * y[k]), beside = rho - a[k], above = std::fabs(z[k]) - h[k];
      const double ob = beside > 0 ? beside : 0, oa = above > 0 ? above : 0;
      const double square = ob * ob + oa * oa, root = std::sqrt(square);
      const bool inside = !(square > 0), to_side = beside > above, on_axis = !(rho > 0);
      const double inverse = 1 / (inside ? 1. : root), radial = 1 / (on_axis ? 1. : rho);
      const double nb = inside ? (to_side ? 1. : 0.) : ob * inverse, na = inside ? (to_side ? 0. : 1.) : oa * inverse;
      d[k] = inside ? (to_side ? beside : above) : root;
      u[k] = on_axis ? nb : nb * x[k] * radial;
      v[k] = nb * y[k] * radial;
      w[k] = std::copysign(na, z[k]);
    }
  }

 private:
  LaneRows<row_count> rows_;
};

/// Pairs of straight edges a + s u and b + t v, s and t in [0, 1].
class EdgeLanes {
 public:
  /// The two edges, the normal, the distance and where on each edge the two are closest.
  enum Row {
    ax,
    ay,
    az,
    ux,
    uy,
    uz,
    bx,
    by,
    bz,
    vx,
    vy,
    vz, // in
    s,
    t,      // of the closest points of the two lines
    square, // of their distance; negative: not in the inside of both edges
    end0,
    end1,
    end2,
    end3, // squared distances of the ends a, a + u, b, b + v from the other edge
    at0,
    at1,
    at2,
    at3, // where on the other edge
    row_count
  };
  int count = 0; ///< lanes in use

  /// Edges a + s u and b + t v [m].
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& u, const Eigen::Vector3d& b, const Eigen::Vector3d& v) {
    rows_.reserve(count + 1);
    for (int k = 0; k < 3; ++k) {
      rows_.row(ax + k)[count] = a[k];
      rows_.row(ux + k)[count] = u[k];
      rows_.row(bx + k)[count] = b[k];
      rows_.row(vx + k)[count] = v[k];
    }
    ++count;
  }
  /// A value of a lane, after evaluate().
  double at(int row, int lane) const { return rows_.row(row)[lane]; }
  /// Three values from `row` on.
  Eigen::Vector3d vector(int row, int lane) const { return {at(row, lane), at(row + 1, lane), at(row + 2, lane)}; }

  /// Distances, normals and places of closest approach.
  void evaluate() {
    if (count == 0)
      return;
    const double *Ax = rows_.row(ax), *Ay = rows_.row(ay), *Az = rows_.row(az);
    const double *Ux = rows_.row(ux), *Uy = rows_.row(uy), *Uz = rows_.row(uz);
    const double *Bx = rows_.row(bx), *By = rows_.row(by), *Bz = rows_.row(bz);
    const double *Vx = rows_.row(vx), *Vy = rows_.row(vy), *Vz = rows_.row(vz);
    double *S = rows_.row(s), *T = rows_.row(t), *D = rows_.row(square);
    double *E0 = rows_.row(end0), *E1 = rows_.row(end1), *E2 = rows_.row(end2), *E3 = rows_.row(end3);
    double *P0 = rows_.row(at0), *P1 = rows_.row(at1), *P2 = rows_.row(at2), *P3 = rows_.row(at3);
    const int n = (count + lane_width - 1) / lane_width * lane_width;
#pragma GCC ivdep
    for (int k = 0; k < n; ++k) {
      const double x = Ax[k] - Bx[k], y = Ay[k] - By[k], z = Az[k] - Bz[k];
      const double u0 = Ux[k], u1 = Uy[k], u2 = Uz[k], v0 = Vx[k], v1 = Vy[k], v2 = Vz[k];
      const double uu = u0 * u0 + u1 * u1 + u2 * u2, vv = v0 * v0 + v1 * v1 + v2 * v2, uv = u0 * v0 + u1 * v1 + u2 * v2;
      const double ur = u0 * x + u1 * y + u2 * z, vr = v0 * x + v1 * y + v2 * z;
      const double det = uu * vv - uv * uv, sn = uv * vr - vv * ur, tn = uu * vr - uv * ur;
      const bool across = (det > parallel * uu * vv) & (sn > 0) & (sn < det) & (tn > 0) & (tn < det);
      const double inverse = 1 / (across ? det : 1.);
      const double sk = sn * inverse, tk = tn * inverse;
      const double dx = x + sk * u0 - tk * v0, dy = y + sk * u1 - tk * v1, dz = z + sk * u2 - tk * v2;
      S[k] = sk;
      T[k] = tk;
      D[k] = across ? dx * dx + dy * dy + dz * dz : -1;
      // Each end from the other edge.
      const double iu = 1 / uu, iv = 1 / vv;
      const double p0 = clamped(vr * iv), p1 = clamped((vr + uv) * iv), p2 = clamped(-ur * iu),
                   p3 = clamped((uv - ur) * iu);
      const double x0 = x - p0 * v0, y0 = y - p0 * v1, z0 = z - p0 * v2;
      const double x1 = x + u0 - p1 * v0, y1 = y + u1 - p1 * v1, z1 = z + u2 - p1 * v2;
      const double x2 = x + p2 * u0, y2 = y + p2 * u1, z2 = z + p2 * u2;
      const double x3 = x + p3 * u0 - v0, y3 = y + p3 * u1 - v1, z3 = z + p3 * u2 - v2;
      E0[k] = x0 * x0 + y0 * y0 + z0 * z0;
      E1[k] = x1 * x1 + y1 * y1 + z1 * z1;
      E2[k] = x2 * x2 + y2 * y2 + z2 * z2;
      E3[k] = x3 * x3 + y3 * y3 + z3 * z3;
      P0[k] = p0;
      P1[k] = p1;
      P2[k] = p2;
      P3[k] = p3;
    }
  }

 private:
  static constexpr double parallel = 1e-9; ///< squared sine below which edges are parallel: the ends have it all
  static double clamped(double p) {
    return p < 0 ? 0 : p > 1 ? 1 : p;
  }
  LaneRows<row_count> rows_;
};

} // namespace eccentra::contact
