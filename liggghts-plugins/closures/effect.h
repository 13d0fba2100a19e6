// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One effect of the fluid on the particles: a loop over local atoms around one closure. No object exists for an effect
// that is off.
#pragma once

#include "closures/numbers.h"
#include "closures/rheology.h"
#include "link/flow_quantities.h"

#include <memory>
#include <vector>

namespace eccentra::closures {

struct ShapeFactors;
struct OrientedShape;

/// The shapes of a scene, for effects. A "kind" is the number of a shape that particles share.
class ShapeCatalogue {
 public:
  virtual ~ShapeCatalogue() = default;
  /// Number of kinds; they are 0 .. kinds() - 1.
  virtual int kinds() const = 0;
  /// What drag laws know of a kind.
  virtual ShapeFactors factors(int kind) const = 0;
  /// Smallest principal moment of inertia over m R_eq^2; 0.4 for a sphere.
  virtual double inertia_factor(int kind) const = 0;
  /// phi_perp of local atom i for a flow along `direction` (any length, world frame); 1 for a plain sphere.
  virtual double crosswise_sphericity(int i, const double* direction) const = 0;
  /// What forces of the real shape need; null for plain spheres. Solved or read at the first call of a kind: for
  /// set-up, by all ranks together. Valid until the shapes change.
  virtual const OrientedShape* oriented(int) const { return nullptr; }
  /// Turns the body frame of local atom i into the world: w x y z; null for a plain sphere.
  virtual const double* quaternion(int) const { return nullptr; }
};

/// The particles of one rank at one half step of the integrator, as plain arrays; rows are local atoms.
struct HalfStep {
  int count = 0;                       ///< local atoms
  double interval = 0.0;               ///< time over which the forces of this half step act [s]
  double** velocity = nullptr;         ///< [m/s], world frame
  double** force = nullptr;            ///< all other forces when an effect starts; each effect adds its own
  double** spin = nullptr;             ///< [rad/s], world frame
  double** torque = nullptr;           ///< [N m], as `force`
  const double* mass = nullptr;        ///< [kg]
  const double* radius = nullptr;      ///< of the sphere of equal volume [m]
  const int* kind = nullptr;           ///< see ShapeCatalogue
  const int* mask = nullptr;           ///< bits of the groups of an atom
  int group = 0;                       ///< bit of the atoms that feel the fluid
  int integrated = 0;                  ///< bits of the atoms that a fix integrates
  int frozen = 0;                      ///< bits of the atoms that do not move: they load the fluid and receive no force
  double gravity[3] = {0.0, 0.0, 0.0}; ///< [m/s2]
  link::FluidSamples samples;          ///< the flow at the particles' centres, without the arrays that no effect needs
  double (*impulse)[3] = nullptr;      ///< by drag and lifts since the last coupling step [N s]
  double* drag_coefficient = nullptr;  ///< linearised drag times its time, summed like `impulse` [kg]
  double (*last)[4] = nullptr;         ///< drag and lifts of this half step [N], and the linearised drag [kg/s]

  /// interval/m [s/kg], the change of velocity of atom i by a force; 0 if nothing can move it.
  double compliance(int i) const { return (mask[i] & integrated) && !(mask[i] & frozen) ? interval / mass[i] : 0.0; }
  /// Adds a force that the fluid receives with opposite sign (drag and lifts: S_f of eq 2).
  void exchange(int i, const double* f, double coefficient) const {
    for (int k = 0; k < 3; ++k) {
      impulse[i][k] += f[k] * interval;
      last[i][k] += f[k];
    }
    drag_coefficient[i] += coefficient * interval;
    last[i][3] += coefficient;
  }
};

/// Range of validity of a closure in a dimensionless number of the particle.
struct Validity {
  Number number;    ///< which number of the particle
  double low, high; ///< the range in which the closure was measured
};

/// A force, or a torque, of the fluid on all particles of a rank. Effects act one after the other in each half step,
/// drag last, because it is implicit against the sum of the others.
class Effect {
 public:
  virtual ~Effect() = default;
  /// Name in messages and reports.
  virtual const char* name() const = 0;
  /// Name in tables: all drag laws are "drag".
  virtual const char* slot() const { return name(); }
  /// Quantities of the fluid that the closure reads.
  virtual unsigned needs() const = 0;
  /// Prepares data that depend on shapes only; called at set-up.
  virtual void prepare(const ShapeCatalogue&) {}
  /// Adds the force of one half step to all particles of the group.
  virtual void apply(const HalfStep& half_step) = 0;
  /// True if it acts on spins (HalfStep::torque), false if on velocities (HalfStep::force).
  virtual bool is_torque() const { return false; }
  /// Ranges outside of which a warning is given; empty: valid everywhere.
  virtual std::vector<Validity> validity() const { return {}; }
  /// Slot of an effect that must be on if this one is, or null.
  virtual const char* requires_slot() const { return nullptr; }

  /// Sum over this rank's particles of the force (or torque) of the last half step, world frame.
  const double* total() const { return total_; }

 protected:
  double total_[3] = {0.0, 0.0, 0.0}; ///< of this rank's particles [N, or N m]
};

/// In the order in which they act.
using EffectList = std::vector<std::unique_ptr<Effect>>;

} // namespace eccentra::closures
