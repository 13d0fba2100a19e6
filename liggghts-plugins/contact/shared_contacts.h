// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of several simultaneous contacts between the same two bodies: what `contacts shared` means; pure.
#pragma once

#include "contact/contact_law.h"
#include "contact/impact_mass.h"

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

/// Springs in parallel add, but dampers tuned to each spring alone do not: N equal contacts with gamma_k(S_k) each add
/// up to sqrt(N) times what returns e (stock: e_eff = e^sqrt(N)). What does return e, for any elastic force F with work
/// W, is gamma = 2 beta sqrt(m*) F / sqrt(2 W): in the variable sqrt(2 W) the impact is then a damped linear
/// oscillator. With contacts whose force is S d^p / p each (Hertz p = 3/2, Hooke p = 1; S = dF/dd, d the overlap) this
/// is the damper of one contact with S' = (sum S d)^2 / sum S d^2, N S for N equal contacts. So `contacts shared` hands
/// that damping out in proportion to stiffness: contact k keeps the fraction sqrt(S_k S') / sum S of its own. Sums run
/// over all contacts of this pair of bodies, weighted by (n_j . n_k)^2: one contact keeps its damping, contacts with
/// one normal share, contacts at right angles do not know of each other. It varies smoothly as contacts come and go,
/// and as only dissipation is scaled, the elastic forces stay those of the potential sum: sharing cannot create energy.
/// Secant stiffness serves as S within one model. `sum`, `force` and `work` are the weighted sums of S, S d and S d^2.
/// What is returned is the square of the fraction.
inline Ratio squared_damping_share(double stiffness, double sum, double force, double work) {
  const double over = force * force * stiffness, under = sum * sum * work;
  const bool shares = sum > stiffness && over < under;
  return {shares ? over : 1, shares ? under : 1};
}

/// What many contacts of one pair of bodies see of each other along a normal, by tensors: sums weighted by n n^T.
class SharedTensors {
 public:
  /// What a contact sees along its normal.
  struct Sums {
    /// [N/m], [N] and [N m], weighted by the squares of the cosines between the normals.
    double stiffness = 0, force = 0, work = 0;
    double arm[3] = {0, 0, 0}; ///< weighted by stiffness

    /// A contact along the same normal; arguments as those of SharedTensors::add.
    template <class Vector> void add(double of_one, double overlap, const Vector& to) {
      stiffness += of_one;
      force += of_one * overlap;
      work += of_one * overlap * overlap;
      for (int d = 0; d < 3; ++d)
        arm[d] += of_one * to[d];
    }
  };
  /// A contact: stiffness [N/m], overlap [m], unit normal and arm from the body's centre [m].
  template <class Vector> void add(double stiffness, double overlap, const Vector& n, const Vector& arm) {
    const double products[6] = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[0] * n[2], n[1] * n[2]};
    for (int k = 0; k < 6; ++k) {
      const double weight = stiffness * products[k];
      sums_[k].stiffness += weight;
      sums_[k].force += weight * overlap;
      sums_[k].work += weight * overlap * overlap;
      for (int d = 0; d < 3; ++d)
        sums_[k].arm[d] += weight * arm[d];
    }
  }
  /// The sums along a unit vector.
  template <class Vector> Sums along(const Vector& n) const {
    const double products[6] = {n[0] * n[0],     n[1] * n[1],     n[2] * n[2],
                                2 * n[0] * n[1], 2 * n[0] * n[2], 2 * n[1] * n[2]};
    Sums all;
    for (int k = 0; k < 6; ++k) {
      all.stiffness += sums_[k].stiffness * products[k];
      all.force += sums_[k].force * products[k];
      all.work += sums_[k].work * products[k];
      for (int d = 0; d < 3; ++d)
        all.arm[d] += sums_[k].arm[d] * products[k];
    }
    return all;
  }

 private:
  Sums sums_[6]; // xx, yy, zz, xy, xz, yz
};

/// The contacts first..last-1 of a block: those of one pair of bodies, or of a body and a wall.
struct ContactGroup {
  /// First contact, and the one after the last.
  int first, last;
};

/// Multiplies the damping of contacts by their shares and by the roots of the masses that they feel, each along its own
/// normal. Pairs, walls, bodies that rest and blocks of any size all come here. Contact k sees the others of its group
/// weighted by (n_j . n_k)^2, and acts with them at their mean arm, weighted by stiffness: a body that lands on a face
/// is hit in the centre though none of its contacts is.
class DampingShares {
 public:
  /// `group(k)` is the ContactGroup k of `groups`; `group_of` tells the group of each of the n contacts. `bodies` has a
  /// row for each group. Rows of the block up to whole vectors hold finite numbers.
  template <class Block, class Groups>
  void apply(Block& c, int n, const int* group_of, int groups, const Groups& group, const ImpactRows& bodies) {
    start(c, whole_vectors(n));
    for (int k = 0; k < groups; ++k)
      meet(c, group(k));
    if (bodies.alike)
      finish<true>(c, n, group_of, bodies);
    else
      finish<false>(c, n, group_of, bodies);
  }

