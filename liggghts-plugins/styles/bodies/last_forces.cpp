// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the forces of a run's last step and puts them back in the next run's first one.
#include "styles/bodies/last_forces.h"

#include "styles/bodies/fix_cluster_bodies.h"

#include "atom.h"
#include "domain.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Fixes that act on forces; `anew` becomes true if one of them has never been in a run.
std::vector<std::string> acting_fixes(const Modify& modify, bool& anew) {
  std::vector<std::string> found;
  for (int f = 0; f < modify.nfix; ++f) {
    if (!(modify.fmask[f] & (FixConst::PRE_FORCE | FixConst::POST_FORCE)) ||
        std::strncmp(modify.fix[f]->style, "insert/", 7) == 0)
      continue;
    found.push_back(std::string(modify.fix[f]->id) + " " + modify.fix[f]->style);
    anew = anew || modify.fix[f]->just_created;
  }
  return found;
}

} // namespace

LastForces::Row LastForces::state_of(LAMMPS& lmp, const FixClusterBodies& bodies, int i) {
  const Atom& atom = *lmp.atom;
  Row row;
  double* next = std::copy(atom.f[i], atom.f[i] + 3, row.data());
  next = std::copy(atom.torque[i], atom.torque[i] + 3, next);
  next = std::copy(atom.x[i], atom.x[i] + 3, next);
  next = std::copy(atom.v[i], atom.v[i] + 3, next);
  const double* spin =
      bodies.shape_id(i) == FixClusterBodies::plain_sphere ? atom.omega[i] : bodies.angular_momentum(i);
  next = std::copy(spin, spin + 3, next);
  std::copy(bodies.quaternion(i), bodies.quaternion(i) + 4, next);
  return row;
}

void LastForces::expect(int atoms) {
  Row none;
  none.fill(kNone);
  rows_.assign(atoms, none);
  pending_ = true;
  same_process_ = fixes_changed_ = false;
}

void LastForces::keep(LAMMPS& lmp, const FixClusterBodies& bodies) {
  expect(lmp.atom->nmax);
  for (int i = 0; i < lmp.atom->nlocal; ++i)
    rows_[i] = state_of(lmp, bodies, i);
  same_process_ = true;
  step_ = lmp.update->dt;
  atoms_ = static_cast<double>(lmp.atom->natoms);
  bool anew = false;
  fixes_ = acting_fixes(*lmp.modify, anew);
}

void LastForces::set(LAMMPS& lmp, const FixClusterBodies& bodies, int i, const double* values) {
  rows_[i] = state_of(lmp, bodies, i);
  std::copy(values, values + kept_values, rows_[i].data());
}

void LastForces::compare_fixes(LAMMPS& lmp) {
  if (!pending_ || !same_process_)
    return;
  bool anew = false;
  const std::vector<std::string> now = acting_fixes(*lmp.modify, anew);
  fixes_changed_ = fixes_changed_ || anew || now != fixes_;
}

void LastForces::put_back(LAMMPS& lmp, const FixClusterBodies& bodies) {
  if (!pending_)
    return;
  pending_ = false;
  Atom& atom = *lmp.atom;
  const Domain& domain = *lmp.domain;
  constexpr double round_off = 1e-13; // of a coordinate that has been wrapped around the box
  int changed = fixes_changed_ || (same_process_ && (step_ != lmp.update->dt || atoms_ != atom.natoms));
  for (int i = 0; i < atom.nlocal && !changed; ++i) {
    if (std::isnan(rows_[i][0]))
      continue;
    const Row now = state_of(lmp, bodies, i);
    for (int k = 0; k < 3; ++k) {
      const double box = domain.boxhi[k] - domain.boxlo[k];
      double moved = now[kept_values + k] - rows_[i][kept_values + k];
      if (domain.periodicity[k])
        moved -= box * std::round(moved / box);
      changed = changed || std::fabs(moved) > round_off * box;
    }
    changed = changed || !std::equal(now.begin() + kept_values + 3, now.end(), rows_[i].begin() + kept_values + 3);
  }
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, lmp.world);
  for (int i = 0; i < atom.nlocal && !changed; ++i) {
    if (std::isnan(rows_[i][0]))
      continue;
    std::copy(rows_[i].data(), rows_[i].data() + 3, atom.f[i]);
    std::copy(rows_[i].data() + 3, rows_[i].data() + kept_values, atom.torque[i]);
  }
  std::vector<Row>().swap(rows_); // its memory, too
}

void LastForces::grow(int atoms) {
  if (!pending_)
    return;
  Row none;
  none.fill(kNone);
  rows_.resize(atoms, none);
}

void LastForces::copy(int from, int to) {
  if (pending_)
    rows_[to] = rows_[from];
}

void LastForces::forget(int i) {
  if (pending_)
    rows_[i].fill(kNone);
}

int LastForces::pack(int i, double* buffer) const {
  if (!pending_)
    return 0;
  std::copy(rows_[i].begin(), rows_[i].end(), buffer);
  return columns;
}

int LastForces::unpack(int i, const double* buffer) {
  if (!pending_)
    return 0;
  std::copy(buffer, buffer + columns, rows_[i].begin());
  return columns;
}

} // namespace eccentra::styles
