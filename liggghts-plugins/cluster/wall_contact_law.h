// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hertz-Mindlin contact of one sphere with a wall, as stock LIGGGHTS's hertz + history has it; pure.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace eccentra::cluster {

/// Coefficients of one pair of materials.
struct WallMaterial {
  double youngs;   ///< effective Young's modulus E* [Pa], eq (12)
  double shear;    ///< effective shear modulus G* [Pa], eq (15)
  double damping;  ///< beta = ln e / sqrt(pi^2 + ln^2 e), <= 0
  double friction; ///< Coulomb coefficient mu_s
};

/// One contact at one instant. World frame, SI.
struct WallContact {
  Eigen::Vector3d normal;            ///< unit, from the wall to the sphere
  Eigen::Vector3d relative_velocity; ///< of the particle's material minus that of the wall, at the contact point
  double overlap;                    ///< > 0
  double radius;                     ///< of the sphere (sub-sphere)
  double mass;                       ///< of the body
  double share; ///< of stiffness and damping that this contact carries: 1, or less where contacts share
};

struct WallForce {
  Eigen::Vector3d force; ///< on the particle
  double elastic_normal; ///< share kn overlap, what rolling friction is proportional to [N]
};

/// Normal: Hertz with Tsuji-type damping (sqrt(5) beta); tangential: Mindlin without unloading steps, capped by
/// Coulomb. `shear` is the tangential displacement of this contact [m]; it is advanced by dt where `update`, else only
/// read. `limit_force` cuts attraction off; `tangential_damping` as in stock.
inline WallForce hertz_mindlin_wall(const WallMaterial& material, const WallContact& contact, double dt, bool update,
                                    bool limit_force, bool tangential_damping, Eigen::Vector3d& shear) {
  static const double tsuji = 2.0 * std::sqrt(5.0 / 6.0);
  const Eigen::Vector3d& n = contact.normal;
  const double vn = contact.relative_velocity.dot(n);
  const Eigen::Vector3d vt = contact.relative_velocity - vn * n;

  const double contact_radius = std::sqrt(contact.radius * contact.overlap);
  const double normal_tangent = 2.0 * material.youngs * contact_radius; // Sn = d Fn / d overlap
  const double kt_full = 8.0 * material.shear * contact_radius;
  const double kn = contact.share * (4.0 / 3.0) * material.youngs * contact_radius;
  const double kt = contact.share * kt_full;
  const double gamma_n = contact.share * -tsuji * material.damping * std::sqrt(normal_tangent * contact.mass);
  const double gamma_t =
      tangential_damping ? contact.share * -tsuji * material.damping * std::sqrt(kt_full * contact.mass) : 0.0;

  const double elastic = kn * contact.overlap;
  double fn = elastic - gamma_n * vn;
  if (limit_force)
    fn = std::max(fn, 0.0);

  if (update) {
    shear += dt * vt;
    shear -= shear.dot(n) * n; // turns with the contact plane
  }
  Eigen::Vector3d ft = -kt * shear;
  const double trial = kt * shear.norm();
  const double coulomb = material.friction * std::abs(fn);
  if (trial > coulomb) {
    ft *= coulomb / trial;
    if (update)
      shear = -ft / kt;
  } else {
    ft -= gamma_t * vt;
  }
  return {fn * n + ft, elastic};
}

} // namespace eccentra::cluster
