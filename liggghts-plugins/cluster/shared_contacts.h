// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of several simultaneous contacts between the same two bodies (decision D2); pure.
#pragma once

#include <cmath>

namespace eccentra::cluster {

/// Springs in parallel add, but dampers tuned to each spring alone do not: the restitution of a body is set by
/// gamma = 2 sqrt(5/6) beta sqrt(S m*) with S the stiffness of the whole connection, while N equal contacts with
/// gamma_k(S_k) each add up to sqrt(N) times that (stock: e_eff = e^sqrt(N)). So `contacts shared` multiplies the
/// damping of contact k by sqrt(S_k / S) with S = sum_j S_j (n_j . n_k)^2, the stiffness of all contacts of this pair
/// of bodies along the normal of contact k. One contact keeps its damping; N contacts with one normal share that of
/// their sum; contacts at right angles do not know of each other. It varies smoothly as contacts come and go (S_k -> 0
/// with the overlap), and as only dissipation is scaled, the elastic forces stay those of the potential sum: sharing
/// cannot create energy. Make one per pair of bodies (or body and wall) and step, add all contacts, then ask.
class SharedStiffness {
 public:
  /// Adds a contact: stiffness S [any unit, the same for all; sqrt(R* overlap) will do within one pair of materials]
  /// and unit normal n (the sign does not matter).
  void add(double stiffness, double nx, double ny, double nz) {
    xx_ += stiffness * nx * nx;
    yy_ += stiffness * ny * ny;
    zz_ += stiffness * nz * nz;
    xy_ += stiffness * nx * ny;
    xz_ += stiffness * nx * nz;
    yz_ += stiffness * ny * nz;
  }

  /// Factor of the normal and tangential damping of one of the contacts that were added, in (0, 1].
  double damping_share(double stiffness, double nx, double ny, double nz) const {
    const double all =
        xx_ * nx * nx + yy_ * ny * ny + zz_ * nz * nz + 2 * (xy_ * nx * ny + xz_ * nx * nz + yz_ * ny * nz);
    return all > stiffness ? std::sqrt(stiffness / all) : 1;
  }

 private:
  double xx_ = 0, yy_ = 0, zz_ = 0, xy_ = 0, xz_ = 0, yz_ = 0;
};

} // namespace eccentra::cluster
