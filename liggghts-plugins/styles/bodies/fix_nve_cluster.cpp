// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix nve/cluster: motion of clusters and plain spheres, velocity Verlet with exact rotations.
#include "contact/turning_block.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/fix_sleep_cluster.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "fix_property_atom.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <mpi.h>

#include <string>

namespace eccentra::styles {

using namespace LAMMPS_NS;

/// Fix style "nve/cluster". Output (fix ID): scalar: energy of rotation [J]; vector: 1 energy of translation, 2 energy
/// of rotation [J], 3-5 momentum [kg m/s], 6-8 angular momentum about the bodies' own centres, summed [kg m2/s].
class FixNveCluster : public Fix {
 public:
  FixNveCluster(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
    if (narg > 3)
      error->all(
          FLERR,
          ("fix " + std::string(id) + " nve/cluster takes no further words, but found '" + arg[3] + "'").c_str());
    time_integrate = 1;
    scalar_flag = 1;
    vector_flag = 1;
    size_vector = 8;
    global_freq = 1;
  }

  void post_create() override { FixClusterBodies::require(lmp); }

  int setmask() override { return FixConst::INITIAL_INTEGRATE | FixConst::FINAL_INTEGRATE; }

  void init() override {
    reset_dt();
    bodies_ = &FixClusterBodies::require(lmp);
    sleep_ = FixSleepCluster::find(lmp);
    streamed_ = static_cast<FixPropertyAtom*>(
        modify->find_fix_property("release_fix_insert_stream", "property/atom", "vector", 5, 0, style, false));
  }

  void reset_dt() override {
    dt_ = update->dt;
    half_step_ = 0.5 * update->dt * force->ftm2v;
  }

