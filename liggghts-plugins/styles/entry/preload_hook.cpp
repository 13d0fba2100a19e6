// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS has no plug-in loader. Its library is not linked -Bsymbolic, so a definition of ours comes first, whether we
// were preloaded into the stock binary or linked into a launcher: before a script is read, we enter.
#include "styles/entry/error_reports.h"
#include "styles/entry/host_symbols.h"
#include "styles/entry/script_replay.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "dump.h"
#include "error.h"
#include "input.h"
#include "lammps.h"
#include "output.h"
#include "write_restart.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

/// The definition that ours stands in front of.
template <class Function> Function next_definition(const char* mangled_name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, mangled_name));
}

constexpr char kExecuteCommand[] = "_ZN9LAMMPS_NS5Input15execute_commandEv";
constexpr char kInit[] = "_ZN9LAMMPS_NS6LAMMPS4initEv";
constexpr char kWriteRestart[] = "_ZN9LAMMPS_NS12WriteRestart5writeEPc";
constexpr char kAddDump[] = "_ZN9LAMMPS_NS6Output8add_dumpEiPPc";

/// The library calls these four itself. One that was linked to call its own would run scripts without a check of ours.
void refuse_a_library_that_passes_us_by(LAMMPS_NS::LAMMPS* lmp) {
  static bool seen = false;
  if (seen)
    return;
  seen = true;
  const void* const inside = dlsym(RTLD_DEFAULT, "_ZN9LAMMPS_NS5Input5parseEv"); // we have none of that name
  if (!eccentra::styles::bound_inside(inside, {kExecuteCommand, kInit, kWriteRestart, kAddDump}).empty())
    lmp->error->all(
        FLERR, "libeccentra cannot act in this libliggghts, which was linked with -Bsymbolic-functions as Ubuntu's "
               "packages are: build LIGGGHTS-PUBLIC " ECCENTRA_LIGGGHTS_VERSION
               " from source and set Eccentra up with scripts/setup --liggghts FOLDER, or use a container");
}

/// LIGGGHTS prints its error and calls MPI_Abort, which throws away what a pipe or file has not yet been given: a job's
/// log would end without the reason. By whole lines, nothing is lost.
struct LineBufferedOutput {
  LineBufferedOutput() { std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ); }
};
const LineBufferedOutput line_buffered_output;

/// The guard of a command: its own, or the one of all others, or null.
eccentra::styles::CommandGuard guard_of(const std::string& command) {
  eccentra::styles::CommandGuard of_others = nullptr;
  for (const auto& [name, guard] : eccentra::styles::command_guards()) {
    if (name == command)
      return guard;
    if (name == "*")
      of_others = guard;
  }
  return of_others;
}

void enter_host(LAMMPS_NS::LAMMPS* lmp) {
  refuse_a_library_that_passes_us_by(lmp);
  eccentra::styles::enter(lmp);
}

} // namespace

namespace LAMMPS_NS {

void Input::file() {
  enter_host(lmp);
  eccentra::styles::watch_errors(lmp);
  static const auto stock = next_definition<void (*)(Input*)>("_ZN9LAMMPS_NS5Input4fileEv");
  stock(this);
}

void Input::file(const char* name) {
  enter_host(lmp);
  eccentra::styles::watch_errors(lmp);
  static const auto stock = next_definition<void (*)(Input*, const char*)>("_ZN9LAMMPS_NS5Input4fileEPKc");
  stock(this, name);
}

char* Input::one(const char* line) {
  enter_host(lmp);
  static const auto stock = next_definition<char* (*)(Input*, const char*)>("_ZN9LAMMPS_NS5Input3oneEPKc");
  return stock(this, line);
}

// Every command passes here when its arguments are known: of the script, of the command line and of other programs.
int Input::execute_command() {
  static const auto stock = next_definition<int (*)(Input*)>(kExecuteCommand);
  // A command may read another, which takes the place of its arguments.
  const std::string name = command;
  const std::vector<std::string> read_arguments(arg, arg + narg);
  int unknown = 0;
  const auto act = [&] {
    if (!eccentra::styles::stands_in_for(lmp, name.c_str(), narg, arg))
      unknown = stock(this);
  };
  if (const eccentra::styles::CommandGuard guard = guard_of(name)) {
    const auto execute = [&](const std::vector<std::string>& arguments) {
      // The arguments as they were read stay where LIGGGHTS put them; others live until the command has ended.
      std::vector<std::string> copies = arguments;
      std::vector<char*> words;
      for (std::string& copy : copies)
        words.push_back(copy.data());
      char** const read = arg;
      const int number_read = narg;
      const bool same = std::equal(arguments.begin(), arguments.end(), arg, arg + narg,
                                   [](const std::string& a, const char* b) { return a == b; });
      if (!same) {
        arg = words.data();
        narg = static_cast<int>(words.size());
      }
      act();
      if (!same) {
        arg = read;
        narg = number_read;
      }
    };
    guard(lmp, name, read_arguments, execute);
  } else {
    act();
  }
  if (name == "clear") // LIGGGHTS has made its registries anew
    eccentra::styles::enter(lmp);
  if (unknown == 0)
    eccentra::styles::after(lmp, name, read_arguments);
  return unknown;
}

void LAMMPS::init() {
  for (const eccentra::styles::SceneCheck check : eccentra::styles::scene_checks())
    check(this);
  static const auto stock = next_definition<void (*)(LAMMPS*)>(kInit);
  stock(this);
}

void WriteRestart::write(char* file) {
  static const auto stock = next_definition<void (*)(WriteRestart*, char*)>(kWriteRestart);
  stock(this, file);
  for (const eccentra::styles::RestartListener listener : eccentra::styles::restart_listeners())
    listener(lmp, file);
}

// Dump styles are a chain of comparisons, not a map: make a stock dump in our dump's place, then exchange the two.
void Output::add_dump(int narg, char** arg) {
  static const auto stock = next_definition<void (*)(Output*, int, char**)>(kAddDump);
  const eccentra::styles::StyleRecord* ours = nullptr;
  for (const auto& record : eccentra::styles::style_records())
    if (record.dump && narg > 2 && record.name == arg[2])
      ours = &record;
  if (!ours) {
    stock(this, narg, arg);
    return;
  }
  if (narg < 5)
    error->all(FLERR, ("dump " + ours->name + " needs: dump ID group " + ours->name + " every file").c_str());
  std::string style = "custom"; // a LIGGGHTS without VTK has it, too
  std::string column = "id";
  std::vector<char*> stock_arg(arg, arg + 5);
  stock_arg[2] = style.data();
  stock_arg.push_back(column.data());
  stock(this, static_cast<int>(stock_arg.size()), stock_arg.data());
  // Ours first: if it refuses its arguments, what is in the list is still whole when LIGGGHTS takes itself down.
  Dump* const our_dump = ours->dump(lmp, narg, arg);
  delete dump[ndump - 1];
  dump[ndump - 1] = our_dump;
}

} // namespace LAMMPS_NS
