// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock commands that change atoms between runs, made right for bodies: set, displace_atoms, delete_atoms.
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/incompatible_styles.h"
#include "styles/entry/style_registry.h"
#include "styles/pairs/fix_cluster_history.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "lammps.h"
#include "modify.h"
#include "region.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <string>
#include <vector>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;
using Words = std::vector<std::string>;

/// The local bodies that a `set` command selects; empty where the selection is not one that LIGGGHTS knows.
std::vector<int> selected_bodies(LAMMPS* lmp, const FixClusterBodies& bodies, const Words& arguments) {
  std::vector<int> selected;
  if (arguments.size() < 2)
    return selected;
  const Atom& atom = *lmp->atom;
  const std::string& style = arguments[0];
  std::string id = arguments[1];
  int low = 0, high = -1, bits = 0;
  Region* region = nullptr;
  if (style == "atom")
    lmp->force->bounds(id.data(), MAXSMALLINT, low, high);
  else if (style == "type")
    lmp->force->bounds(id.data(), atom.ntypes, low, high);
  else if (style == "group" && lmp->group->find(id.c_str()) >= 0)
    bits = lmp->group->bitmask[lmp->group->find(id.c_str())];
  else if (style == "region" && lmp->domain->find_region(id.data()) >= 0)
    region = lmp->domain->regions[lmp->domain->find_region(id.data())];
  for (int i = 0; i < atom.nlocal; ++i) {
    const int value = style == "atom" ? atom.tag[i] : atom.type[i];
    const double* x = atom.x[i];
    const bool in =
        (low <= value && value <= high) || (atom.mask[i] & bits) || (region && region->match(x[0], x[1], x[2]));
    if (in && bodies.shape_id(i) != FixClusterBodies::plain_sphere)
      selected.push_back(i);
  }
  return selected;
}

/// The arguments of `set` that name what is set, in their order.
std::vector<const StockStyle*> set_words(const Words& arguments) {
  std::vector<const StockStyle*> found;
  for (std::size_t n = 2; n < arguments.size(); ++n) {
    const StockStyle* style = find_stock_style(StockKind::set, arguments[n]);
    if (!style)
      continue;
    found.push_back(style);
    n += arguments[n] == "property/atom" ? 1 : 0; // its name is the user's
  }
  return found;
}

void set(LAMMPS* lmp, const std::string&, const Words& arguments, const StockCommand& stock) {
  FixClusterBodies* bodies = bodies_in_script(lmp);
  if (!bodies) {
    stock(arguments);
    return;
  }
  const std::vector<int> selected = selected_bodies(lmp, *bodies, arguments);
  const int here = selected.empty() ? 0 : 1;
  int anywhere = 0;
  MPI_Allreduce(&here, &anywhere, 1, MPI_INT, MPI_MAX, lmp->world);
  const std::vector<const StockStyle*> names = set_words(arguments);
  for (const StockStyle* style : names)
    if (anywhere && style->verdict == StockVerdict::refused)
      lmp->error->all(FLERR, (refusal(*style, "set") + ", or select plain spheres alone").c_str());
  stock(arguments);
  const StockStyle* last = nullptr; // of density and mass, the later one counts
  for (const StockStyle* style : names)
    if (!std::string("density").compare(style->name) || !std::string("mass").compare(style->name))
      last = style;
  if (!last)
    return;
  for (const int i : selected) {
    const double volume = bodies->shapes()[bodies->shape_id(i)].volume();
    if (!std::string("density").compare(last->name))
      lmp->atom->rmass[i] = lmp->atom->density[i] * volume;
    else
      lmp->atom->density[i] = lmp->atom->rmass[i] / volume;
    contact::rotation_matrix(bodies->quaternion(i), bodies->rotation(i));
    bodies->momentum_from_omega(i); // the spin stays
  }
}

/// For each tag up to the highest of all ranks: 1 if the atom is among the marked ones of any rank. Collective.
std::vector<char> marked_tags(LAMMPS* lmp, const std::vector<int>& marked) {
  const Atom& atom = *lmp->atom;
  int highest = 0, highest_of_all = 0;
  for (int i = 0; i < atom.nlocal; ++i)
    highest = std::max(highest, atom.tag[i]);
  MPI_Allreduce(&highest, &highest_of_all, 1, MPI_INT, MPI_MAX, lmp->world);
  std::vector<char> tags(static_cast<std::size_t>(highest_of_all) + 1, 0);
  for (const int i : marked)
    tags[atom.tag[i]] = 1;
  MPI_Allreduce(MPI_IN_PLACE, tags.data(), static_cast<int>(tags.size()), MPI_CHAR, MPI_MAX, lmp->world);
  return tags;
}

