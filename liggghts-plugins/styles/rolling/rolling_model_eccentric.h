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

#include "contact/eccentric_batch.h"
#include "styles/rolling/contact_keywords.h"
#include "styles/rolling/fix_sphere_orientation.h"
#include "styles/rolling/wall_spin.h"

#include "rolling_model_base.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "pair_gran.h"

namespace LIGGGHTS {
namespace ContactModels {

template <> class RollingModel<ROLLING_ECCENTRIC> : public RollingModelBase {
 public:
  RollingModel(LAMMPS* lmp, IContactHistorySetup* history, ContactModelBase* contact_model)
      : RollingModelBase(lmp, history, contact_model), is_wall_(contact_model->is_wall()), wall_spin_(history) {}

  void registerSettings(Settings& settings) {
    eccentra::styles::register_shape_keywords(*lmp, settings, "rolling_friction eccentric", shape_keywords_);
    eccentra::styles::register_factor(settings, "rolling_friction eccentric", "rockingDamping", damping_);
    settings.registerDoubleSetting("orientationSeed", seed_, 1.0);
  }

  inline void postSettings(IContactHistorySetup*, ContactModelBase*) {}

  void connectToProperties(PropertyRegistry&) {
    using eccentra::styles::FixSphereOrientation;
    if (force->cg_active())
      error->cg(FLERR, "rolling_friction eccentric");
    if (is_wall_) {
      if (!shape_keywords_.empty())
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
    if (shape_keywords_.empty())
      error->all(
          FLERR,
          "rolling_friction eccentric needs a shape: add, for example, 'shape cube 64' to the pair_style line (again "
          "after read_restart)");
    spheres_ = FixSphereOrientation::make(lmp, shape_keywords_, static_cast<long>(seed_));
    pair_ = static_cast<LAMMPS_NS::PairGran*>(force->pair_match("gran", 0));
  }

  void surfacesIntersect(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j) {
    if (contact.is_wall) {
      const Eigen::Vector3d wall_spin = wall_spin_.at(contact.mesh, contact.j);
      const double spin[3] = {contact.omega_i[0] - wall_spin[0], contact.omega_i[1] - wall_spin[1],
                              contact.omega_i[2] - wall_spin[2]};
      add_now(contact, contact.i, contact.radi, contact.en, spin, on_i);
      return;
    }
    // A ghost's torque is its owner's affair.
    const bool both = contact.j < atom->nlocal || force->newton_pair;
    const double on_partner[3] = {-contact.en[0], -contact.en[1], -contact.en[2]};
    if (torques_are_read_) {
      add_now(contact, contact.i, contact.radi, contact.en, contact.omega_i, on_i);
      if (both)
        add_now(contact, contact.j, contact.radj, on_partner, contact.omega_j, on_j);
      return;
    }
    if (!contact.computeflag)
      return;
    add_later(contact, contact.i, contact.radi, contact.en, contact.omega_i);
    if (both)
      add_later(contact, contact.j, contact.radj, on_partner, contact.omega_j);
  }

  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {
    torques_are_read_ = pair_->cpl() || pair_->storeContactForces() || pair_->storeContactForcesStress();
  }

  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) { evaluate(); }

  void surfacesClose(SurfacesCloseData&, ForceData&, ForceData&) {}

 private:
  /// Torque on one particle; `outward` points from the partner to it, the direction of the normal force on it.
  void add_now(const SurfacesIntersectData& contact, int particle, double radius, const double* outward,
               const double* spin, ForceData& on_particle) const {
    using namespace eccentra::styles;
    const Eigen::Map<const Eigen::Vector3d> n(outward);
    const double* const q = spheres_->orientation(particle);
    // T = R (sum of c times its force) x n; the dashpot acts on the normal velocity that the spin gives the
    // sub-spheres.
    const eccentra::contact::ContactLoad load{contact.Fn, damper(contact, particle) * radius,
                                              n.cross(Eigen::Map<const Eigen::Vector3d>(spin))};
    const Eigen::Vector3d moment = eccentra::contact::turned_moment(spheres_->shape(), {q[0], q[1], q[2], q[3]}, -n,
                                                                    contact.deltan / radius, load);
    const Eigen::Vector3d torque = radius * moment.cross(n);
    for (int k = 0; k < 3; ++k)
      on_particle.delta_torque[k] += torque[k];
  }

  void add_later(const SurfacesIntersectData& contact, int particle, double radius, const double* outward,
                 const double* spin) {
    if (batch_.full())
      evaluate();
    batch_.add(particle, spheres_->orientation(particle), radius, outward, spin, contact.deltan / radius, contact.Fn,
               damper(contact, particle));
  }

  /// That of the normal velocities of the sub-spheres of a particle [N s/m].
  double damper(const SurfacesIntersectData& contact, int particle) const {
    return spheres_->damper(contact.gamman, damping_, particle == contact.i ? contact.mi : contact.mj);
  }

  void evaluate() {
    double** const torques = atom->torque;
    batch_.evaluate(spheres_->shape(), [this, torques](int i, const double* torque) {
      const double relaxed = pair_->relax(i);
      for (int k = 0; k < 3; ++k)
        torques[i][k] += relaxed * torque[k];
    });
  }

  bool is_wall_;
  double damping_ = 1.0; ///< of rocking, over that of the contact's normal damper
  double seed_ = 1.0;
  std::vector<std::string> shape_keywords_;
  eccentra::styles::FixSphereOrientation* spheres_ = nullptr;
  eccentra::styles::WallSpin wall_spin_;
  LAMMPS_NS::PairGran* pair_ = nullptr;
  bool torques_are_read_ = false; ///< by what looks at single contacts: each must have its torque at once
  eccentra::contact::EccentricBatch batch_;
};

} // namespace ContactModels
} // namespace LIGGGHTS
#endif
#endif
