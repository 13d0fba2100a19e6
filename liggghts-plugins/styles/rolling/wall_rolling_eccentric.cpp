// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// rolling_friction eccentric at our walls: eq (32) with the shape that pair_style gives the spheres.
#include "base/option_reader.h"
#include "styles/rolling/fix_sphere_orientation.h"
#include "styles/rolling/wall_rolling.h"

#include <stdexcept>

namespace eccentra::styles {
namespace {

class EccentricWallRolling : public WallRolling {
 public:
  bool read_keyword(base::OptionReader& reader) override {
    if (reader.peek() == "shape")
      throw std::invalid_argument(
          "the shape belongs to the particles: give 'shape ...' in pair_style, not at the wall");
    if (reader.peek() != "rockingDamping")
      return false;
    reader.keyword();
    damping_ = reader.factor();
    return true;
  }

  void init(LAMMPS_NS::LAMMPS* lmp) override {
    spheres_ = FixSphereOrientation::find(lmp);
    if (!spheres_)
      throw std::invalid_argument("rolling_friction eccentric takes the shape from pair_style: give pair_style gran "
                                  "... rolling_friction eccentric shape ..., too");
  }

  bool for_clusters() const override { return false; }

  Eigen::Vector3d torque(const WallRollingContact& contact) override {
    const double* const q = spheres_->orientation(contact.atom);
    const double depth = contact.elastic_normal / (contact.stiffness * contact.lever);
    const double damper = spheres_->damper(contact.normal_damping, damping_, contact.mass);
    const contact::ContactLoad load{contact.normal_force, damper * contact.lever,
                                    contact.normal.cross(contact.angular_velocity)};
    return contact.lever *
           contact::turned_moment(spheres_->shape(), {q[0], q[1], q[2], q[3]}, -contact.normal, depth, load)
               .cross(contact.normal);
  }

 private:
  double damping_ = 1; ///< of rocking, over that of the contact's normal damper
  FixSphereOrientation* spheres_ = nullptr;
};

const RegisterWallRolling registered("eccentric", [] { return std::make_unique<EccentricWallRolling>(); });

} // namespace
} // namespace eccentra::styles
