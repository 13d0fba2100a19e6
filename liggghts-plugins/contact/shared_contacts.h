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
inline double damping_share(double stiffness, double sum, double force, double work) {
  constexpr double tiny = 1e-100; // keeps 0/0 out where an overlap rounds to 0
  const double ratio = force / (sum + tiny) * std::sqrt(stiffness / (work + tiny));
  return sum > stiffness && work > 0 && ratio < 1 ? ratio : 1;
}

/// What many contacts of one pair of bodies see of each other along a normal, by tensors: sums weighted by n n^T.
class SharedTensors {
 public:
  /// What a contact sees along its normal.
  struct Sums {
    /// [N/m], [N] and [N m], weighted by the squares of the cosines between the normals.
    double stiffness = 0, force = 0, work = 0;
    double arm[3] = {0, 0, 0}; ///< weighted by stiffness
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
/// normal. Pairs, walls, bodies that rest and blocks of any size all come here. Contacts of a group whose normals are
/// one are taken together: they act as one at their mean arm, weighted by stiffness, as a body that lands on a face is
/// hit in the centre though none of its contacts is. Where normals disagree, contact k sees the others weighted by
/// (n_j . n_k)^2.
class DampingShares {
 public:
  /// `group(k)` is the ContactGroup k of `groups`, at most ImpactRows::capacity; `group_of` tells the group of each of
  /// the n contacts. `bodies` has a row for each group, whose normal, arm and factor are written here. Rows of the
  /// block up to whole vectors hold finite numbers.
  template <class Block, class Groups>
  void apply(Block& c, int n, const int* group_of, int groups, const Groups& group, ImpactRows& bodies) {
    const int padded = whole_vectors(n);
    start(c, padded);
    double weight[ImpactRows::capacity];
    sum_arms(c, n, group_of, groups, weight, bodies);
    any_apart_ = false;
    for (int k = 0; k < groups; ++k) {
      const ContactGroup g = group(k);
      apart_[k] = g.last - g.first > 1 && !meet(c, g);
      any_apart_ |= apart_[k];
      for (int d = 0; d < 3; ++d)
        bodies.normal[d][k] = c.normal[d][g.first];
    }
    constexpr double tiny = 1e-100;
    for (int d = 0; d < 3; ++d)
      for (int k = 0; k < groups; ++k)
        bodies.arm[d][k] /= weight[k] + tiny;
    finish(c, padded);
    impact_factors(bodies, whole_vectors(groups));
    if (any_apart_) {
      rows_in_use_ = 0;
      for (int k = 0; k < groups; ++k)
        if (apart_[k])
          take_apart(c, group(k), bodies, k);
      flush(c);
    }
    for (int m = 0; m < n; ++m)
      c.share[m] *= bodies.factor[group_of[m]];
#pragma GCC ivdep
    for (int m = 0; m < padded; ++m) {
      c.gamma_n[m] *= c.share[m];
      c.gamma_t[m] *= c.share[m];
    }
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
      c.torque[0][m] = stiffness * (c.arm[0][m] - reach * c.normal[0][m]);
      c.torque[1][m] = stiffness * (c.arm[1][m] - reach * c.normal[1][m]);
      c.torque[2][m] = stiffness * (c.arm[2][m] - reach * c.normal[2][m]);
    }
  }

  /// One loop over all contacts: with one over those of each group the processor would guess each one's end.
  template <class Block>
  static void sum_arms(const Block& c, int n, const int* group_of, int groups, double* weight, ImpactRows& bodies) {
    for (int k = 0; k < groups; ++k)
      weight[k] = bodies.arm[0][k] = bodies.arm[1][k] = bodies.arm[2][k] = 0;
    for (int m = 0; m < n; ++m) {
      const int k = group_of[m];
      weight[k] += c.kn[m];
      for (int d = 0; d < 3; ++d)
        bodies.arm[d][k] += c.torque[d][m];
    }
  }

