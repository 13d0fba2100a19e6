// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every style of ours announces itself with one static record; enter() hands all records to a LIGGGHTS instance.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
class Fix;
class Compute;
class Dump;
class Pair;
} // namespace LAMMPS_NS

namespace eccentra::styles {

using FixCreator = LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**);
using ComputeCreator = LAMMPS_NS::Compute* (*)(LAMMPS_NS::LAMMPS*, int, int, char**);
using DumpCreator = LAMMPS_NS::Dump* (*)(LAMMPS_NS::LAMMPS*, int, char**);
using CommandCreator = void (*)(LAMMPS_NS::LAMMPS*, int, char**);
using PairCreator = LAMMPS_NS::Pair* (*)(LAMMPS_NS::LAMMPS*);

/// One style: the arguments a user types (for example "fix", "nve/cluster"), and a sentence for `eccentra-dem -h`.
struct StyleRecord {
  std::string kind;
  std::string name;
  std::string summary;
  FixCreator fix = nullptr;
  ComputeCreator compute = nullptr;
  DumpCreator dump = nullptr;
  CommandCreator command = nullptr;
  PairCreator pair = nullptr;
};

/// All records of the process, in the order in which they were announced.
std::vector<StyleRecord>& style_records();

/// Announces a style when the library is loaded: one static object per style, beside the style's own code.
struct RegisterStyle {
  explicit RegisterStyle(StyleRecord record) { style_records().push_back(std::move(record)); }
};

/// Creator for a class with the usual constructor (LAMMPS*, int, char**).
template <class Style, class Base> Base* create(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  return new Style(lmp, narg, arg);
}

/// Announces a fix style.
template <class Style> struct RegisterFix : RegisterStyle {
  RegisterFix(const char* name, const char* summary)
      : RegisterStyle({"fix", name, summary, &create<Style, LAMMPS_NS::Fix>}) {}
};

/// Creator for a compute class with the usual constructor (LAMMPS*, int&, int, char**).
template <class Style> LAMMPS_NS::Compute* create_compute(LAMMPS_NS::LAMMPS* lmp, int iarg, int narg, char** arg) {
  return new Style(lmp, iarg, narg, arg);
}

/// Announces a compute style.
template <class Style> struct RegisterCompute : RegisterStyle {
  RegisterCompute(const char* name, const char* summary)
      : RegisterStyle({"compute", name, summary, nullptr, &create_compute<Style>}) {}
};

/// Announces a command: a function that gets its arguments.
struct RegisterCommand : RegisterStyle {
  RegisterCommand(const char* name, const char* summary, CommandCreator command)
      : RegisterStyle({"command", name, summary, nullptr, nullptr, nullptr, command}) {}
};

/// Announces a dump style.
template <class Style> struct RegisterDump : RegisterStyle {
  RegisterDump(const char* name, const char* summary)
      : RegisterStyle({"dump", name, summary, nullptr, nullptr, &create<Style, LAMMPS_NS::Dump>}) {}
};

/// Announces arguments that reach LIGGGHTS by another way (contact models, sub-styles of pair gran), for the list in
/// -h.
struct RegisterKeywords : RegisterStyle {
  RegisterKeywords(const char* kind, const char* name, const char* summary) : RegisterStyle({kind, name, summary}) {}
};

/// Stands in for one command of an input script. `stock` executes the command as LIGGGHTS does; an argument list other
/// than the one that was read can be given to it.
using StockCommand = std::function<void(const std::vector<std::string>& arguments)>;
using CommandGuard = void (*)(LAMMPS_NS::LAMMPS* lmp, const std::string& command,
                              const std::vector<std::string>& arguments, const StockCommand& stock);

/// The guards by the name of their command; "*" is for every command that has none. Variables have been substituted.
/// What `if`, `include`, `jump` and `next` execute comes here command by command.
std::vector<std::pair<std::string, CommandGuard>>& command_guards();

/// Announces a guard when the library is loaded.
struct RegisterCommandGuard {
  RegisterCommandGuard(const char* command, CommandGuard guard) { command_guards().emplace_back(command, guard); }
};

/// Checks of the whole scene at the start of each run (of LAMMPS::init, before any style's init).
using SceneCheck = void (*)(LAMMPS_NS::LAMMPS* lmp);
std::vector<SceneCheck>& scene_checks();

/// Announces a check when the library is loaded.
struct RegisterSceneCheck {
  explicit RegisterSceneCheck(SceneCheck check) { scene_checks().push_back(check); }
};

/// Hears of each restart file that LIGGGHTS has written and closed, on all ranks; a '%' in its name stands for `base`
/// and for the ranks.
using RestartListener = void (*)(LAMMPS_NS::LAMMPS* lmp, const std::string& file);
std::vector<RestartListener>& restart_listeners();

/// Announces a listener when the library is loaded.
struct RegisterRestartListener {
  explicit RegisterRestartListener(RestartListener listener) { restart_listeners().push_back(listener); }
};

/// The styles that the registries of this LIGGGHTS instance hold, ours among them.
std::vector<std::string> registered_fixes(LAMMPS_NS::LAMMPS* lmp);
std::vector<std::string> registered_computes(LAMMPS_NS::LAMMPS* lmp);
std::vector<std::string> registered_commands(LAMMPS_NS::LAMMPS* lmp);

/// Makes all our styles known to this LIGGGHTS instance. Safe to call more than once. Stops all ranks with one sentence
/// if the LIGGGHTS that loaded us is not the version that we were built against.
void enter(LAMMPS_NS::LAMMPS* lmp);

} // namespace eccentra::styles
