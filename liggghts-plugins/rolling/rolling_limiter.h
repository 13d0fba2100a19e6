// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rolling friction as a bound, not a force: the contacts of a step, and the torques that stop their relative spins as
// far as each contact's cap allows. No LIGGGHTS types.
//
// The torque of a contact is what would make the relative spin at the next half step zero, given the assembled torque
// of everything else on both particles ("trial spin"), cut at cap = mu R |F_n|. A particle with several contacts shares
// its inertia among them pro rata to their caps (mass splitting), so one sweep stops a particle with one contact
// exactly and never overshoots with many; every contact's torque acts on both partners with opposite signs. Contacts
// start from the torque that they held in the last step, so what one sweep leaves over in a network decays instead of
// creeping.
#pragma once

#include "rolling/rolling_torque.h"

#include <vector>

namespace eccentra::rolling {

/// Spin that a particle would have at the next half step without further torque, and what one unit of torque does to
/// it.
struct TrialSpin {
  Eigen::Vector3d spin; ///< omega + dt T / I [rad/s]
  double compliance;    ///< dt sum(caps) / I [N m * rad/(s N m)]; 0 for a body that does not rotate
};

/// A contact that the limiter may load with torque.
struct LimitedContact {
  int i;                  ///< particle; always one of ours
  int j;                  ///< partner, ours or a ghost; -1 is a wall
  double cap;             ///< [N m]
  Eigen::Vector3d normal; ///< unit normal; zero if torsion is resisted, too
  Eigen::Vector3d torque; ///< on i, now [N m]; already part of the assembled torque
  double* memory;         ///< where the contact remembers its torque; null: it does not (set-up)
};

class RollingLimiter {
 public:
  /// Forgets all contacts; `particles` is the number of local and ghost particles.
  void clear(int particles) {
    pairs_.clear();
    walls_.clear();
    wall_spins_.clear();
    cap_sums_.assign(particles, 0.0);
  }
  bool empty() const { return pairs_.empty() && walls_.empty(); }

  void add_pair(const LimitedContact& contact) {
    cap_sums_[contact.i] += contact.cap;
    cap_sums_[contact.j] += contact.cap;
    pairs_.push_back(contact);
  }
  void add_wall(const LimitedContact& contact, const Eigen::Vector3d& wall_spin) {
    cap_sums_[contact.i] += contact.cap;
    walls_.push_back(contact);
    wall_spins_.push_back(wall_spin);
  }

  /// Sum of the caps of a particle's contacts [N m]; complete for our own particles, not for ghosts.
  double cap_sum(int i) const { return cap_sums_[i]; }

  /// One sweep over all contacts. `trial`: of all local and ghost particles. `apply(i, torque)` is called with each
  /// change of torque on a particle of index < `owned`.
  template <class Apply> void sweep(const std::vector<TrialSpin>& trial, int owned, Apply&& apply);

  /// Stores the torques where the contacts remember them.
  void remember() const;

 private:
  static Eigen::Vector3d correction(LimitedContact& contact, const Eigen::Vector3d& spin, double compliance) {
    if (compliance <= 0.0)
      return Eigen::Vector3d::Zero();
    const Eigen::Vector3d stopping = rolling_part(spin, contact.normal) * (contact.cap / compliance);
    const Eigen::Vector3d torque = bounded(contact.torque - stopping, contact.cap);
    const Eigen::Vector3d change = torque - contact.torque;
    contact.torque = torque;
    return change;
  }

  std::vector<LimitedContact> pairs_;
  std::vector<LimitedContact> walls_;
  std::vector<Eigen::Vector3d> wall_spins_;
  std::vector<double> cap_sums_;
};

template <class Apply> void RollingLimiter::sweep(const std::vector<TrialSpin>& trial, int owned, Apply&& apply) {
  for (LimitedContact& contact : pairs_) {
    const TrialSpin& i = trial[contact.i];
    const TrialSpin& j = trial[contact.j];
    const Eigen::Vector3d change = correction(contact, i.spin - j.spin, i.compliance + j.compliance);
    apply(contact.i, change);
    if (contact.j < owned)
      apply(contact.j, Eigen::Vector3d(-change));
  }
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    const TrialSpin& i = trial[walls_[k].i];
    apply(walls_[k].i, correction(walls_[k], i.spin - wall_spins_[k], i.compliance));
  }
}

inline void RollingLimiter::remember() const {
  const auto store = [](const LimitedContact& contact) {
    if (contact.memory)
      Eigen::Map<Eigen::Vector3d>(contact.memory) = contact.torque;
  };
  for (const LimitedContact& contact : pairs_)
    store(contact);
  for (const LimitedContact& contact : walls_)
    store(contact);
}

} // namespace eccentra::rolling
