// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Assembles the trial spins, shares them with the ghosts, and applies the torques of the limiter.
#include "styles/rolling/fix_rolling_limited.h"

#include "base/eigen_views.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <Eigen/Geometry>

#include <cstring>
#include <string>

namespace eccentra::styles {
namespace {

constexpr char kStyle[] = "rolling/limited";
constexpr char kId[] = "eccentra_rolling_limited";
constexpr double kSphereInertia = 0.4; ///< I = 2/5 m r^2, as fix nve/sphere integrates

const RegisterFix<FixRollingLimited> registered(kStyle, "torques of rolling_friction shape (made by the model)");

} // namespace

FixRollingLimited::FixRollingLimited(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  constexpr int values_per_ghost = 4; // trial spin and compliance
  comm_forward = values_per_ghost;
}

FixRollingLimited* FixRollingLimited::find(LAMMPS_NS::LAMMPS* lmp) {
  return dynamic_cast<FixRollingLimited*>(lmp->modify->find_fix_id(kId));
}

FixRollingLimited* FixRollingLimited::make_last(LAMMPS_NS::LAMMPS* lmp) {
  LAMMPS_NS::Modify& modify = *lmp->modify;
  if (FixRollingLimited* const present = find(lmp)) {
    if (modify.fix[modify.nfix - 1] == present)
      return present;
    // Made anew, not moved: the atoms' arrays know the fixes that they belong to by their places in the list, which
    // LIGGGHTS corrects where a fix goes and nowhere else.
    modify.delete_fix(kId);
  }
  std::string arguments[] = {kId, "all", kStyle};
  char* arg[] = {arguments[0].data(), arguments[1].data(), arguments[2].data()};
  modify.add_fix(3, arg);
  return find(lmp);
}

// Nothing in it waits for the set-up of a run: made anew, it is no new fix to those who ask what has changed.
void FixRollingLimited::post_create() {
  just_created = 0;
}

int FixRollingLimited::setmask() {
  return LAMMPS_NS::FixConst::PRE_FORCE | LAMMPS_NS::FixConst::POST_FORCE;
}

void FixRollingLimited::init() {
  if (std::strstr(update->integrate_style, "respa"))
    error->all(FLERR, "rolling_friction shape form limited works with run_style verlet, not respa: use form epsd");
  rotating_groups_ = 0;
  frozen_group_ = 0;
  for (int k = 0; k < modify->nfix; ++k) {
    const Fix& other = *modify->fix[k];
    if (std::strncmp(other.style, "multisphere", std::strlen("multisphere")) == 0 ||
        std::strncmp(other.style, "rigid", std::strlen("rigid")) == 0) {
      const std::string text =
          std::string("rolling_friction shape form limited stops spheres that rotate on their own, but fix ") +
          other.id + " (" + other.style + ") binds spheres to bodies: use rolling_friction off or cdt";
      error->all(FLERR, text.c_str());
    }
    if (other.time_integrate)
      rotating_groups_ |= other.groupbit;
    if (std::strcmp(other.style, "freeze") == 0)
      frozen_group_ |= other.groupbit;
  }
}

void FixRollingLimited::setup_pre_force(int vflag) {
  pre_force(vflag);
}

void FixRollingLimited::setup(int vflag) {
  post_force(vflag);
}

void FixRollingLimited::pre_force(int) {
  limiter_.clear(atom->nlocal + atom->nghost);
}

void FixRollingLimited::post_force(int) {
  const int owned = atom->nlocal;
  const double dt = update->dt;
  const FixClusterBodies* bodies = FixClusterBodies::find(lmp);
  trial_.resize(owned + atom->nghost);
  for (int i = 0; i < owned; ++i) {
    const Eigen::Map<const Eigen::Vector3d> omega(atom->omega[i]);
    const double caps = limiter_.cap_sum(i);
    if (caps <= 0.0 || !rotates(atom->mask[i])) {
      trial_[i] = {omega, 0.0};
      continue;
    }
    if (bodies && bodies->shape_id(i) != FixClusterBodies::plain_sphere) {
      // Spin after what acts on the body by now; torques to come meet its least moment of inertia at most.
      const Eigen::Vector3d inertia = bodies->inertia(i);
      const Eigen::Matrix3d turn = base::row_major(bodies->rotation(i));
      const Eigen::Map<const Eigen::Vector3d> torque(atom->torque[i]);
      const Eigen::Vector3d momentum = turn * inertia.cwiseProduct(turn.transpose() * omega);
      const Eigen::Vector3d change = turn.transpose() * (torque - omega.cross(momentum));
      trial_[i] = {omega + dt * (turn * change.cwiseQuotient(inertia)), dt * caps / inertia.minCoeff()};
      continue;
    }
    const double per_torque = dt / (kSphereInertia * atom->rmass[i] * atom->radius[i] * atom->radius[i]);
    trial_[i] = {omega + per_torque * Eigen::Map<const Eigen::Vector3d>(atom->torque[i]), per_torque * caps};
  }
  comm->forward_comm_fix(this);
  double** const torque = atom->torque;
  limiter_.sweep(trial_, owned, [torque](int i, const Eigen::Vector3d& change) {
    torque[i][0] += change[0];
    torque[i][1] += change[1];
    torque[i][2] += change[2];
  });
}

int FixRollingLimited::pack_comm(int n, int* list, double* buffer, int, int*) {
  double* out = buffer;
  for (int k = 0; k < n; ++k) {
    const contact::TrialSpin& trial = trial_[list[k]];
    *out++ = trial.spin[0];
    *out++ = trial.spin[1];
    *out++ = trial.spin[2];
    *out++ = trial.compliance;
  }
  return comm_forward;
}

void FixRollingLimited::unpack_comm(int n, int first, double* buffer) {
  for (int k = 0; k < n; ++k, buffer += comm_forward)
    trial_[first + k] = {Eigen::Vector3d(buffer[0], buffer[1], buffer[2]), buffer[3]};
}

double FixRollingLimited::memory_usage() {
  return static_cast<double>(trial_.capacity() * sizeof(contact::TrialSpin));
}

} // namespace eccentra::styles
