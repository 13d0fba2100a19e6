// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hertz-Mindlin contacts with history, many at a time; pure, no LIGGGHTS.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace eccentra::contact {

/// Which damping: stock's exact Hertz value sqrt(5) beta, or the paper's 2 beta (eq 13-17).
enum class DampingLaw { stock, paper };

/// Contacts between sub-spheres of bodies A and B, as structure of arrays; world frame, SI. Everything is seen from A:
/// B's torque about its own centre of mass, at `offset` from A's, is offset x force - torque.
template <class RowType> struct ContactRows {
  using Row = RowType;

  // In: geometry and state.
  Row separation[3];                      ///< from the centre of B's sub-sphere to that of A's [m]
  Row arm[3];                             ///< from A's centre of mass to its sub-sphere's centre [m]
  Row radius_a, radius_b;                 ///< of the sub-spheres [m]
  Row velocity[3];                        ///< of A's centre of mass, minus that of B's matter, were it there [m/s]
  Row spin[3];                            ///< angular velocity of A minus that of B [rad/s]
  Row mass;                               ///< effective mass of the two bodies [kg]
  Row youngs, shear_modulus;              ///< effective E* and G* [Pa], eq (12), (15)
  Row damping;                            ///< beta = -ln e / sqrt(pi^2 + ln^2 e) >= 0
  Row friction;                           ///< Coulomb coefficient
  Row share;                              ///< factor of the damping, 1 or as SharedStiffness gives it
  Row stiffness_sum, force_sum, work_sum; ///< over contacts that share, see shared_contacts.h
  // In and out: tangential displacement [m].
  Row history[3];
  // Between the two passes (or in), and out.
  Row normal[3];      ///< unit, from B to A
  Row overlap;        ///< [m]
  Row contact_radius; ///< sqrt(R* overlap) [m]
  Row force[3];       ///< on A [N]; B gets the opposite
  Row torque[3];      ///< on A about its centre of mass [N m]
};

/// Vector loops run over whole multiples of this, so that rounding does not depend on a contact's place in its block.
constexpr int contact_width = 8;

/// Rows are short, so that all of them stay in the first-level cache and on few pages, and an odd number of cache lines
/// long: strides near powers of two alias.
struct alignas(64) ContactBlock : ContactRows<double[72]> {
  /// What is left over takes whole vectors from any place on.
  static constexpr int capacity = 64;
};

/// Room for a pair of bodies with more contacts than that, however many.
class LargeContactBlock : public ContactRows<double*> {
 public:
  /// Makes room for `count` contacts; what was in the block is lost.
  void reserve(int count) {
    constexpr int rows = sizeof(ContactRows<double*>) / sizeof(double*);
    const std::size_t length = (count / contact_width + 2) * contact_width;
    if (values_.size() >= rows * length)
      return;
    values_.assign(rows * length, 0.);
    auto* row = reinterpret_cast<double**>(static_cast<ContactRows<double*>*>(this));
    for (int k = 0; k < rows; ++k)
      row[k] = values_.data() + k * length;
  }

 private:
  std::vector<double> values_;
};

/// First pass: normal, overlap and contact radius of contacts 0..n-1. Overlaps must be >= 0.
template <class Block> inline void contact_geometry(Block& c, int n) {
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double x = c.separation[0][m], y = c.separation[1][m], z = c.separation[2][m];
    const double distance = std::sqrt(x * x + y * y + z * z);
    const double inverse = 1 / distance;
    const double sum = c.radius_a[m] + c.radius_b[m];
    const double overlap = sum - distance;
    c.normal[0][m] = x * inverse;
    c.normal[1][m] = y * inverse;
    c.normal[2][m] = z * inverse;
    c.overlap[m] = overlap;
    c.contact_radius[m] = std::sqrt(c.radius_a[m] * c.radius_b[m] / sum * overlap);
  }
}

/// Second pass: forces and torques of contacts 0..n-1.
/// Normal, eq (12)-(14): kn d - gamma_n v_n with kn = 4/3 E* a, a the contact radius; stock's gamma_n =
/// 2 sqrt(5/6) beta sqrt(2 E* a m*), the paper's 2 beta sqrt(4/3 E* a m*). Tangential, eq (15)-(17): kt = 8 G* a on the
/// displacement, capped by Coulomb. Stock: cap mu |F_n| with damping, tangential damping while sticking. Paper: cap
/// mu |F_n| elastic, damping 2 beta sqrt(2/7 kt m*) always; it has no tangential restitution of its own here, e_t =
/// e_n. `advance` moves the history by dt; without it the history is only read.
template <DampingLaw law, bool tangential_damping = true, class Block>
inline void contact_forces(Block& c, int n, double dt, bool advance) {
  const double stock_damping = 2 * std::sqrt(5. / 6.);
  const double advancing = advance ? 1 : 0, time = advancing * dt;
  constexpr double tiny = 1e-300; // keeps 0/0 out where nothing slides
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double nx = c.normal[0][m], ny = c.normal[1][m], nz = c.normal[2][m];
    const double reach = c.radius_a[m] - 0.5 * c.overlap[m];
    // Arm to the contact point, and the velocity of A's material there relative to B's.
    const double ax = c.arm[0][m] - reach * nx, ay = c.arm[1][m] - reach * ny, az = c.arm[2][m] - reach * nz;
    const double wx = c.spin[0][m], wy = c.spin[1][m], wz = c.spin[2][m];
    const double vx = c.velocity[0][m] + (wy * az - wz * ay);
    const double vy = c.velocity[1][m] + (wz * ax - wx * az);
    const double vz = c.velocity[2][m] + (wx * ay - wy * ax);
    const double vn = vx * nx + vy * ny + vz * nz;
    const double tx = vx - vn * nx, ty = vy - vn * ny, tz = vz - vn * nz;

    const double a = c.contact_radius[m];
    const double kn = 4. / 3. * c.youngs[m] * a, kt = 8 * c.shear_modulus[m] * a;
    double gamma_n, gamma_t;
    if (law == DampingLaw::stock) {
      const double factor = stock_damping * c.damping[m] * c.share[m];
      gamma_n = factor * std::sqrt(2 * c.youngs[m] * a * c.mass[m]);
      gamma_t = factor * std::sqrt(kt * c.mass[m]);
    } else {
      const double factor = 2 * c.damping[m] * c.share[m];
      gamma_n = factor * std::sqrt(kn * c.mass[m]);
      gamma_t = factor * std::sqrt(2. / 7. * kt * c.mass[m]);
    }
    if (!tangential_damping)
      gamma_t = 0;
    const double elastic = kn * c.overlap[m];
    const double fn = elastic - gamma_n * vn;

    double sx = c.history[0][m] + tx * time, sy = c.history[1][m] + ty * time, sz = c.history[2][m] + tz * time;
    // The displacement turns with the tangent plane.
    const double out = (sx * nx + sy * ny + sz * nz) * advancing;
    sx -= out * nx;
    sy -= out * ny;
    sz -= out * nz;
    const double spring = kt * std::sqrt(sx * sx + sy * sy + sz * sz);
    const double cap = c.friction[m] * std::fabs(law == DampingLaw::stock ? fn : elastic);
    const bool slides = spring > cap;
    const double scale = slides ? cap / (spring + tiny) : 1;
    const double damper = law == DampingLaw::stock && slides ? 0 : gamma_t;
    const double hx = sx * scale, hy = sy * scale, hz = sz * scale;
    const double fx = fn * nx - kt * hx - damper * tx;
    const double fy = fn * ny - kt * hy - damper * ty;
    const double fz = fn * nz - kt * hz - damper * tz;
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

} // namespace eccentra::contact