 private:
  static constexpr int kEachWithEach = 8; ///< up to so many contacts share each with each, more by way of tensors
  static constexpr double kOneNormal = 1 - 1e-12;

  /// Each contact's own terms, and its arm times its stiffness, in rows that contact_forces writes later.
  template <class Block> static void start(Block& c, int n) {
#pragma GCC ivdep
    for (int m = 0; m < n; ++m) {
      const double stiffness = c.kn[m], force = stiffness * c.overlap[m];
      c.stiffness_sum[m] = stiffness;
      c.force_sum[m] = force;
      c.work_sum[m] = force * c.overlap[m];
      const double reach = c.radius_a[m] - 0.5 * c.overlap[m];
      for (int d = 0; d < 3; ++d)
        c.force[d][m] = c.torque[d][m] = stiffness * (c.arm[d][m] - reach * c.normal[d][m]);
    }
  }

  /// Adds what the contacts of a group see of each other to the sums and, weighted by stiffness, to the arms in
  /// `force`.
  template <class Block> static void meet(Block& c, const ContactGroup& g) {
    if (g.last - g.first > kEachWithEach) {
      meet_by_tensors(c, g);
      return;
    }
    for (int j = g.first; j < g.last; ++j)
      for (int k = j + 1; k < g.last; ++k) {
        const double weight = weight_of(c, j, k);
        const double stiffness_j = weight * c.kn[j], stiffness_k = weight * c.kn[k];
        const double force_j = stiffness_j * c.overlap[j], force_k = stiffness_k * c.overlap[k];
        c.stiffness_sum[j] += stiffness_k;
        c.force_sum[j] += force_k;
        c.work_sum[j] += force_k * c.overlap[k];
        c.stiffness_sum[k] += stiffness_j;
        c.force_sum[k] += force_j;
        c.work_sum[k] += force_j * c.overlap[j];
        for (int d = 0; d < 3; ++d) {
          c.force[d][j] += weight * c.torque[d][k];
          c.force[d][k] += weight * c.torque[d][j];
        }
      }
  }

  /// The same for many contacts; plain sums where all of them have one normal, which need no tensors.
  template <class Block> static void meet_by_tensors(Block& c, const ContactGroup& g) {
    double least = 1;
    for (int k = g.first + 1; k < g.last; ++k)
      least = std::min(least, weight_of(c, g.first, k));
    const bool one_normal = least > kOneNormal;
    SharedTensors tensors;
    SharedTensors::Sums all;
    for (int k = g.first; k < g.last; ++k) {
      const double inverse = 1 / (c.kn[k] + kTiny);
      const double arm[3] = {c.torque[0][k] * inverse, c.torque[1][k] * inverse, c.torque[2][k] * inverse};
      const double normal[3] = {c.normal[0][k], c.normal[1][k], c.normal[2][k]};
      if (one_normal)
        all.add(c.kn[k], c.overlap[k], arm);
      else
        tensors.add(c.kn[k], c.overlap[k], normal, arm);
    }
    for (int k = g.first; k < g.last; ++k) {
      const double normal[3] = {c.normal[0][k], c.normal[1][k], c.normal[2][k]};
      const SharedTensors::Sums sums = one_normal ? all : tensors.along(normal);
      c.stiffness_sum[k] = sums.stiffness;
      c.force_sum[k] = sums.force;
      c.work_sum[k] = sums.work;
      for (int d = 0; d < 3; ++d)
        c.force[d][k] = sums.arm[d];
    }
  }

  template <class Block> static double weight_of(const Block& c, int j, int k) {
    const double cosine =
        c.normal[0][j] * c.normal[0][k] + c.normal[1][j] * c.normal[1][k] + c.normal[2][j] * c.normal[2][k];
    return cosine * cosine;
  }

  /// Share and impact factor of each contact, from its sums. Whole vectors at a time; unused lanes take the last group.
  template <bool alike, class Block>
  static void finish(Block& c, int n, const int* group_of, const ImpactRows& bodies) {
    for (int start = 0; start < n; start += contact_width) {
      ImpactTable<contact_width> pairs;
      pairs.copy(0, bodies, 0, false);
      for (int k = 0; k < contact_width; ++k)
        pairs.copy(k, bodies, group_of[std::min(start + k, n - 1)], alike);
#pragma GCC ivdep
      for (int k = 0; k < contact_width; ++k) {
        const int m = start + k;
        const Ratio mass = impact_mass<alike>(pairs, k, c.normal[0][m], c.normal[1][m], c.normal[2][m], c.force[0][m],
                                              c.force[1][m], c.force[2][m], c.stiffness_sum[m]);
        const Ratio part = squared_damping_share(c.kn[m], c.stiffness_sum[m], c.force_sum[m], c.work_sum[m]);
        const double share = std::sqrt(part.over * mass.over / (part.under * mass.under));
        c.share[m] = share;
        c.gamma_n[m] *= share;
        c.gamma_t[m] *= share;
      }
    }
  }

  static constexpr double kTiny = 1e-100; ///< keeps 0/0 out where an overlap rounds to 0
};

} // namespace eccentra::contact