/// Turns orientations of the group's bodies, and what tangential springs between two atoms of the group remember, by
/// `angle`, a rotation vector [rad]. Velocity and spin stay, as LIGGGHTS leaves velocities.
void turn_bodies(LAMMPS* lmp, FixClusterBodies& bodies, int group_bit, const Eigen::Vector3d& angle) {
  std::vector<int> turned;
  for (int i = 0; i < lmp->atom->nlocal; ++i)
    if (lmp->atom->mask[i] & group_bit)
      turned.push_back(i);
  for (const int i : turned) {
    if (bodies.shape_id(i) == FixClusterBodies::plain_sphere)
      continue;
    contact::rotate_in_world(bodies.quaternion(i), angle.data());
    contact::normalise(bodies.quaternion(i));
    contact::rotation_matrix(bodies.quaternion(i), bodies.rotation(i));
    bodies.momentum_from_omega(i);
  }
  FixClusterHistory* history = FixClusterHistory::find(lmp);
  if (!history)
    return;
  const std::vector<char> tags = marked_tags(lmp, turned);
  const Eigen::Matrix3d turn = angle.norm() > 0 ? Eigen::AngleAxisd(angle.norm(), angle.normalized()).toRotationMatrix()
                                                : Eigen::Matrix3d::Identity();
  for (const int i : turned)
    for (Touch& touch : history->touches(i))
      if (static_cast<std::size_t>(touch.partner) < tags.size() && tags[touch.partner]) {
        Eigen::Map<Eigen::Vector3d> displacement(touch.displacement);
        displacement = (turn * displacement).eval();
      }
}

void displace_atoms(LAMMPS* lmp, const std::string&, const Words& arguments, const StockCommand& stock) {
  FixClusterBodies* bodies = bodies_in_script(lmp);
  const int group = arguments.empty() ? -1 : lmp->group->find(arguments[0].c_str());
  constexpr std::size_t axis = 5, degrees = 8;
  const bool turns = bodies && group >= 0 && arguments.size() > degrees && arguments[1] == "rotate";
  if (!turns || lmp->modify->nfix_restart_peratom > 0) { // LIGGGHTS refuses that itself
    stock(arguments);
    return;
  }
  Words copies = arguments;
  const auto value = [&](std::size_t n) { return lmp->force->numeric(FLERR, copies[n].data()); };
  const Eigen::Vector3d direction(value(axis), value(axis + 1), value(axis + 2));
  if (direction.norm() > 0)
    turn_bodies(lmp, *bodies, lmp->group->bitmask[group], direction.normalized() * (value(degrees) * M_PI / 180));
  stock(arguments); // sends atoms to the ranks that own their new places, with what they have by now
}

/// Numbers the atoms from 1 on without gaps and in the order of their ids, and what contacts remember with them.
void renumber(LAMMPS* lmp, FixClusterHistory& history) {
  Atom& atom = *lmp->atom;
  std::vector<int> all(atom.nlocal);
  for (int i = 0; i < atom.nlocal; ++i)
    all[i] = i;
  const std::vector<char> present = marked_tags(lmp, all);
  std::vector<int> renumbered(present.size(), 0);
  int next = 0;
  for (std::size_t tag = 1; tag < present.size(); ++tag)
    if (present[tag])
      renumbered[tag] = ++next;
  for (int i = 0; i < atom.nlocal; ++i) {
    atom.tag[i] = renumbered[atom.tag[i]];
    std::vector<Touch>& touches = history.touches(i);
    for (Touch& touch : touches)
      touch.partner = static_cast<std::size_t>(touch.partner) < renumbered.size() ? renumbered[touch.partner] : 0;
    touches.erase(std::remove_if(touches.begin(), touches.end(), [](const Touch& touch) { return touch.partner == 0; }),
                  touches.end());
  }
  if (atom.map_style) {
    atom.nghost = 0;
    atom.map_init();
    atom.map_set();
  }
}

void delete_atoms(LAMMPS* lmp, const std::string&, const Words& arguments, const StockCommand& stock) {
  FixClusterHistory* history = FixClusterHistory::find(lmp);
  if (!history || lmp->atom->molecular || arguments.size() < 2) {
    stock(arguments);
    return;
  }
  // The option that comes last counts; LIGGGHTS checks that it is yes or no.
  bool compress = true;
  Words without = arguments;
  for (std::size_t n = 2; n + 1 < without.size(); ++n)
    if (without[n] == "compress" && (without[n + 1] == "yes" || without[n + 1] == "no")) {
      compress = without[n + 1] == "yes";
      without[n + 1] = "no";
    }
  without.insert(without.end(), {"compress", "no"});
  stock(without);
  if (compress)
    renumber(lmp, *history);
}

const RegisterCommandGuard registered[] = {
    {"set", &set}, {"displace_atoms", &displace_atoms}, {"delete_atoms", &delete_atoms}};

} // namespace
} // namespace eccentra::styles
