// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points on rims of disks as the solids of other bodies see them, eight at a time; pure.
#pragma once

#include "contact/manifold_lanes.h"
#include "contact/rim_on_solid.h"

#include <cmath>
#include <limits>
#include <vector>

namespace eccentra::contact {

/// Points of rims in the frames of disks, of boxes or of other solids: their distance and normal, the slope of the
/// distance along the rim and how fast that changes by the angle, as RimSample has them.
class RimLanes {
 public:
  /// Inputs of an arc's end, then distance, slope, rise, rate and region as RimEnd has them.
  enum Row {
    px,
    py,
    pz,
    ax,
    ay,
    az, // along the rim, of its radius
    ox,
    oy,
    oz, // out of its centre, of its radius
    hx,
    hy,
    hz, // half extents of the solid; in
    nx,
    ny,
    nz,
    distance,
    slope,
    rise, // part of the normal out of the rim's centre
    rate,
    region, // of the solid that is closest: features with different numbers meet at kinks of the slope
    row_count
  };
  int count = 0; ///< lanes in use

  /// Point `k` of a rim as one lane.
  void add(const RimOnSolid& rim, int k) {
    rows_.reserve(count + 1);
    Eigen::Vector3d out, along;
    rim.directions(k, out, along);
    const Eigen::Vector3d point = rim.centre() + out;
    for (int j = 0; j < 3; ++j) {
      rows_.row(px + j)[count] = point[j];
      rows_.row(ax + j)[count] = along[j];
      rows_.row(ox + j)[count] = out[j];
      rows_.row(hx + j)[count] = rim.solid().half[j];
    }
    ++count;
  }
  /// A value of a lane.
  double at(int row, int lane) const { return rows_.row(row)[lane]; }
  /// Three values from `row` on.
  Eigen::Vector3d vector(int row, int lane) const { return {at(row, lane), at(row + 1, lane), at(row + 2, lane)}; }
  /// The result of a lane.
  RimEnd end(int lane) const {
    return {at(distance, lane), at(slope, lane), at(rise, lane), at(rate, lane), at(region, lane)};
  }

  /// Evaluates all lanes against flat cylinders.
  void on_disks();
  /// Evaluates all lanes against boxes.
  void on_boxes();
  /// `solid` of each lane.
  void on_polyhedra(const std::vector<const ContactCore*>& solid);

 private:
  /// Rows by the letters of the loops, and the number of lanes in whole vectors.
  struct Columns {
    const double *x, *y, *z, *a0, *a1, *a2, *o0, *o1, *o2, *h0, *h1, *h2;
    double *u, *v, *w, *d, *s, *r, *c, *g;
    int n;
  };
  Columns columns() {
    return {rows_.row(px),       rows_.row(py),     rows_.row(pz),
            rows_.row(ax),       rows_.row(ay),     rows_.row(az),
            rows_.row(ox),       rows_.row(oy),     rows_.row(oz),
            rows_.row(hx),       rows_.row(hy),     rows_.row(hz),
            rows_.row(nx),       rows_.row(ny),     rows_.row(nz),
            rows_.row(distance), rows_.row(slope),  rows_.row(rise),
            rows_.row(rate),     rows_.row(region), (count + lane_width - 1) / lane_width * lane_width};
  }

