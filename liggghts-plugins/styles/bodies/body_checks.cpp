// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Radius and mass against shape and density, one integrator for each body.
#include "styles/bodies/body_checks.h"

#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/incompatible_styles.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;

constexpr double round_off = 1e-9; ///< of products of a few numbers, and of restart files

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

bool differs(double value, double expected) {
  return !(std::abs(value - expected) <= round_off * std::abs(expected));
}

/// The fixes that move atoms, and those that hold them.
struct Motion {
  std::vector<const LAMMPS_NS::Fix*> integrators;
  int held = 0; ///< group bits of fix freeze

  explicit Motion(const Modify& modify) {
    for (int n = 0; n < modify.nfix; ++n) {
      if (modify.fix[n]->time_integrate)
        integrators.push_back(modify.fix[n]);
      if (!std::strcmp(modify.fix[n]->style, "freeze"))
        held |= modify.fix[n]->groupbit;
    }
  }

  /// Empty if exactly one integrator moves the atom, or fix freeze holds it.
  std::string problem(int mask, bool moves) const {
    const LAMMPS_NS::Fix *first = nullptr, *second = nullptr;
    for (const LAMMPS_NS::Fix* fix : integrators)
      if (mask & fix->groupbit)
        (first ? second : first) = fix;
    if (second)
      return "is moved twice, by fix " + std::string(first->id) + " (" + first->style + ") and fix " + second->id +
             " (" + second->style +
             "); expected one fix nve/cluster for each body; unfix one of them, or divide the bodies "
             "into groups";
    if (!first && !(mask & held) && moves)
      return "is moved by no fix; expected one fix nve/cluster for each body; write fix ID all nve/cluster, or hold "
             "the "
             "body with fix freeze";
    return {};
  }
};

std::string size_problem(const Atom& atom, const FixClusterBodies& bodies, int i) {
  const shape::ClusterShape& shape = bodies.shapes()[bodies.shape_id(i)];
  if (differs(atom.radius[i], shape.bounding_radius()))
    return "radius '" + number(atom.radius[i]) + "' is not the bounding radius of its shape; expected " +
           number(shape.bounding_radius()) +
           "; leave the radius of bodies alone and declare one particletemplate/cluster "
           "per size";
  if (differs(atom.rmass[i], atom.density[i] * shape.volume()))
    return "mass '" + number(atom.rmass[i]) + "' is not density times volume of its shape; expected " +
           number(atom.density[i] * shape.volume()) + "; change it with set density or set mass alone";
  return {};
}

void check_bodies(LAMMPS* lmp, const FixClusterBodies& bodies) {
  const Atom& atom = *lmp->atom;
  const Motion motion(*lmp->modify);
  const bool moves = lmp->update->nsteps > 0;
  int lowest = std::numeric_limits<int>::max();
  std::string sentence;
  for (int i = 0; i < atom.nlocal; ++i) {
    if (bodies.shape_id(i) == FixClusterBodies::plain_sphere || atom.tag[i] >= lowest)
      continue;
    std::string problem = size_problem(atom, bodies, i);
    if (problem.empty())
      problem = motion.problem(atom.mask[i], moves);
    if (problem.empty())
      continue;
    lowest = atom.tag[i];
    sentence = body_name(atom, bodies, i) + ": " + problem;
  }
  stop_at_lowest(lmp, lowest, sentence);
}

/// Bodies of a restart file come back only if something asks for them before the first run.
void refuse_unused_restart(LAMMPS* lmp) {
  if (!FixClusterBodies::find(lmp) && lmp->modify->n_restart_data_global_style(FixClusterBodies::style_name) > 0)
    lmp->error->all(FLERR,
                    "read_restart: the clusters of the file are not used, and each would become its bounding "
                    "sphere; expected pair_style gran/cluster and fix nve/cluster before the first run; add them");
}

void check_scene(LAMMPS* lmp) {
  refuse_unused_restart(lmp);
  FixClusterBodies* bodies = bodies_in_script(lmp);
  if (!bodies)
    return;
  refuse_incompatible_styles(lmp, *bodies);
  if (lmp->update->whichflag == 1)
    check_bodies(lmp, *bodies);
}

const RegisterSceneCheck registered(&check_scene);

} // namespace

std::string body_name(const Atom& atom, const FixClusterBodies& bodies, int i) {
  return "atom " + std::to_string(atom.tag[i]) + " (cluster '" + bodies.shapes()[bodies.shape_id(i)].name() + "')";
}

void stop_at_lowest(LAMMPS* lmp, int tag, std::string sentence) {
  struct {
    int tag, rank;
  } here = {tag, lmp->comm->me}, lowest = {};
  MPI_Allreduce(&here, &lowest, 1, MPI_2INT, MPI_MINLOC, lmp->world);
  if (lowest.tag == std::numeric_limits<int>::max())
    return;
  int size = static_cast<int>(sentence.size());
  MPI_Bcast(&size, 1, MPI_INT, lowest.rank, lmp->world);
  sentence.resize(size);
  MPI_Bcast(sentence.data(), size, MPI_CHAR, lowest.rank, lmp->world);
  lmp->error->all(FLERR, sentence.c_str());
}

void check_new_bodies(LAMMPS* lmp, FixClusterBodies& bodies) {
  const Atom& atom = *lmp->atom;
  const Motion motion(*lmp->modify);
  for (int i = 0; i < atom.nlocal; ++i) {
    if (bodies.shape_id(i) == FixClusterBodies::plain_sphere)
      continue;
    const std::string problem = motion.problem(atom.mask[i], lmp->update->nsteps > 0);
    const std::string refused = refusal_of_body(lmp, i);
    if (!refused.empty())
      lmp->error->one(FLERR, refused.c_str());
    if (!problem.empty())
      lmp->error->one(FLERR, (body_name(atom, bodies, i) + ": " + problem).c_str());
  }
}

} // namespace eccentra::styles
