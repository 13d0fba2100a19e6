// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements ParticleGeometry on LIGGGHTS's atoms.
#include "styles/fluid/particle_geometry.h"

#include "shape/resistance_cache.h"
#include "shape/rounded_hull.h"
#include "styles/bodies/fix_cluster_bodies.h"

#include <mpi.h>

#include "atom.h"
#include "lammps.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace eccentra::styles {

namespace {
constexpr double kSphereInertia = 0.4;
}

void ParticleGeometry::init() {
  bodies_ = FixClusterBodies::find(lmp_);
  if (bodies_)
    areas_.resize(bodies_->shapes().size());
  if (bodies_)
    oriented_.resize(bodies_->shapes().size());
}

void ParticleGeometry::refresh() {
  if (!bodies_)
    return;
  const LAMMPS_NS::Atom& atom = *lmp_->atom;
  radius_.resize(atom.nmax);
  kind_.resize(atom.nmax);
  for (int i = 0; i < atom.nlocal; ++i) {
    const int shape = bodies_->shape_id(i);
    radius_[i] = radius_of(i);
    kind_[i] = shape < 0 ? atom.type[i] : atom.ntypes + 1 + shape;
  }
}

const double* ParticleGeometry::radius() const {
  return bodies_ ? radius_.data() : lmp_->atom->radius;
}

const int* ParticleGeometry::kind() const {
  return bodies_ ? kind_.data() : lmp_->atom->type;
}

int ParticleGeometry::kinds() const {
  return lmp_->atom->ntypes + 1 + (bodies_ ? bodies_->shapes().size() : 0);
}

closures::ShapeFactors ParticleGeometry::factors(int kind) const {
  closures::ShapeFactors shape;
  const int id = kind - lmp_->atom->ntypes - 1;
  if (id >= 0)
    shape.sphericity = std::min(1.0, bodies_->shapes()[id].sphericity());
  else
    shape.sphericity = sphericity_.size() == 1 ? sphericity_[0] : sphericity_[kind > 0 ? kind - 1 : 0];
  return shape;
}

double ParticleGeometry::inertia_factor(int kind) const {
  const int id = kind - lmp_->atom->ntypes - 1;
  if (id < 0)
    return kSphereInertia;
  const shape::ClusterShape& cluster = bodies_->shapes()[id];
  return cluster.inertia_per_mass().minCoeff() / (cluster.equivalent_radius() * cluster.equivalent_radius());
}

double ParticleGeometry::crosswise_sphericity(int i, const double* direction) const {
  const int id = bodies_ ? bodies_->shape_id(i) : -1;
  if (id < 0)
    return 1.0;
  const shape::ClusterShape& cluster = bodies_->shapes()[id];
  const shape::RoundedHull* hull = cluster.hull();
  if (!hull && !areas_[id])
    areas_[id] = std::make_unique<closures::ProjectedAreaTable>(cluster.spheres());
  const double* q = bodies_->quaternion(i);
  const Eigen::Vector3d world(direction[0], direction[1], direction[2]);
  const Eigen::Vector3d body = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * world;
  const double radius = cluster.equivalent_radius();
  return closures::kPi * radius * radius / (hull ? hull->projected_area(body) : areas_[id]->at(body));
}

// Rank 0 solves or reads, so that all ranks have the same digits and one of them writes the cache.
const closures::OrientedShape* ParticleGeometry::oriented(int kind) const {
  const int id = kind - lmp_->atom->ntypes - 1;
  if (id < 0)
    return nullptr;
  const shape::ClusterShape& cluster = bodies_->shapes()[id];
  if (cluster.spheres().size() == 1)
    return nullptr; // a sphere, to the last digit
  if (!oriented_[id]) {
    shape::Resistance resistance;
    int rank = 0;
    MPI_Comm_rank(lmp_->world, &rank);
    if (rank == 0)
      resistance = shape::cached_resistance(cluster);
    MPI_Bcast(&resistance, sizeof resistance, MPI_BYTE, 0, lmp_->world);
    const double d = 2.0 * cluster.equivalent_radius();
    oriented_[id] = std::make_unique<closures::OrientedShape>(closures::oriented_shape(
        resistance, cluster.inertia_per_mass() / (d * d), [&](const Eigen::Vector3d& direction) {
          return (cluster.hull() ? cluster.hull()->projected_area(direction)
                                 : closures::projected_area(cluster.spheres(), direction)) /
                 (d * d);
        }));
  }
  return oriented_[id].get();
}

const double* ParticleGeometry::quaternion(int i) const {
  return bodies_ ? bodies_->quaternion(i) : nullptr;
}

double ParticleGeometry::radius_of(int i) const {
  const int shape = bodies_ ? bodies_->shape_id(i) : -1;
  return shape < 0 ? lmp_->atom->radius[i] : bodies_->shapes()[shape].equivalent_radius();
}

} // namespace eccentra::styles
