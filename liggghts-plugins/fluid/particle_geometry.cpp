// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements ParticleGeometry on LIGGGHTS's atoms.
#include "fluid/particle_geometry.h"

#include "cluster/bodies.h"

#include <mpi.h>

#include "atom.h"
#include "lammps.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace eccentra::fluid {

namespace {
constexpr double kSphereInertia = 0.4;
}

void ParticleGeometry::init() {}

void ParticleGeometry::refresh() {}

const double* ParticleGeometry::radius() const {
  return lmp_->atom->radius;
}

const int* ParticleGeometry::kind() const {
  return lmp_->atom->type;
}

int ParticleGeometry::kinds() const {
  return lmp_->atom->ntypes + 1;
}

ShapeFactors ParticleGeometry::factors(int kind) const {
  ShapeFactors shape;
  shape.sphericity = sphericity_.size() == 1 ? sphericity_[0] : sphericity_[kind > 0 ? kind - 1 : 0];
  return shape;
}

double ParticleGeometry::inertia_factor(int) const {
  return kSphereInertia;
}

double ParticleGeometry::crosswise_sphericity(int, const double*) const {
  return 1.0;
}

double ParticleGeometry::radius_of(int i) const {
  return lmp_->atom->radius[i];
}

} // namespace eccentra::fluid
