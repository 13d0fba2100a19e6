// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of several simultaneous contacts between the same two bodies (decision D2); pure.
#pragma once

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

/// Springs in parallel add, but dampers tuned to each spring alone do not: N equal contacts with gamma_k(S_k) each add
/// up to sqrt(N) times what returns e (stock: e_eff = e^sqrt(N)). What does return e, for any elastic force F with work
/// W, is gamma = 2 beta sqrt(m*) F / sqrt(2 W): in the variable sqrt(2 W) the impact is then a damped linear
/// oscillator. With Hertz contacts, F = 2/3 sum S d and W = 4/15 sum S d^2 (S = dF/dd of each, d its overlap), this is
/// stock's 2 sqrt(5/6) beta sqrt(S' m*) with S' = (sum S d)^2 / sum S d^2, N S for N equal contacts. So `contacts
/// shared` hands that damping out in proportion to stiffness: contact k keeps the fraction sqrt(S_k S') / sum S of its
/// own. Sums run over all contacts of this pair of bodies, weighted by (n_j . n_k)^2: one contact keeps its damping,
/// contacts with one normal share, contacts at right angles do not know of each other. It varies smoothly as contacts
/// come and go, and as only dissipation is scaled, the elastic forces stay those of the potential sum: sharing cannot
/// create energy. Make one per pair of bodies (or body and wall) and step, add all contacts, then ask.
class SharedStiffness {
 public:
  /// Adds a contact: stiffness S [any unit, the same for all; sqrt(R* overlap) will do within one pair of materials],
  /// overlap [m] and unit normal n (the sign does not matter).
  void add(double stiffness, double overlap, double nx, double ny, double nz) {
    const double products[6] = {nx * nx, ny * ny, nz * nz, nx * ny, nx * nz, ny * nz};
    for (int k = 0; k < 6; ++k) {
      stiffness_[k] += stiffness * products[k];
      force_[k] += stiffness * overlap * products[k];
      work_[k] += stiffness * overlap * overlap * products[k];
    }
  }

  /// Factor of the normal and tangential damping of one of the contacts that were added, in (0, 1].
  double damping_share(double stiffness, double nx, double ny, double nz) const {
    const double products[6] = {nx * nx, ny * ny, nz * nz, 2 * nx * ny, 2 * nx * nz, 2 * ny * nz};
    double s = 0, f = 0, w = 0;
    for (int k = 0; k < 6; ++k) {
      s += stiffness_[k] * products[k];
      f += force_[k] * products[k];
      w += work_[k] * products[k];
    }
    return s > stiffness && w > 0 ? std::min(1., f / s * std::sqrt(stiffness / w)) : 1;
  }

 private:
  // Sums of n n^T weighted by S, S d and S d^2: xx, yy, zz, xy, xz, yz.
  double stiffness_[6] = {}, force_[6] = {}, work_[6] = {};
};

/// The same for the contacts first..last-1 of one pair of bodies in a block, each against each, which is shorter for
/// few contacts than the tensors above: starts the sums of all `n` contacts of the block with their own terms (unit:
/// sqrt(R* overlap), one pair of materials) ...
template <class Block> inline void start_shared_sums(Block& c, int n) {
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double stiffness = c.contact_radius[m], force = stiffness * c.overlap[m];
    c.stiffness_sum[m] = stiffness;
    c.force_sum[m] = force;
    c.work_sum[m] = force * c.overlap[m];
  }
}

/// ... adds to them what contacts j and k of one pair of bodies see of each other ...
template <class Block> inline void add_shared_pair(Block& c, int j, int k) {
  const double cosine =
      c.normal[0][j] * c.normal[0][k] + c.normal[1][j] * c.normal[1][k] + c.normal[2][j] * c.normal[2][k];
  const double weight = cosine * cosine;
  const double stiffness_j = weight * c.contact_radius[j], stiffness_k = weight * c.contact_radius[k];
  const double force_j = stiffness_j * c.overlap[j], force_k = stiffness_k * c.overlap[k];
  c.stiffness_sum[j] += stiffness_k;
  c.force_sum[j] += force_k;
  c.work_sum[j] += force_k * c.overlap[k];
  c.stiffness_sum[k] += stiffness_j;
  c.force_sum[k] += force_j;
  c.work_sum[k] += force_j * c.overlap[j];
}

/// ... and makes them the contacts' shares of damping.
template <class Block> inline void finish_shared_sums(Block& c, int n) {
  constexpr double tiny = 1e-100; // keeps 0/0 out where an overlap rounds to 0
#pragma GCC ivdep
  for (int m = 0; m < n; ++m) {
    const double stiffness = c.contact_radius[m], sum = c.stiffness_sum[m], work = c.work_sum[m];
    const double ratio = c.force_sum[m] / (sum + tiny) * std::sqrt(stiffness / (work + tiny));
    c.share[m] = sum > stiffness && work > 0 && ratio < 1 ? ratio : 1;
  }
}

} // namespace eccentra::contact