  /// Adds what the contacts of a group see of each other; true if all of them have one normal. Many do so later.
  template <class Block> static bool meet(Block& c, const ContactGroup& g) {
    double least = 1;
    if (g.last - g.first > kEachWithEach) {
      for (int k = g.first + 1; k < g.last; ++k)
        least = std::min(least, weight_of(c, g.first, k));
      if (least > kOneNormal)
        meet_as_one(c, g);
      return least > kOneNormal;
    }
    for (int j = g.first; j < g.last; ++j)
      for (int k = j + 1; k < g.last; ++k) {
        const double weight = weight_of(c, j, k);
        least = std::min(least, weight);
        const double stiffness_j = weight * c.kn[j], stiffness_k = weight * c.kn[k];
        const double force_j = stiffness_j * c.overlap[j], force_k = stiffness_k * c.overlap[k];
        c.stiffness_sum[j] += stiffness_k;
        c.force_sum[j] += force_k;
        c.work_sum[j] += force_k * c.overlap[k];
        c.stiffness_sum[k] += stiffness_j;
        c.force_sum[k] += force_j;
        c.work_sum[k] += force_j * c.overlap[j];
      }
    return least > kOneNormal;
  }

  template <class Block> static void meet_as_one(Block& c, const ContactGroup& g) {
    double stiffness = 0, force = 0, work = 0;
    for (int k = g.first; k < g.last; ++k) {
      stiffness += c.stiffness_sum[k];
      force += c.force_sum[k];
      work += c.work_sum[k];
    }
    for (int k = g.first; k < g.last; ++k) {
      c.stiffness_sum[k] = stiffness;
      c.force_sum[k] = force;
      c.work_sum[k] = work;
    }
  }

  template <class Block> static double weight_of(const Block& c, int j, int k) {
    const double cosine =
        c.normal[0][j] * c.normal[0][k] + c.normal[1][j] * c.normal[1][k] + c.normal[2][j] * c.normal[2][k];
    return cosine * cosine;
  }

  template <class Block> static void finish(Block& c, int n) {
#pragma GCC ivdep
    for (int m = 0; m < n; ++m)
      c.share[m] = damping_share(c.kn[m], c.stiffness_sum[m], c.force_sum[m], c.work_sum[m]);
  }

  /// A row of its own for each contact of a group whose normals disagree.
  template <class Block> void take_apart(Block& c, const ContactGroup& g, ImpactRows& bodies, int k) {
    bodies.factor[k] = 1;
    const bool many = g.last - g.first > kEachWithEach;
    SharedTensors tensors;
    for (int j = g.first; many && j < g.last; ++j) {
      const double reach = c.radius_a[j] - 0.5 * c.overlap[j];
      const double n[3] = {c.normal[0][j], c.normal[1][j], c.normal[2][j]};
      const double arm[3] = {c.arm[0][j] - reach * n[0], c.arm[1][j] - reach * n[1], c.arm[2][j] - reach * n[2]};
      tensors.add(c.kn[j], c.overlap[j], n, arm);
    }
    constexpr double tiny = 1e-100;
    for (int m = g.first; m < g.last; ++m) {
      const double n[3] = {c.normal[0][m], c.normal[1][m], c.normal[2][m]};
      SharedTensors::Sums sums;
      if (many) {
        sums = tensors.along(n);
        c.share[m] = damping_share(c.kn[m], sums.stiffness, sums.force, sums.work);
      } else {
        sums.stiffness = c.stiffness_sum[m];
        for (int j = g.first; j < g.last; ++j) {
          const double weight = j == m ? 1 : weight_of(c, j, m);
          for (int d = 0; d < 3; ++d)
            sums.arm[d] += weight * c.torque[d][j];
        }
      }
      const int row = rows_in_use_++;
      rows_.copy_bodies(row, bodies, k);
      for (int d = 0; d < 3; ++d) {
        rows_.normal[d][row] = n[d];
        rows_.arm[d][row] = sums.arm[d] / (sums.stiffness + tiny);
      }
      contact_of_[row] = m;
      if (rows_in_use_ == ImpactRows::capacity)
        flush(c);
    }
  }

  template <class Block> void flush(Block& c) {
    impact_factors(rows_, whole_vectors(rows_in_use_));
    for (int k = 0; k < rows_in_use_; ++k)
      c.share[contact_of_[k]] *= rows_.factor[k];
    rows_in_use_ = 0;
  }

  ImpactRows rows_ = {};
  int contact_of_[ImpactRows::capacity];
  bool apart_[ImpactRows::capacity];
  bool any_apart_ = false;
  int rows_in_use_ = 0;
};

} // namespace eccentra::contact
