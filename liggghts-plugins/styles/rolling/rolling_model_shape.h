// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contact model `rolling_friction shape`: eq (19) with the coefficient of eq (33), in three forms.
#ifdef ROLLING_MODEL
ROLLING_MODEL(ROLLING_SHAPE, shape, 20)
#else
#ifndef ECCENTRA_ROLLING_MODEL_SHAPE_H
#define ECCENTRA_ROLLING_MODEL_SHAPE_H
#include "contact_models.h"

#include "contact/rolling_torque.h"
#include "styles/rolling/coefficients.h"
#include "styles/rolling/contact_keywords.h"
#include "styles/rolling/fix_rolling_limited.h"
#include "styles/rolling/wall_spin.h"

#include "rolling_model_base.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "update.h"

namespace LIGGGHTS {
namespace ContactModels {

template <> class RollingModel<ROLLING_SHAPE> : public RollingModelBase {
 public:
  RollingModel(LAMMPS* lmp, IContactHistorySetup* history, ContactModelBase* contact_model)
      : RollingModelBase(lmp, history, contact_model), is_wall_(contact_model->is_wall()), wall_spin_(history) {}

  void registerSettings(Settings& settings) {
    eccentra::styles::register_option(settings, kName, "form", form_,
                                      {{"limited", kLimited}, {"directional", kDirectional}, {"epsd", kSpringDashpot}});
    eccentra::styles::register_switch(settings, kName, "torsionTorque", torsion_);
    settings.registerDoubleSetting("rollingDampingRatio", damping_ratio_, kDefaultDampingRatio);
  }

  inline void postSettings(IContactHistorySetup* history, ContactModelBase*) {
    configured_ = true;
    if (form_ == kDirectional)
      return;
    // "1": the partner sees the opposite sign.
    memory_offset_ = history->add_history_value("rolling_torque_x", "1");
    history->add_history_value("rolling_torque_y", "1");
    history->add_history_value("rolling_torque_z", "1");
  }

  void connectToProperties(PropertyRegistry& registry) {
    if (!configured_)
      error->all(FLERR,
                 "rolling_friction shape: a restart file does not keep the words of the model: give the pair_style "
                 "line again after read_restart");
    // Names of our own: the creators of stock models for the same fixes do not check.
    registry.registerProperty("eccentraRollingFriction", &eccentra::styles::create_rolling_coefficient);
    registry.registerProperty("eccentraShapeRollingFriction", &eccentra::styles::create_shape_coefficient);
    registry.connect("eccentraRollingFriction", mu_r_, kName);
    registry.connect("eccentraShapeRollingFriction", mu_shape_, kName);
    if (force->cg_active())
      error->cg(FLERR, kName);
    if (is_wall_)
      wall_spin_.refresh();
    if (form_ != kLimited)
      return;
    using eccentra::styles::FixRollingLimited;
    FixRollingLimited* fix = is_wall_ ? FixRollingLimited::find(lmp) : FixRollingLimited::make_last(lmp);
    if (!fix)
      error->all(FLERR,
                 "rolling_friction shape form limited at a wall needs the same form in pair_style (with coefficients 0 "
                 "where the particles have none): or use form epsd or directional at the wall");
    limiter_ = &fix->limiter();
  }

  void surfacesIntersect(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j) {
    using namespace eccentra::styles;
    if (contact.contact_flags)
      *contact.contact_flags |= CONTACT_ROLLING_MODEL;
    const double coefficient = eccentra::contact::effective_coefficient(mu_r_[contact.itype][contact.jtype],
                                                                        mu_shape_[contact.itype][contact.jtype]);
    const double lever = contact.is_wall ? contact.radi : eccentra::contact::lever_arm(contact.radi, contact.radj);
    const double cap = eccentra::contact::torque_cap(coefficient, lever, contact.kn * contact.deltan);
    if (form_ == kLimited) {
      limited(contact, cap, on_i, on_j);
      return;
    }
    const Eigen::Vector3d normal(contact.en[0], contact.en[1], contact.en[2]);
    const Eigen::Vector3d torque = form_ == kDirectional
                                       ? eccentra::contact::directional_torque(relative_spin(contact, normal), cap)
                                       : spring_dashpot(contact, normal, coefficient, lever, cap);
    for (int k = 0; k < 3; ++k) {
      on_i.delta_torque[k] += torque[k];
      on_j.delta_torque[k] -= torque[k];
    }
  }

  void surfacesClose(SurfacesCloseData& contact, ForceData&, ForceData&) {
    if (contact.contact_flags)
      *contact.contact_flags &= ~CONTACT_ROLLING_MODEL;
    if (contact.contact_history && memory_offset_ >= 0)
      Eigen::Map<Eigen::Vector3d>(contact.contact_history + memory_offset_).setZero();
  }

  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  enum Form { kLimited, kDirectional, kSpringDashpot };
  static constexpr const char* kName = "rolling_friction shape";
  static constexpr double kDefaultDampingRatio = 0.3; ///< Ai et al. (2011)
  static constexpr double kSphereInertia = 0.4;

  Eigen::Vector3d wall_spin(const SurfacesIntersectData& contact) const {
    return wall_spin_.at(contact.mesh, contact.j);
  }

  Eigen::Vector3d relative_spin(const SurfacesIntersectData& contact, const Eigen::Vector3d& normal) const {
    using Spin = Eigen::Map<const Eigen::Vector3d>;
    const Eigen::Vector3d spin = contact.is_wall ? Eigen::Vector3d(Spin(contact.omega_i) - wall_spin(contact))
                                                 : Eigen::Vector3d(Spin(contact.omega_i) - Spin(contact.omega_j));
    return torsion_ ? spin : eccentra::contact::rolling_part(spin, normal);
  }

  /// Loads the contact with the torque that it held, turned and cut to what it can hold now, and reports it to the fix,
  /// which adds the change after all forces. Plain numbers: this and the fix are all that the form costs.
  void limited(const SurfacesIntersectData& contact, double cap, ForceData& on_i, ForceData& on_j) {
    double* const memory = contact.contact_history + memory_offset_;
    double normal[3] = {0.0, 0.0, 0.0};
    double held[3] = {memory[0], memory[1], memory[2]};
    if (!torsion_) {
      const double torsion = held[0] * contact.en[0] + held[1] * contact.en[1] + held[2] * contact.en[2];
      for (int k = 0; k < 3; ++k) {
        normal[k] = contact.en[k];
        held[k] -= torsion * normal[k];
      }
    }
    const double squared = held[0] * held[0] + held[1] * held[1] + held[2] * held[2];
    if (squared > cap * cap) {
      const double cut = cap / std::sqrt(squared);
      for (double& component : held)
        component *= cut;
    }
    for (int k = 0; k < 3; ++k) {
      on_i.delta_torque[k] += held[k];
      on_j.delta_torque[k] -= held[k];
    }
    if (!contact.computeflag)
      return;
    eccentra::contact::LimitedContact& reported = contact.is_wall
                                                      ? limiter_->add_wall(contact.i, cap, wall_spin(contact))
                                                      : limiter_->add_pair(contact.i, contact.j, cap);
    for (int k = 0; k < 3; ++k) {
      reported.normal[k] = normal[k];
      reported.torque[k] = held[k];
    }
    reported.memory = contact.shearupdate ? memory : nullptr;
  }

  Eigen::Vector3d spring_dashpot(const SurfacesIntersectData& contact, const Eigen::Vector3d& normal,
                                 double coefficient, double lever, double cap) const {
    using namespace eccentra::styles;
    Eigen::Map<Eigen::Vector3d> memory(contact.contact_history + memory_offset_);
    // About the contact point: 2/5 m r^2 + m r^2 for each partner that is no wall.
    const double about_contact = 1.0 + kSphereInertia;
    double inertia = about_contact * contact.mi * contact.radi * contact.radi;
    if (!contact.is_wall) {
      const double other = about_contact * contact.mj * contact.radj * contact.radj;
      inertia = inertia * other / (inertia + other);
    }
    const Eigen::Vector3d remembered =
        torsion_ ? Eigen::Vector3d(memory) : eccentra::contact::rolling_part(memory, normal);
    const eccentra::contact::SpringDashpot torque = eccentra::contact::spring_dashpot(
        remembered, relative_spin(contact, normal),
        eccentra::contact::rolling_stiffness(contact.kn, coefficient, lever), cap, inertia, damping_ratio_, update->dt);
    if (contact.computeflag && contact.shearupdate)
      memory = torque.spring;
    return torque.total;
  }

  bool is_wall_;
  bool configured_ = false;
  bool torsion_ = true;
  int form_ = kLimited;
  int memory_offset_ = -1;
  double damping_ratio_ = kDefaultDampingRatio;
  double** mu_r_ = nullptr;
  double** mu_shape_ = nullptr;
  eccentra::contact::RollingLimiter* limiter_ = nullptr;
  eccentra::styles::WallSpin wall_spin_;
};

} // namespace ContactModels
} // namespace LIGGGHTS
#endif
#endif