  LaneRows<row_count> rows_;
};

inline void RimLanes::on_disks() {
  const auto [x, y, z, a0, a1, a2, o0, o1, o2, h0, h1, h2, u, v, w, d, s, r, c, g, n] = columns();
#pragma GCC ivdep
  for (int k = 0; k < n; ++k) {
    const double square_rho = x[k] * x[k] + y[k] * y[k], rho = std::sqrt(square_rho);
    const bool on_axis = !(rho > 0);
    const double inverse = 1 / (on_axis ? 1. : rho), ex = on_axis ? 1. : x[k] * inverse,
                 ey = on_axis ? 0. : y[k] * inverse;
    const double up = std::copysign(1., z[k]), beside = rho - h0[k], above = up * z[k] - h2[k];
    const double rho1 = ex * a0[k] + ey * a1[k], z1 = up * a2[k];
    const double rho2 = (a0[k] * a0[k] + a1[k] * a1[k] - rho1 * rho1) * (on_axis ? 0. : inverse) -
                        (ex * o0[k] + ey * o1[k]),
                 z2 = -up * o2[k];
    const bool corner = (beside > 0) & (above > 0), side = beside > above;
    const double root = std::sqrt(corner ? beside * beside + above * above : 1.), over = 1 / root;
    const double nb = corner ? beside * over : side ? 1. : 0., na = corner ? above * over : side ? 0. : 1.;
    const double s1 = nb * rho1 + na * z1;
    const double bend = corner ? (rho1 * rho1 + z1 * z1 - s1 * s1) * over : 0.;
    const double length = 1 / std::sqrt(o0[k] * o0[k] + o1[k] * o1[k] + o2[k] * o2[k]);
    d[k] = corner ? root : side ? beside : above;
    u[k] = nb * ex;
    v[k] = nb * ey;
    w[k] = na * up;
    s[k] = s1 * length;
    r[k] = (nb * (ex * o0[k] + ey * o1[k]) + na * up * o2[k]) * length;
    c[k] = (bend + nb * rho2 + na * z2) * length;
    g[k] = corner ? 0. : side ? 3. : up;
  }
}

inline void RimLanes::on_boxes() {
  const auto [x, y, z, a0, a1, a2, o0, o1, o2, h0, h1, h2, u, v, w, d, s, r, c, g, n] = columns();
#pragma GCC ivdep
  for (int k = 0; k < n; ++k) {
    const double gx = std::fabs(x[k]) - h0[k], gy = std::fabs(y[k]) - h1[k], gz = std::fabs(z[k]) - h2[k];
    const double bx = gx > 0 ? gx : 0., by = gy > 0 ? gy : 0., bz = gz > 0 ? gz : 0.;
    const double square = bx * bx + by * by + bz * bz;
    const bool inside = !(square > 0);
    const double root = std::sqrt(inside ? 1. : square), over = 1 / root;
    const double most = gx > gy ? (gx > gz ? gx : gz) : (gy > gz ? gy : gz);
    const bool to_x = gx == most, to_y = (gy == most) & !to_x, to_z = !to_x & !to_y;
    const double ux = std::copysign(inside ? (to_x ? 1. : 0.) : bx * over, x[k]),
                 uy = std::copysign(inside ? (to_y ? 1. : 0.) : by * over, y[k]),
                 uz = std::copysign(inside ? (to_z ? 1. : 0.) : bz * over, z[k]);
    const double s1 = ux * a0[k] + uy * a1[k] + uz * a2[k], r1 = ux * o0[k] + uy * o1[k] + uz * o2[k];
    const double speed = (gx > 0 ? a0[k] * a0[k] : 0.) + (gy > 0 ? a1[k] * a1[k] : 0.) + (gz > 0 ? a2[k] * a2[k] : 0.);
    const double bend = inside ? 0. : (speed - s1 * s1) * over;
    const double length = 1 / std::sqrt(o0[k] * o0[k] + o1[k] * o1[k] + o2[k] * o2[k]);
    d[k] = inside ? most : root;
    u[k] = ux;
    v[k] = uy;
    w[k] = uz;
    s[k] = s1 * length;
    r[k] = r1 * length;
    c[k] = (bend - r1) * length;
    // The feature's own number: signs of the coordinates that lie beyond, in base 3.
    g[k] = (gx > 0 ? std::copysign(1., x[k]) : 0.) + (gy > 0 ? std::copysign(3., y[k]) : 0.) +
           (gz > 0 ? std::copysign(9., z[k]) : 0.) + (inside ? 100. * ux + 200. * uy + 300. * uz : 0.);
  }
}

inline void RimLanes::on_polyhedra(const std::vector<const ContactCore*>& solid) {
  for (int k = 0; k < count; ++k) {
    const shape::CoreDistance found = distance_to_faces(*solid[k], vector(px, k));
    const double length = 1 / vector(ox, k).norm();
    for (int j = 0; j < 3; ++j)
      rows_.row(nx + j)[k] = found.normal[j];
    rows_.row(distance)[k] = found.distance;
    rows_.row(slope)[k] = found.normal.dot(vector(ax, k)) * length;
    rows_.row(rise)[k] = found.normal.dot(vector(ox, k)) * length;
    rows_.row(rate)[k] = std::numeric_limits<double>::quiet_NaN();
    rows_.row(region)[k] = 0;
  }
}

} // namespace eccentra::contact
