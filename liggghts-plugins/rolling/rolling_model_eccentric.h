// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contact model `rolling_friction eccentric`: eq (32), the torque r_c x F_n of the shape at the sphere's present
// orientation.
#ifdef ROLLING_MODEL
ROLLING_MODEL(ROLLING_ECCENTRIC, eccentric, 21)
#else
#ifndef ECCENTRA_ROLLING_MODEL_ECCENTRIC_H
#define ECCENTRA_ROLLING_MODEL_ECCENTRIC_H
#include "contact_models.h"

#include "rolling/contact_words.h"
#include "rolling/fix_sphere_orientation.h"
#include "rolling/wall_spin.h"

#include "rolling_model_base.h"

#include "error.h"
#include "force.h"

namespace LIGGGHTS {
namespace ContactModels {

template <> class RollingModel<ROLLING_ECCENTRIC> : public RollingModelBase {
 public:
  RollingModel(LAMMPS* lmp, IContactHistorySetup* history, ContactModelBase* contact_model)
      : RollingModelBase(lmp, history, contact_model), is_wall_(contact_model->is_wall()), wall_spin_(history) {}

  void registerSettings(Settings& settings) {
    eccentra::rolling::register_shape_words(settings, shape_words_);
    settings.registerOnOff("rockingDamping", damped_, true);
    settings.registerDoubleSetting("orientationSeed", seed_, 1.0);
  }

  inline void postSettings(IContactHistorySetup*, ContactModelBase*) {}

  void connectToProperties(PropertyRegistry&) {
    using eccentra::rolling::FixSphereOrientation;
    if (force->cg_active())
      error->cg(FLERR, "rolling_friction eccentric");
    if (is_wall_) {
      if (!shape_words_.empty())
        error->all(
            FLERR,
            "rolling_friction eccentric: the shape belongs to the particles: give 'shape ...' in pair_style, not "
            "at the wall");
      wall_spin_.refresh();
      spheres_ = FixSphereOrientation::find(lmp);
      if (!spheres_)
        error->all(FLERR,
                   "rolling_friction eccentric at a wall takes the shape from pair_style: give pair_style gran ... "
                   "rolling_friction eccentric shape ..., too");
      return;
    }
    if (shape_words_.empty())
      error->all(
          FLERR,
          "rolling_friction eccentric needs a shape: add, for example, 'shape cube 64' to the pair_style line (again "
          "after read_restart)");
    spheres_ = FixSphereOrientation::make(lmp, shape_words_, static_cast<long>(seed_));
  }

  void surfacesIntersect(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j) {
    const Eigen::Vector3d normal(contact.en[0], contact.en[1], contact.en[2]);
    using Spin = Eigen::Map<const Eigen::Vector3d>;
    const Eigen::Vector3d spin_i = contact.is_wall
                                       ? Eigen::Vector3d(Spin(contact.omega_i) - wall_spin_.at(contact.mesh, contact.j))
                                       : Eigen::Vector3d(Spin(contact.omega_i));
    add(contact, contact.i, contact.radi, normal, spin_i, on_i);
    if (!contact.is_wall)
      add(contact, contact.j, contact.radj, -normal, Spin(contact.omega_j), on_j);
  }

  void surfacesClose(SurfacesCloseData&, ForceData&, ForceData&) {}
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  /// Torque on one particle; `outward` points from the partner to it, the direction of the normal force on it.
  void add(const SurfacesIntersectData& contact, int particle, double radius, const Eigen::Vector3d& outward,
           const Eigen::Vector3d& spin, ForceData& on_particle) const {
    const Eigen::Matrix3d to_world = spheres_->orientation(particle).toRotationMatrix();
    const Eigen::Vector3d towards = to_world.transpose() * -outward;
    const eccentra::rolling::CarriedContact carried = spheres_->shape().carried(towards, contact.deltan / radius);
    // r_c x F_n; the damping acts on the normal velocity that the spin gives the sub-spheres.
    const Eigen::Vector3d lever = radius * (to_world * carried.arm).cross(outward);
    Eigen::Vector3d torque = contact.Fn * lever;
    if (damped_) {
      // Sum over the sub-spheres of (c x n)((c x n) . w) = (C (n x w)) x n with C the mean of c c^T.
      const Eigen::Vector3d across = to_world.transpose() * outward.cross(spin);
      torque -= (contact.gamman * radius * radius) * (to_world * (carried.spread * across)).cross(outward);
    }
    for (int k = 0; k < 3; ++k)
      on_particle.delta_torque[k] += torque[k];
  }

  bool is_wall_;
  bool damped_ = true;
  double seed_ = 1.0;
  std::vector<std::string> shape_words_;
  eccentra::rolling::FixSphereOrientation* spheres_ = nullptr;
  eccentra::rolling::WallSpin wall_spin_;
};

} // namespace ContactModels
} // namespace LIGGGHTS
#endif
#endif
