// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Constant directional torque at walls: stock `rolling_friction cdt`, with the spin taken relative to the wall.
#include "base/option_reader.h"
#include "styles/rolling/wall_rolling.h"

#include "force.h"
#include "global_properties.h"
#include "lammps.h"
#include "property_registry.h"

namespace eccentra::styles {

std::map<std::string, WallRollingCreator>& wall_rolling_models() {
  static std::map<std::string, WallRollingCreator> models;
  return models;
}

namespace {

class ConstantDirectionalTorque : public WallRolling {
 public:
  bool read_keyword(base::OptionReader& reader) override {
    if (reader.peek() != "torsionTorque")
      return false;
    reader.keyword();
    torsion_ = reader.on_off();
    return true;
  }

  void init(LAMMPS_NS::LAMMPS* lmp) override {
    auto& registry = lmp->force->registry;
    const char* caller = "wall/gran/cluster rolling_friction cdt";
    registry.registerProperty("coeffRollFrict", &MODEL_PARAMS::createCoeffRollFrict);
    registry.connect("coeffRollFrict", coefficient_, caller);
  }

  Eigen::Vector3d torque(const WallRollingContact& contact) override {
    const double spin = contact.angular_velocity.norm();
    if (spin == 0.0)
      return Eigen::Vector3d::Zero();
    const double size = coefficient_[contact.atom_type][contact.wall_type] * contact.elastic_normal * contact.lever;
    Eigen::Vector3d torque = contact.angular_velocity * (-size / spin);
    if (!torsion_)
      torque -= torque.dot(contact.normal) * contact.normal;
    return torque;
  }

 private:
  double** coefficient_ = nullptr;
  bool torsion_ = false;
};

const RegisterWallRolling registered("cdt", [] { return std::make_unique<ConstantDirectionalTorque>(); });

} // namespace

} // namespace eccentra::styles
