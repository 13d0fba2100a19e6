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

#include "contact/rolling_torque.h"

#include <vector>

namespace eccentra::contact {

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
  Eigen::Vector3d torque; ///< on i from the last step [N m]; already part of the assembled torque
  double* memory;         ///< where the contact remembers its torque; null: it does not (set-up)
};

/// A growing list whose places are filled in where they lie: one is written per contact and step.
class ContactList {
 public:
  /// Forgets all contacts and keeps their memory.
  void clear() { count_ = 0; }
  /// Number of contacts.
  std::size_t size() const { return count_; }
  /// The next one, to be filled in.
  LimitedContact& next() {
    if (count_ == places_.size())
      places_.resize(2 * count_ + 64);
    return places_[count_++];
  }
  /// First contact.
  const LimitedContact* begin() const { return places_.data(); }
  /// Behind the last contact.
  const LimitedContact* end() const { return places_.data() + count_; }

 private:
  std::vector<LimitedContact> places_;
  std::size_t count_ = 0;
};

/// The contacts of a step and their sweep, as the head of this file describes them.
class RollingLimiter {
 public:
  /// Forgets all contacts; `particles` is the number of local and ghost particles.
  void clear(int particles) {
    pairs_.clear();
    walls_.clear();
    wall_spins_.clear();
    cap_sums_.assign(particles, 0.0);
  }

  /// A contact of particles i and j (>= 0) with this cap, the rest of which the caller fills in.
  LimitedContact& add_pair(int i, int j, double cap) {
    cap_sums_[i] += cap;
    cap_sums_[j] += cap;
    LimitedContact& contact = pairs_.next();
    contact.i = i;
    contact.j = j;
    contact.cap = cap;
    return contact;
  }
  /// A contact of particle i with a wall that spins [rad/s].
  LimitedContact& add_wall(int i, double cap, const Eigen::Vector3d& wall_spin) {
    cap_sums_[i] += cap;
    wall_spins_.push_back(wall_spin);
    LimitedContact& contact = walls_.next();
    contact.i = i;
    contact.j = -1;
    contact.cap = cap;
    return contact;
  }

  /// Sum of the caps of a particle's contacts [N m]; complete for our own particles, not for ghosts.
  double cap_sum(int i) const { return cap_sums_[i]; }

  /// One sweep over all contacts, which then remember their torques. `trial`: of all local and ghost particles.
  /// `apply(i, torque)` is called with each change of torque on a particle of index < `owned`.
  template <class Apply> void sweep(const std::vector<TrialSpin>& trial, int owned, Apply&& apply);

 private:
  static Eigen::Vector3d correction(const LimitedContact& contact, const Eigen::Vector3d& spin, double compliance) {
    if (compliance <= 0.0)
      return Eigen::Vector3d::Zero();
    const Eigen::Vector3d stopping = rolling_part(spin, contact.normal) * (contact.cap / compliance);
    const Eigen::Vector3d torque = bounded(contact.torque - stopping, contact.cap);
    if (contact.memory)
      Eigen::Map<Eigen::Vector3d>(contact.memory) = torque;
    return torque - contact.torque;
  }

  ContactList pairs_;
  ContactList walls_;
  std::vector<Eigen::Vector3d> wall_spins_;
  std::vector<double> cap_sums_;
};

template <class Apply> void RollingLimiter::sweep(const std::vector<TrialSpin>& trial, int owned, Apply&& apply) {
  for (const LimitedContact& contact : pairs_) {
    const TrialSpin& i = trial[contact.i];
    const TrialSpin& j = trial[contact.j];
    const Eigen::Vector3d change = correction(contact, i.spin - j.spin, i.compliance + j.compliance);
    apply(contact.i, change);
    if (contact.j < owned)
      apply(contact.j, Eigen::Vector3d(-change));
  }
  const Eigen::Vector3d* wall_spin = wall_spins_.data();
  for (const LimitedContact& contact : walls_) {
    const TrialSpin& i = trial[contact.i];
    apply(contact.i, correction(contact, i.spin - *wall_spin++, i.compliance));
  }
}

} // namespace eccentra::contact
