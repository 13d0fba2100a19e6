// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Looks up the styles of a scene, and of each command, in the table of stock styles.
#include "styles/bodies/incompatible_styles.h"

#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "compute.h"
#include "domain.h"
#include "dump.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <cstring>
#include <string>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;
using Words = std::vector<std::string>;

[[noreturn]] void stop(LAMMPS* lmp, const std::string& sentence) {
  lmp->error->all(FLERR, sentence.c_str());
  std::abort(); // error->all does not return
}

/// The row of a style if it is refused, else null.
const StockStyle* refused_row(StockKind kind, const std::string& name) {
  const StockStyle* style = find_stock_style(kind, name);
  return style && style->verdict == StockVerdict::refused ? style : nullptr;
}

/// True on all ranks if the group holds a body on any, or is the group `all`, into which every new body comes.
/// Collective.
bool group_has_bodies(LAMMPS* lmp, const FixClusterBodies& bodies, int group) {
  if (group == 0)
    return true;
  if (group < 0)
    return false; // LIGGGHTS itself refuses it
  int here = 0;
  for (int i = 0; i < lmp->atom->nlocal; ++i)
    if ((lmp->atom->mask[i] & lmp->group->bitmask[group]) && bodies.shape_id(i) != FixClusterBodies::plain_sphere)
      here = 1;
  int anywhere = 0;
  MPI_Allreduce(&here, &anywhere, 1, MPI_INT, MPI_MAX, lmp->world);
  return anywhere != 0;
}

void refuse(LAMMPS* lmp, const FixClusterBodies& bodies, const StockStyle* style, const std::string& who, int group) {
  if (style && (style->reach == StockReach::scene || group_has_bodies(lmp, bodies, group)))
    stop(lmp, refusal(*style, who));
}

std::string word(const Words& arguments, std::size_t n) {
  return n < arguments.size() ? arguments[n] : std::string();
}

/// Refuses what a command is about to make, or the command itself.
void refuse_command(LAMMPS* lmp, const FixClusterBodies& bodies, const std::string& command, const Words& arguments) {
  const std::string first = word(arguments, 0);
  if (const StockStyle* style = refused_row(StockKind::command, command))
    stop(lmp, refusal(*style, "command"));
  const int group = arguments.size() > 1 ? lmp->group->find(arguments[1].c_str()) : -1;
  if (command == "fix")
    refuse(lmp, bodies, refused_row(StockKind::fix, word(arguments, 2)), "fix " + first, group);
  else if (command == "compute")
    refuse(lmp, bodies, refused_row(StockKind::compute, word(arguments, 2)), "compute " + first, group);
  else if (command == "dump")
    refuse(lmp, bodies, refused_row(StockKind::dump, word(arguments, 2)), "dump " + first, 0);
  else if (command == "write_dump")
    refuse(lmp, bodies, refused_row(StockKind::dump, word(arguments, 1)), "write_dump", 0);
  else if (command == "thermo_style")
    for (const std::string& column : arguments)
      refuse(lmp, bodies, refused_row(StockKind::thermo, column), "thermo_style", 0);
  else
    for (const StockKind kind : {StockKind::pair_style, StockKind::run_style, StockKind::min_style})
      if (command == kind_name(kind))
        refuse(lmp, bodies, refused_row(kind, first), command, 0);
}

void guard(LAMMPS* lmp, const std::string& command, const Words& arguments, const StockCommand& stock) {
  if (const FixClusterBodies* bodies = bodies_in_script(lmp))
    refuse_command(lmp, *bodies, command, arguments);
  stock(arguments);
}

const RegisterCommandGuard registered("*", &guard);

void refuse_scene(LAMMPS* lmp) {
  if (lmp->domain->dimension != 3)
    stop(lmp, "dimension: '2' is not offered with clusters, which are solids; expected 3; use a thin box with periodic "
              "sides");
  const Atom& atom = *lmp->atom;
  if (!atom.radius_flag || !atom.rmass_flag || !atom.density_flag || !atom.omega_flag || !atom.torque_flag)
    stop(lmp, "atom_style: '" + std::string(atom.atom_style) +
                  "' is not offered with clusters, because its atoms lack radius, mass, spin or torque; use atom_style "
                  "granular");
  if (!lmp->force->pair || std::strcmp(lmp->force->pair_style, "gran/cluster") != 0)
    stop(lmp, "pair_style: '" + std::string(lmp->force->pair ? lmp->force->pair_style : "none") +
                  "' is not offered with clusters, because it computes forces between bounding spheres, or none; write "
                  "pair_style gran/cluster model hertz tangential history rolling_friction off");
  if (const StockStyle* style = refused_row(StockKind::run_style, lmp->update->integrate_style))
    stop(lmp, refusal(*style, "run_style"));
  if (lmp->update->whichflag == 2)
    stop(lmp, refusal(*find_stock_style(StockKind::command, "minimize"), "command"));
}

} // namespace

FixClusterBodies* bodies_in_script(LAMMPS* lmp) {
  FixClusterBodies* bodies = FixClusterBodies::find(lmp);
  return bodies && bodies->shapes().size() > 0 ? bodies : nullptr;
}

void refuse_incompatible_styles(LAMMPS* lmp, FixClusterBodies& bodies) {
  refuse_scene(lmp);
  for (int n = 0; n < lmp->modify->nfix; ++n) {
    const LAMMPS_NS::Fix* fix = lmp->modify->fix[n];
    refuse(lmp, bodies, refused_row(StockKind::fix, fix->style), "fix " + std::string(fix->id), fix->igroup);
  }
  for (int n = 0; n < lmp->modify->ncompute; ++n) {
    const LAMMPS_NS::Compute* compute = lmp->modify->compute[n];
    refuse(lmp, bodies, refused_row(StockKind::compute, compute->style), "compute " + std::string(compute->id),
           compute->igroup);
  }
  for (int n = 0; n < lmp->output->ndump; ++n) {
    const LAMMPS_NS::Dump* dump = lmp->output->dump[n];
    refuse(lmp, bodies, refused_row(StockKind::dump, dump->style), "dump " + std::string(dump->id), 0);
  }
}

std::string refusal_of_body(LAMMPS* lmp, int i) {
  for (int n = 0; n < lmp->modify->nfix; ++n) {
    const LAMMPS_NS::Fix* fix = lmp->modify->fix[n];
    const StockStyle* style = refused_row(StockKind::fix, fix->style);
    if (style && (lmp->atom->mask[i] & fix->groupbit))
      return refusal(*style, "fix " + std::string(fix->id));
  }
  for (int n = 0; n < lmp->modify->ncompute; ++n) {
    const LAMMPS_NS::Compute* compute = lmp->modify->compute[n];
    const StockStyle* style = refused_row(StockKind::compute, compute->style);
    if (style && (lmp->atom->mask[i] & compute->groupbit))
      return refusal(*style, "compute " + std::string(compute->id));
  }
  return {};
}

} // namespace eccentra::styles
