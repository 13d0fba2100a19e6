// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Places one cluster and gives its atom shape, mass, orientation and angular momentum.
#include "styles/bodies/cluster_to_insert.h"

#include "styles/bodies/fix_cluster_bodies.h"

#include "atom.h"
#include "error.h"
#include "math_extra_liggghts.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {
constexpr int orientations_per_place = 8;
} // namespace

void ClusterToInsert::set_orientation(const double* insertion) {
  const Eigen::Quaterniond outer(insertion[0], insertion[1], insertion[2], insertion[3]);
  const Eigen::Quaterniond own(own_orientation[0], own_orientation[1], own_orientation[2], own_orientation[3]);
  const Eigen::Quaterniond q = (outer * own).normalized();
  orientation_[0] = q.w();
  orientation_[1] = q.x();
  orientation_[2] = q.y();
  orientation_[3] = q.z();
}

int ClusterToInsert::check_near_set_x_v_omega(double* x, double* v, double* omega, double* quat,
                                              RegionNeighborList<interpolate_no>& near) {
  InsertionOverlap& insertion = FixClusterBodies::require(lmp).insertion();
  set_orientation(quat);
  PlacedBody body = insertion.body(shape_id, orientation_);
  // Dense fills: a place that is too tight for one orientation may be wide enough for another.
  for (int others = orientations ? orientations_per_place - 1 : 0; insertion.overlaps(body, x, near); --others) {
    if (others == 0)
      return 0;
    MathExtraLiggghts::random_unit_quat(orientations, own_orientation);
    set_orientation(quat);
    body = insertion.body(shape_id, orientation_);
  }
  std::copy(x, x + 3, x_ins[0]);
  std::copy(v, v + 3, v_ins);
  std::copy(omega, omega + 3, omega_ins);
  insertion.add(body, x);
  near.insert(x, radius_ins[0]); // spheres of the same distribution keep off its bounding sphere
  return 1;
}

int ClusterToInsert::set_x_v_omega(double* x, double* v, double* omega, double* quat) {
  set_orientation(quat);
  return ParticleToInsert::set_x_v_omega(x, v, omega, quat);
}

int ClusterToInsert::insert() {
  const int inserted = ParticleToInsert::insert();
  FixClusterBodies::require(lmp).make_body(atom->nlocal - 1, shape_id, density_ins, orientation_);
  return inserted;
}

void ClusterToInsert::scale_pti(double) {
  error->one(FLERR, "clusters cannot be scaled while they are inserted: declare one particletemplate/cluster per size");
}

} // namespace eccentra::styles