  // A script may have set omega since the last run: then the angular momentum follows it.
  void setup(int) override {
    constexpr double round_off = 1e-9;
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & groupbit) || bodies_->shape_id(i) == FixClusterBodies::plain_sphere)
        continue;
      double* omega = atom->omega[i];
      const double set[3] = {omega[0], omega[1], omega[2]};
      bodies_->omega_from_momentum(i);
      double change = 0, size = 0;
      for (int k = 0; k < 3; ++k) {
        change += std::abs(omega[k] - set[k]);
        size += std::abs(omega[k]) + std::abs(set[k]);
      }
      if (change > round_off * size) {
        std::copy(set, set + 3, omega);
        bodies_->momentum_from_omega(i);
      }
    }
  }

  void initial_integrate(int) override {
    bodies_->resume_forces();
    if (streamed_)
      follow_stream();
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & groupbit) || (sleep_ && sleep_->asleep(i)))
        continue;
      const double per_mass = 1 / atom->rmass[i];
      half_step(i, per_mass);
      for (int k = 0; k < 3; ++k)
        atom->x[i][k] += dt_ * atom->v[i][k];
      if (bodies_->shape_id(i) != FixClusterBodies::plain_sphere)
        turn(i, per_mass);
    }
    turn_block();
  }

  void final_integrate() override {
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & groupbit) || (sleep_ && sleep_->asleep(i)))
        continue;
      const double per_mass = 1 / atom->rmass[i];
      half_step(i, per_mass);
      const int shape = bodies_->shape_id(i);
      if (shape == FixClusterBodies::plain_sphere)
        continue;
      const contact::FreeRotation& rotation = bodies_->shapes().free_rotation(shape);
      if (rotation.spherical())
        set_omega(i, rotation.world_rate() * per_mass);
      else
        bodies_->omega_from_momentum(i);
    }
  }

  double compute_scalar() override { return compute_vector(1); }

  double compute_vector(int n) override {
    double local = 0;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & groupbit)
        local += quantity(i, n);
    double global = 0;
    MPI_Allreduce(&local, &global, 1, MPI_DOUBLE, MPI_SUM, world);
    return global;
  }

 private:
  /// Half a step of velocity, and of angular momentum (plain spheres: angular velocity).
  void half_step(int i, double per_mass) {
    const double c = half_step_ * per_mass;
    double* v = atom->v[i];
    const double* f = atom->f[i];
    const double* torque = atom->torque[i];
    for (int k = 0; k < 3; ++k)
      v[k] += c * f[k];
    if (bodies_->shape_id(i) == FixClusterBodies::plain_sphere) {
      constexpr double solid_sphere = 0.4;
      const double r = atom->radius[i];
      const double w = c / (solid_sphere * r * r);
      for (int k = 0; k < 3; ++k)
        atom->omega[i][k] += w * torque[k];
    } else {
      double* momentum = bodies_->angular_momentum(i);
      for (int k = 0; k < 3; ++k)
        momentum[k] += half_step_ * torque[k];
    }
  }

  // Fix insert/stream carries a body in until its release and sets v and omega itself, the last time in the step of its
  // release: the angular momentum follows.
  void follow_stream() {
    constexpr int inserted = 3, released = 4; // columns, steps of the run
    for (int i = 0; i < atom->nlocal; ++i) {
      const double* stream = streamed_->array_atom[i];
      if (stream[inserted] != 0 && static_cast<double>(update->ntimestep - 1) <= stream[released] &&
          bodies_->shape_id(i) != FixClusterBodies::plain_sphere)
        bodies_->momentum_from_omega(i);
    }
  }

  /// rate: angular velocity per angular momentum of a body whose moments are equal.
  void set_omega(int i, double rate) {
    const double* momentum = bodies_->angular_momentum(i);
    for (int k = 0; k < 3; ++k)
      atom->omega[i][k] = rate * momentum[k];
  }

  void turn(int i, double per_mass) {
    const contact::FreeRotation& rotation = bodies_->shapes().free_rotation(bodies_->shape_id(i));
    const double* momentum = bodies_->angular_momentum(i);
    if (rotation.spherical()) {
      const double rate = rotation.world_rate() * per_mass;
      set_omega(i, rate);
      const double turn = rate * dt_;
      const double angle[3] = {momentum[0] * turn, momentum[1] * turn, momentum[2] * turn};
      if (contact::turns_in_block(angle)) {
        add_to_block(i, angle);
        return;
      }
      contact::rotate_in_world(bodies_->quaternion(i), angle);
      contact::normalise(bodies_->quaternion(i));
    } else {
      const double specific[3] = {momentum[0] * per_mass, momentum[1] * per_mass, momentum[2] * per_mass};
      rotation.step(bodies_->quaternion(i), specific, dt_);
    }
    if (!bodies_->is_round(i))
      contact::rotation_matrix(bodies_->quaternion(i), bodies_->rotation(i));
    if (!rotation.spherical())
      bodies_->omega_from_momentum(i);
  }

  void add_to_block(int i, const double* angle) {
    const int m = turning_.count++;
    const double* q = bodies_->quaternion(i);
    turning_.body[m] = i;
    for (int k = 0; k < 3; ++k)
      turning_.angle[k][m] = angle[k];
    for (int k = 0; k < 4; ++k)
      turning_.quaternion[k][m] = q[k];
    if (turning_.count == contact::TurningBlock::width)
      turn_block();
  }

  void turn_block() {
    contact::turn_all(turning_);
    for (int m = 0; m < turning_.count; ++m) {
      double *q = bodies_->quaternion(turning_.body[m]), *r = bodies_->rotation(turning_.body[m]);
      for (int k = 0; k < 4; ++k)
        q[k] = turning_.quaternion[k][m];
      // A round body's is needed by nobody, but to ask whether it is one takes as long.
      for (int k = 0; k < 9; ++k)
        r[k] = turning_.matrix[k][m];
    }
    turning_.count = 0;
  }

  double quantity(int i, int n) {
    const double m = atom->rmass[i];
    const double *v = atom->v[i], *w = atom->omega[i];
    double momentum[3];
    if (bodies_->shape_id(i) == FixClusterBodies::plain_sphere) {
      const double inertia = bodies_->inertia(i)[0];
      for (int k = 0; k < 3; ++k)
        momentum[k] = inertia * w[k];
    } else {
      std::copy(bodies_->angular_momentum(i), bodies_->angular_momentum(i) + 3, momentum);
    }
    if (n == 0)
      return 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (n == 1)
      return 0.5 * (momentum[0] * w[0] + momentum[1] * w[1] + momentum[2] * w[2]);
    return n < 5 ? m * v[n - 2] : momentum[n - 5];
  }

  FixClusterBodies* bodies_ = nullptr;
  const FixSleepCluster* sleep_ = nullptr; ///< null where bodies never sleep
  FixPropertyAtom* streamed_ = nullptr;    ///< what fix insert/stream keeps per atom, if there is one
  double dt_ = 0;
  double half_step_ = 0;
  contact::TurningBlock turning_;
};

namespace {
const RegisterFix<FixNveCluster> registered("nve/cluster", "motion of clusters (and plain spheres)");
}

} // namespace eccentra::styles
