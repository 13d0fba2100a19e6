// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Turns orientations with the exact rotation of a constant spin over the step.
#include "styles/rolling/fix_sphere_orientation.h"

#include "base/refusal.h"
#include "contact/rocking_damper.h"
#include "shape/shape_keywords.h"
#include "styles/entry/printed_notes.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <stdexcept>

namespace eccentra::styles {
namespace {

constexpr char kStyle[] = "rolling/orientation";
constexpr char kId[] = "eccentra_rolling_orientation";
constexpr char kProperty[] = "eccentricOrientation";
constexpr double kUnitDiameter = 2.0; ///< R_eq = 1

const RegisterFix<FixSphereOrientation> registered(kStyle,
                                                   "orientation of rolling_friction eccentric (made by the model)");

Eigen::Quaterniond random_orientation(long seed, int tag) {
  std::seed_seq seeds{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(tag)};
  std::mt19937 random(seeds);
  std::normal_distribution<double> normal;
  Eigen::Vector4d q;
  for (double& component : q)
    component = normal(random);
  q.normalize();
  return {q[0], q[1], q[2], q[3]};
}

} // namespace

FixSphereOrientation::FixSphereOrientation(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {}

FixSphereOrientation* FixSphereOrientation::find(LAMMPS_NS::LAMMPS* lmp) {
  return dynamic_cast<FixSphereOrientation*>(lmp->modify->find_fix_id(kId));
}

FixSphereOrientation* FixSphereOrientation::make(LAMMPS_NS::LAMMPS* lmp, const std::vector<std::string>& shape_keywords,
                                                 long seed) {
  if (!lmp->modify->find_fix_id(kProperty)) {
    std::string arguments[] = {kProperty, "all", "property/atom", kProperty, "vector", "yes", "no", "no", "0", "0",
                               "0",       "0"};
    constexpr int n = sizeof(arguments) / sizeof(arguments[0]);
    char* arg[n];
    for (int k = 0; k < n; ++k)
      arg[k] = arguments[k].data();
    lmp->modify->add_fix(n, arg);
  }
  if (!find(lmp)) {
    std::string arguments[] = {kId, "all", kStyle};
    char* arg[] = {arguments[0].data(), arguments[1].data(), arguments[2].data()};
    lmp->modify->add_fix(3, arg);
  }
  FixSphereOrientation* const fix = find(lmp);
  fix->property_ = dynamic_cast<LAMMPS_NS::FixPropertyAtom*>(lmp->modify->find_fix_id(kProperty));
  fix->seed_ = seed;
  if (fix->shape_ && fix->shape_keywords_ == shape_keywords)
    return fix;
  fix->shape_keywords_ = shape_keywords;
  try {
    std::size_t used = 0;
    shape::Notes notes;
    const shape::ClusterShape body = shape::make_shape(shape_keywords, 0, used, kUnitDiameter, notes);
    if (used != shape_keywords.size())
      base::refuse("unknown word '{}' after the shape '{}'; expected rockingDamping or orientationSeed",
                   shape_keywords[used], body.name());
    print_notes(lmp, "rolling_friction eccentric", notes);
    fix->shape_ = std::make_unique<contact::SupportTable>(body);
  } catch (const std::invalid_argument& problem) {
    lmp->error->all(FLERR, (std::string("rolling_friction eccentric: ") + problem.what()).c_str());
  }
  return fix;
}

int FixSphereOrientation::setmask() {
  return LAMMPS_NS::FixConst::POST_INTEGRATE | LAMMPS_NS::FixConst::PRE_FORCE;
}

void FixSphereOrientation::init() {
  if (!property_)
    error->all(FLERR,
               "fix rolling/orientation is made by pair_style gran ... rolling_friction eccentric: remove it from "
               "the script");
}

void FixSphereOrientation::setup_pre_force(int) {
  orient_new_spheres();
}

void FixSphereOrientation::post_integrate() {
  const double dt = update->dt;
  for (int i = 0; i < atom->nlocal; ++i) {
    const Eigen::Map<const Eigen::Vector3d> omega(atom->omega[i]);
    // sin(x)/x and cos(x) by series: an angle per step beyond 0.2 rad would be no resolved motion anyway.
    const double half = 0.25 * dt * dt * omega.squaredNorm();
    const double sine = 0.5 * dt * (1.0 - half / 6.0 * (1.0 - half / 20.0));
    const double cosine = 1.0 - 0.5 * half * (1.0 - half / 12.0);
    const Eigen::Quaterniond turn(cosine, sine * omega[0], sine * omega[1], sine * omega[2]);
    double* const q = property_->array_atom[i];
    Eigen::Quaterniond turned = turn * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    // What a step adds to |q|^2 - 1 is round-off (or zero stays zero): one Newton step for 1/|q| takes it out.
    turned.coeffs() *= 1.5 - 0.5 * turned.squaredNorm();
    q[0] = turned.w();
    q[1] = turned.x();
    q[2] = turned.y();
    q[3] = turned.z();
  }
}

double FixSphereOrientation::damper(double normal_damping, double factor, double mass) {
  const double acting = contact::rocking_damper(normal_damping, factor, mass, shape_->longest_arm(), update->dt);
  if (acting < factor * normal_damping)
    least_factor_ = std::min(least_factor_, acting / normal_damping);
  return acting;
}

void FixSphereOrientation::post_run() {
  double least = least_factor_;
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, world);
  if (!(least < said_factor_))
    return;
  said_factor_ = least;
  if (comm->me == 0)
    error->warning(FLERR,
                   fmt::format("rolling_friction eccentric: the time step bears no stronger rockingDamping than a "
                               "factor of {:.3g}, which acted instead of the larger one; expected a smaller "
                               "factor or a shorter timestep",
                               least)
                       .c_str());
}

void FixSphereOrientation::orient_new_spheres() {
  for (int i = 0; i < atom->nlocal; ++i) {
    double* const q = property_->array_atom[i];
    if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 0.0)
      continue;
    const Eigen::Quaterniond orientation = random_orientation(seed_, atom->tag[i]);
    q[0] = orientation.w();
    q[1] = orientation.x();
    q[2] = orientation.y();
    q[3] = orientation.z();
  }
}

void FixSphereOrientation::pre_force(int) {
  if (neighbor->ago == 0) // insertion happens where lists are rebuilt
    orient_new_spheres();
}

} // namespace eccentra::styles
