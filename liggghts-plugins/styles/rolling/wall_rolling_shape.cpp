// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// rolling_friction shape at walls: eq (19) with the coefficient of eq (33), in the three forms of the pair model.
#include "base/option_reader.h"
#include "contact/rolling_torque.h"
#include "styles/rolling/coefficients.h"
#include "styles/rolling/fix_rolling_limited.h"
#include "styles/rolling/wall_rolling.h"

#include "force.h"
#include "lammps.h"
#include "property_registry.h"
#include "update.h"

#include <cstdlib>
#include <stdexcept>

namespace eccentra::styles {

namespace {

class ShapeRolling : public WallRolling {
 public:
  bool read_keyword(base::OptionReader& reader) override {
    const std::string& word = reader.peek();
    if (word != "form" && word != "torsionTorque" && word != "rollingDampingRatio")
      return false;
    reader.keyword();
    if (word == "form") {
      const std::string& form = reader.choice({"limited", "directional", "epsd"});
      form_ = form == "limited" ? Form::limited : form == "directional" ? Form::directional : Form::epsd;
    } else if (word == "torsionTorque") {
      torsion_ = reader.on_off();
    } else {
      damping_ratio_ = reader.at_least(0);
    }
    return true;
  }

  void init(LAMMPS_NS::LAMMPS* lmp) override {
    lmp_ = lmp;
    PropertyRegistry& registry = lmp->force->registry;
    const char* caller = "wall/gran/cluster rolling_friction shape";
    registry.registerProperty("eccentraRollingFriction", &create_rolling_coefficient);
    registry.registerProperty("eccentraShapeRollingFriction", &create_shape_coefficient);
    registry.connect("eccentraRollingFriction", mu_r_, caller);
    registry.connect("eccentraShapeRollingFriction", mu_shape_, caller);
    if (form_ != Form::limited)
      return;
    FixRollingLimited* fix = FixRollingLimited::find(lmp);
    if (!fix)
      throw std::invalid_argument(
          "rolling_friction shape form limited at a wall needs the same form in pair_style (with "
          "coefficients 0 where the particles have none): or use form epsd or directional");
    limiter_ = &fix->limiter();
  }

  Eigen::Vector3d torque(const WallRollingContact& contact) override {
    const double coefficient = contact::effective_coefficient(mu_r_[contact.atom_type][contact.wall_type],
                                                              mu_shape_[contact.atom_type][contact.wall_type]);
    const double cap = contact::torque_cap(coefficient, contact.lever, contact.elastic_normal);
    const Eigen::Vector3d spin =
        torsion_ ? contact.angular_velocity : contact::rolling_part(contact.angular_velocity, contact.normal);
    if (form_ == Form::directional)
      return contact::directional_torque(spin, cap);
    Eigen::Map<Eigen::Vector3d> memory(contact.memory);
    const Eigen::Vector3d held = torsion_ ? Eigen::Vector3d(memory) : contact::rolling_part(memory, contact.normal);
    if (form_ == Form::limited)
      return limited(contact, contact::bounded(held, cap), cap);
    constexpr double solid_sphere_about_contact = 1.4; // 2/5 m r^2 + m r^2
    const contact::SpringDashpot torque = contact::spring_dashpot(
        held, spin, contact::rolling_stiffness(contact.stiffness, coefficient, contact.lever), cap,
        solid_sphere_about_contact * contact.mass * contact.lever * contact.lever, damping_ratio_, lmp_->update->dt);
    if (contact.advance)
      memory = torque.spring;
    return torque.total;
  }

 private:
  enum class Form { limited, directional, epsd };

  /// The torque that the contact holds already; the limiter changes it once the torques of all contacts are known.
  Eigen::Vector3d limited(const WallRollingContact& contact, const Eigen::Vector3d& held, double cap) {
    contact::LimitedContact& reported = limiter_->add_wall(contact.atom, cap, contact.wall_spin);
    reported.normal = torsion_ ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : contact.normal;
    reported.torque = held;
    reported.memory = contact.advance ? contact.memory : nullptr;
    return held;
  }

  Form form_ = Form::limited;
  bool torsion_ = true;
  double damping_ratio_ = 0.3; // Ai et al. (2011)
  LAMMPS_NS::LAMMPS* lmp_ = nullptr;
  double** mu_r_ = nullptr;
  double** mu_shape_ = nullptr;
  contact::RollingLimiter* limiter_ = nullptr;
};

const RegisterWallRolling registered("shape", [] { return std::make_unique<ShapeRolling>(); });

} // namespace

} // namespace eccentra::styles
