// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes our records into the style maps of a LIGGGHTS instance.
#include "styles/entry/style_registry.h"

#include "styles/entry/private_access.h"

#include <mpi.h>

#include "error.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "universe.h"

#include <cstring>
#include <map>
#include <string>

namespace {

using namespace LAMMPS_NS;
using namespace eccentra::styles;

// Modify::fix_map, Modify::compute_map and Input::command_map are private and have no setter.
struct FixMap {
  using type = std::map<std::string, FixCreator>* Modify::*;
};
struct ComputeMap {
  using type = std::map<std::string, ComputeCreator>* Modify::*;
};
struct CommandMap {
  using type = std::map<std::string, CommandCreator>* Input::*;
};

template <class Map> std::vector<std::string> names(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map)
    names.push_back(entry.first);
  return names;
}

} // namespace

namespace eccentra::styles {

template struct PrivateMember<FixMap, &LAMMPS_NS::Modify::fix_map>;
template struct PrivateMember<ComputeMap, &LAMMPS_NS::Modify::compute_map>;
template struct PrivateMember<CommandMap, &LAMMPS_NS::Input::command_map>;

std::vector<StyleRecord>& style_records() {
  static std::vector<StyleRecord> records;
  return records;
}

std::vector<std::pair<std::string, CommandGuard>>& command_guards() {
  static std::vector<std::pair<std::string, CommandGuard>> guards;
  return guards;
}

std::vector<SceneCheck>& scene_checks() {
  static std::vector<SceneCheck> checks;
  return checks;
}

std::vector<RestartListener>& restart_listeners() {
  static std::vector<RestartListener> listeners;
  return listeners;
}

std::vector<std::string> registered_fixes(LAMMPS_NS::LAMMPS* lmp) {
  return names(*(lmp->modify->*Published<FixMap>::pointer));
}

std::vector<std::string> registered_computes(LAMMPS_NS::LAMMPS* lmp) {
  return names(*(lmp->modify->*Published<ComputeMap>::pointer));
}

std::vector<std::string> registered_commands(LAMMPS_NS::LAMMPS* lmp) {
  return names(*(lmp->input->*Published<CommandMap>::pointer));
}

void enter(LAMMPS_NS::LAMMPS* lmp) {
  if (std::strstr(lmp->universe->version, "LIGGGHTS-PUBLIC " ECCENTRA_LIGGGHTS_VERSION) == nullptr) {
    const std::string text = std::string("libeccentra was built against LIGGGHTS-PUBLIC " ECCENTRA_LIGGGHTS_VERSION
                                         " but was loaded into '") +
                             lmp->universe->version + "': build Eccentra again with scripts/setup on this machine";
    lmp->error->all(FLERR, text.c_str());
  }
  for (const StyleRecord& record : style_records()) {
    if (record.fix)
      (*(lmp->modify->*Published<FixMap>::pointer))[record.name] = record.fix;
    if (record.compute)
      (*(lmp->modify->*Published<ComputeMap>::pointer))[record.name] = record.compute;
    if (record.command)
      (*(lmp->input->*Published<CommandMap>::pointer))[record.name] = record.command;
    if (record.pair)
      (*lmp->force->pair_map)[record.name] = record.pair;
  }
}

} // namespace eccentra::styles
