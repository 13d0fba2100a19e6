// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sub-contacts through LIGGGHTS's own contact models: its classes, given the sub-spheres of bodies.
#pragma once

#include "base/option_reader.h"
#include "contact/contact_law.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

/// Which radii a rolling model sees: those of the sub-spheres, or the distances of the contact point from the bodies'
/// centres (|r_ij| of eq 19).
enum class RollingRadius { sub_sphere, body };

/// Names of stock's models, as a user types them.
struct StockModelNames {
  std::string normal = "off", tangential = "off", rolling = "off", cohesion = "off";
};

/// A sub-contact of body A with body B or a wall. World frame, SI. Velocities are those of the sub-spheres' centres.
struct StockSubContact {
  // In.
  int a, b;                  ///< local or ghost index; of a wall: minus the wall's type
  int type_a, type_b;        ///< materials
  double separation[3];      ///< from B's sub-sphere (or the wall's nearest point) to the centre of A's [m]
  double radius_a, radius_b; ///< [m]; of a wall: 0
  double velocity_a[3], velocity_b[3];
  double omega_a[3], omega_b[3];
  double arm_a[3], arm_b[3];         ///< from the bodies' centres to the sub-spheres' [m]
  double mass_a, mass_b;             ///< of the bodies [kg]
  double mass;                       ///< effective [kg]
  double share = 1;                  ///< of the dampers
  double volume_a = 0, volume_b = 0; ///< of the bodies [m3]; 0 for single spheres and walls
  double step = 0;                   ///< time step [s]
  double* history;                   ///< StockContact::history_size() values
  bool advance;                      ///< history moves on
  // Out.
  double force[3];                 ///< on A [N]; B gets the opposite
  double torque_a[3], torque_b[3]; ///< on the bodies about the centres of their sub-spheres [N m]
  double normal[3], overlap;       ///< unit, from B to A; [m], negative across a gap
  double kn, kt, gamma_n, gamma_t; ///< of the normal model
  bool touches;                    ///< the sub-spheres overlap
  bool acts;                       ///< there is a force
};

struct BegunContact;

class StockContact {
 public:
  StockContact(LAMMPS_NS::LAMMPS* lmp, bool wall);
  ~StockContact();
  StockContact(const StockContact&) = delete;
  StockContact& operator=(const StockContact&) = delete;

  /// Reads the name of a model of `kind` (model, tangential, rolling_friction, cohesion): one that LIGGGHTS as it is
  /// installed has, or a row of contact_models(). Throws std::invalid_argument with a sentence that lists them.
  static std::string read_name(base::OptionReader& reader, const std::string& kind);
  /// The names that LIGGGHTS has of that kind, each after a comma.
  static std::string known(const std::string& kind);

  /// Makes the models. `options` are keywords and values that they may ask for. Throws std::invalid_argument with one
  /// sentence where a model does not know one of them.
  void choose(const StockModelNames& names, const std::vector<std::string>& options);
  const StockModelNames& names() const { return names_; }
  int history_size() const;
  /// Before each run: fetches the materials.
  void connect();
  /// Before the pairs of each step: ghosts have the liquid of their bodies, which LIGGGHTS sends with new lists alone.
  void begin_step();
  /// p of F ~ overlap^p.
  double exponent() const;
  /// Sub-spheres interact up to this multiple of the sum of their radii; 1 where nothing reaches across a gap.
  double reach() const { return reach_; }
  /// How the tangential spring advances and what bounds it (contact_law.h); stock's ways where nothing else is said.
  void set_tangential(bool synchronised, contact::FrictionBound bound) {
    synchronised_ = synchronised;
    bound_ = bound;
  }
  void set_rolling_radius(RollingRadius radius) { rolling_radius_ = radius; }
  /// The three values of the tangential displacement in a contact's history; null where there is none.
  double* displacement(double* history) const { return shear_ < 0 ? nullptr : history + shear_; }

  /// Stiffness and damping alone (kn, kt, gamma_n, gamma_t); history stays.
  void stiffness(StockSubContact& contact);
  /// The forces of n contacts. Those that share dampers need kn of all of them first: `begin` gives it with the normal
  /// force, whose history moves on, and `finish` takes the shares. Between the two the contacts stay where they are.
  void begin(StockSubContact* contacts, int n);
  void finish(StockSubContact* contacts, int n);

 private:
  struct Models;
  void synchronise(BegunContact& begun, const StockSubContact& contact);
  double elastic_force(const BegunContact& begun, const StockSubContact& contact);
  void keep_share(BegunContact& begun, double share);
  void cohesion(int n);
  void rolling(const StockSubContact* contacts, int n);
  void tangential(const StockSubContact* contacts, int n);
  void close(BegunContact& begun, const StockSubContact& contact);
  LAMMPS_NS::LAMMPS* lmp_;
  bool wall_;
  double reach_ = 1;
  RollingRadius rolling_radius_ = RollingRadius::sub_sphere;
  bool synchronised_ = false;
  bool viscous_ = false; ///< the normal model's damping depends on the velocity
  contact::FrictionBound bound_ = contact::FrictionBound::stock;
  int shear_ = -1;              ///< where history keeps it
  double** friction_ = nullptr; ///< Coulomb's coefficient
  StockModelNames names_;
  std::unique_ptr<Models> models_;
};

} // namespace eccentra::styles
