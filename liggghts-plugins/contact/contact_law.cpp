// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The loop over contacts that makes forces of stiffness, damping and friction.
#include "contact/contact_law.h"

#include <cmath>

namespace eccentra::contact {

namespace {

template <FrictionBound bound, bool synchronised, bool cylinder, class Block>
void forces(Block& c, int n, double dt, bool advance) {
  const double advancing = advance ? 1 : 0, time = advancing * dt, half = 0.5 * time;
  constexpr double tiny = 1e-300; // keeps 0/0 out where nothing slides
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double nx = c.normal[0][m], ny = c.normal[1][m], nz = c.normal[2][m];
    const double reach = c.radius_a[m] - 0.5 * c.overlap[m];
    // Arm to the contact point, and the velocity of A's material there relative to B's.
    const double ax = c.arm[0][m] - reach * nx, ay = c.arm[1][m] - reach * ny, az = c.arm[2][m] - reach * nz;
    const double wx = c.spin[0][m], wy = c.spin[1][m], wz = c.spin[2][m];
    double vx, vy, vz; // there
    double px, py, pz; // normal of the tangent plane in which it slides
    if (synchronised) {
      // In the frame of B: A's sub-sphere moves with g, its centre with u, and the normal turns with curvature * (u
      // without its normal part). Half a step back both the arm and the normal were elsewhere.
      const double bx = c.arm[0][m], by = c.arm[1][m], bz = c.arm[2][m];
      const double gx = wy * bz - wz * by, gy = wz * bx - wx * bz, gz = wx * by - wy * bx;
      const double ux = c.velocity[0][m] + gx, uy = c.velocity[1][m] + gy, uz = c.velocity[2][m] + gz;
      const double un = ux * nx + uy * ny + uz * nz, back = half * c.curvature[m];
      double tx = ux - un * nx, ty = uy - un * ny, tz = uz - un * nz;
      if (cylinder) {
        const double ex = c.separation[0][m], ey = c.separation[1][m], ez = c.separation[2][m];
        const double along = tx * ex + ty * ey + tz * ez;
        tx -= along * ex;
        ty -= along * ey;
        tz -= along * ez;
      }
      tx *= back;
      ty *= back;
      tz *= back;
      const double mx = ax - half * gx + reach * tx, my = ay - half * gy + reach * ty, mz = az - half * gz + reach * tz;
      vx = c.velocity[0][m] + (wy * mz - wz * my);
      vy = c.velocity[1][m] + (wz * mx - wx * mz);
      vz = c.velocity[2][m] + (wx * my - wy * mx);
      px = nx - tx;
      py = ny - ty;
      pz = nz - tz;
    } else {
      vx = c.velocity[0][m] + (wy * az - wz * ay);
      vy = c.velocity[1][m] + (wz * ax - wx * az);
      vz = c.velocity[2][m] + (wx * ay - wy * ax);
      px = nx;
      py = ny;
      pz = nz;
    }
    const double vn = vx * px + vy * py + vz * pz;
    const double tx = vx - vn * px, ty = vy - vn * py, tz = vz - vn * pz;

    const double kt = c.kt[m], gamma_t = c.gamma_t[m];
    const double elastic = c.kn[m] * c.overlap[m];
    const double fn = elastic - c.gamma_n[m] * vn;

    double sx = c.history[0][m] + tx * time, sy = c.history[1][m] + ty * time, sz = c.history[2][m] + tz * time;
    // The displacement turns with the tangent plane.
    const double out = (sx * nx + sy * ny + sz * nz) * advancing;
    sx -= out * nx;
    sy -= out * ny;
    sz -= out * nz;
    const double spring = kt * std::sqrt(sx * sx + sy * sy + sz * sz);
    const double cap = c.friction[m] * std::fabs(bound == FrictionBound::stock ? fn : elastic);
    const bool slides = spring > cap;
    const double scale = slides ? cap / (spring + tiny) : 1;
    const double damper = bound != FrictionBound::paper && slides ? 0 : gamma_t;
    double qx = kt * (sx * scale) + damper * tx, qy = kt * (sy * scale) + damper * ty,
           qz = kt * (sz * scale) + damper * tz;
    if (bound == FrictionBound::elastic) {
      const double total = std::sqrt(qx * qx + qy * qy + qz * qz);
      const double cut = total > cap ? cap / (total + tiny) : 1;
      qx *= cut;
      qy *= cut;
      qz *= cut;
    }
    const double fx = fn * nx - qx, fy = fn * ny - qy, fz = fn * nz - qz;
    // Written without a condition (vector loops): where history is only read, time and advancing are 0.
    const double kept = advancing * scale + (1 - advancing);
    c.history[0][m] = sx * kept;
    c.history[1][m] = sy * kept;
    c.history[2][m] = sz * kept;
    c.force[0][m] = fx;
    c.force[1][m] = fy;
    c.force[2][m] = fz;
    c.torque[0][m] = ay * fz - az * fy;
    c.torque[1][m] = az * fx - ax * fz;
    c.torque[2][m] = ax * fy - ay * fx;
  }
}

template <FrictionBound bound, class Block>
void choose(Block& c, int n, double dt, bool advance, const ForceChoice& choice) {
  if (!choice.synchronised)
    forces<bound, false, false>(c, n, dt, advance);
  else if (choice.cylinder)
    forces<bound, true, true>(c, n, dt, advance);
  else
    forces<bound, true, false>(c, n, dt, advance);
}

template <class Block> void choose(Block& c, int n, double dt, bool advance, const ForceChoice& choice) {
  if (choice.bound == FrictionBound::elastic)
    choose<FrictionBound::elastic>(c, n, dt, advance, choice);
  else if (choice.bound == FrictionBound::stock)
    choose<FrictionBound::stock>(c, n, dt, advance, choice);
  else
    choose<FrictionBound::paper>(c, n, dt, advance, choice);
}

} // namespace

void contact_forces(ContactBlock& c, int n, double dt, bool advance, const ForceChoice& choice) {
  choose(c, n, dt, advance, choice);
}

void contact_forces(LargeContactBlock& c, int n, double dt, bool advance, const ForceChoice& choice) {
  choose(c, n, dt, advance, choice);
}

} // namespace eccentra::contact
