// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Goes through a script's commands for the second time.
#include "styles/entry/script_replay.h"

#include "base/option_reader.h"
#include "link/checkpoint/checkpoint_room.h"
#include "link/checkpoint/resume_command.h"
#include "link/ranks.h"
#include "styles/entry/fix_checkpoint.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "read_restart.h"
#include "run.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {

namespace fs = std::filesystem;

struct Script {
  bool asked = false;     ///< -resume was given
  bool goes_on = false;   ///< from a checkpoint, until the first run that it has not behind it
  bool replaying = false; ///< goes_on, in a script with `resumable`
  bool read = false;      ///< the checkpoint is in memory
  bool resumable = false;
  bool inside_run = false;  ///< which goes on in pieces
  bool set_up_anew = false; ///< the straight run, too, sets up here
  std::int64_t every = 0;   ///< steps between checkpoints of a script without a fluid; 0: by the clock
  link::CheckpointChoice choice;
  std::vector<RunSpan> done;    ///< of the checkpoint; the last one is that in which it was written
  std::vector<RunSpan> runs;    ///< that this script has begun or left out
  std::set<std::string> groups; ///< of the checkpoint
};

Script& script() {
  static Script* const one = new Script; // outlives everything, for exit handlers
  return *one;
}

/// They make the box.
const std::set<std::string> kBeginnings = {"create_box", "read_data", "read_restart"};
/// They change particles, their box or the step, or write what the interrupted run has written.
const std::set<std::string> kLeftOut = {
    "create_atoms", "set",           "velocity",   "delete_atoms", "delete_bonds", "displace_atoms",
    "displace_box", "change_box",    "replicate",  "rotate",       "minimize",     "reset_timestep",
    "read_dump",    "write_restart", "write_data", "write_dump",   "balance",      "rerun"};

[[noreturn]] void refuse(LAMMPS* lmp, const std::string& text) {
  lmp->error->all(FLERR, text.c_str());
  std::abort(); // error->all does not return
}

void tell(LAMMPS* lmp, const std::string& text) {
  if (lmp->comm->me == 0)
    for (FILE* out : {lmp->screen, lmp->logfile})
      if (out)
        std::fprintf(out, "%s\n", text.c_str());
}

std::string checkpoint_name() {
  return "checkpoint " + std::to_string(script().choice.mark.step);
}

void read_checkpoint(LAMMPS* lmp) {
  std::string file = script().choice.restart_file;
  char* arguments[] = {file.data()};
  ReadRestart(lmp).command(1, arguments);
  script().read = true;
  script().groups.clear();
  for (int i = 0; i < lmp->group->ngroup; ++i)
    if (lmp->group->names[i])
      script().groups.insert(lmp->group->names[i]);
}

/// The steps from which to which a `run` or `run_time` goes if it begins at `first`; last -1: LIGGGHTS will complain.
RunSpan span_of(LAMMPS* lmp, const std::string& command, int narg, char** arg, std::int64_t first) {
  if (narg < 1)
    return {first, -1};
  const std::int64_t steps = command == "run_time"
                                 ? static_cast<std::int64_t>(std::ceil(std::atof(arg[0]) / lmp->update->dt))
                                 : std::strtoll(arg[0], nullptr, 10);
  const bool upto = std::any_of(arg + 1, arg + narg, [](const char* word) { return std::strcmp(word, "upto") == 0; });
  return {first, upto ? steps : first + steps};
}

/// `run ... pre no` sets nothing up, unless it is the first run.
bool sets_up(int narg, char** arg) {
  for (int i = 1; i + 1 < narg && std::strcmp(arg[i], "every") != 0; ++i)
    if (std::strcmp(arg[i], "pre") == 0)
      return std::strcmp(arg[i + 1], "no") != 0;
  return true;
}

/// The checkpoint fell on the last step of a run.
bool stands_at_end_of_run(LAMMPS* lmp) {
  const Script& now = script();
  return now.read && !now.done.empty() && now.done.back().last == now.choice.mark.step &&
         lmp->update->ntimestep == now.choice.mark.step;
}

/// The first run that the checkpoint has not behind it: from the step of the checkpoint to its end.
void go_on_with_run(LAMMPS* lmp, int narg, char** arg, const RunSpan& whole) {
  std::vector<std::string> kept;
  std::vector<std::string> commands;
  std::int64_t every = 0;
  bool start = false, stop = false;
  const bool each_piece_sets_up = sets_up(narg, arg); // the arguments are gone after a command
  for (int i = 1; i < narg; ++i) {
    const std::string word = arg[i];
    start = start || word == "start";
    stop = stop || word == "stop";
    if (word == "every" && i + 1 < narg) {
      every = std::strtoll(arg[i + 1], nullptr, 10);
      commands.assign(arg + i + 2, arg + narg);
      break;
    }
    if (word != "upto")
      kept.push_back(word);
  }
  std::string arguments = " upto";
  for (const std::string& word : kept)
    arguments += ' ' + word;
  // What ramps goes on ramping from where the run began.
  if (!start)
    arguments += " start " + std::to_string(whole.first);
  if (!stop)
    arguments += " stop " + std::to_string(whole.last);
  script().goes_on = script().replaying = false;
  script().inside_run = true;
  const std::int64_t step = lmp->update->ntimestep;
  std::int64_t from = step;
  const auto run = [&](std::int64_t last, const std::string& more) {
    lmp->input->one(("run " + std::to_string(last) + arguments + more).c_str());
  };
  if (every > 0 && step > whole.first) {
    // To the end of the piece, which may be here: its commands come after the checkpoint.
    const std::int64_t left = (every - (step - whole.first) % every) % every;
    from = std::min(whole.last, step + left);
    run(from, "");
    for (const std::string& one : commands)
      if (one != "NULL")
        lmp->input->one(one.c_str());
    script().set_up_anew = from == step && each_piece_sets_up;
  }
  std::string more;
  if (every > 0) {
    more = " every " + std::to_string(every);
    for (const std::string& one : commands)
      more += " \"" + one + '"';
  }
  if (every == 0 || step == whole.first || from < whole.last)
    run(whole.last, more);
  script().inside_run = false;
}

void check_fluid(LAMMPS* lmp) {
  if (!resumes_alone() && lmp->modify->find_fix_style("fluid/couple", 0) == nullptr)
    refuse(
        lmp,
        checkpoint_name() +
            " is one of a coupled run but the script has no fix fluid/couple before this run: add it, or move it up");
}

/// True if the run is dealt with.
bool replay_run(LAMMPS* lmp, const std::string& command, int narg, char** arg) {
  Script& now = script();
  const std::size_t number = now.runs.size();
  if (number >= now.done.size())
    refuse(lmp, checkpoint_name() +
                    " does not say which runs of the script it has behind it: read it by 'read_restart ${checkpoint}' "
                    "instead of resumable");
  const RunSpan then = now.done[number];
  const RunSpan whole = span_of(lmp, command, narg, arg, then.first);
  if (number + 1 < now.done.size()) {
    if (whole.last != then.last)
      refuse(lmp, "run " + std::to_string(number + 1) + " of the script ends at step " + std::to_string(whole.last) +
                      " but " + checkpoint_name() + " has it end at step " + std::to_string(then.last) +
                      ": what comes before the checkpoint must stay as it was");
    now.runs.push_back(then);
    return true;
  }
  if (lmp->update->ntimestep > whole.last)
    refuse(lmp, "run " + std::to_string(number + 1) + " of the script ends at step " + std::to_string(whole.last) +
                    " but " + checkpoint_name() +
                    " is beyond it: give the run more steps, or begin anew without -resume");
  tell(lmp, "resumable: run " + std::to_string(number + 1) + " of the script goes on from step " +
                std::to_string(lmp->update->ntimestep) + " to step " + std::to_string(whole.last));
  check_fluid(lmp);
  now.runs.push_back(whole);
  go_on_with_run(lmp, narg, arg, whole);
  return true;
}

/// A file that a command of a script is about to empty belongs to the interrupted run.
void keep_output(LAMMPS* lmp, const std::string& command, int narg, char** arg) {
  if (command != "fix")
    return;
  const bool writes = narg > 2 && (std::strncmp(arg[2], "ave/", 4) == 0 || std::strcmp(arg[2], "print") == 0 ||
                                   std::strncmp(arg[2], "massflow/", 9) == 0);
  for (int i = 3; writes && i + 1 < narg; ++i)
    if (std::strcmp(arg[i], "file") == 0)
      link::on_root(lmp->world, [&] {
        std::error_code unreachable;
        if (fs::is_regular_file(arg[i + 1], unreachable))
          tell(lmp, "'" + std::string(arg[i + 1]) + "' of the interrupted run is kept as '" +
                        link::keep_beside(arg[i + 1]) + "'");
        return link::wire::Bytes();
      });
}

bool writes_file(int narg, char** arg) {
  return std::any_of(arg, arg + narg, [](const char* word) {
    return std::strcmp(word, "file") == 0 || std::strcmp(word, "append") == 0;
  });
}

/// True if the command is dealt with.
bool replay(LAMMPS* lmp, const std::string& command, int narg, char** arg) {
  if (kBeginnings.count(command) != 0) {
    if (lmp->domain->box_exist == 0)
      read_checkpoint(lmp);
    return true;
  }
  if (command == "run" || command == "run_time")
    return replay_run(lmp, command, narg, arg);
  if (kLeftOut.count(command) != 0)
    return true;
  if (command == "group")
    return narg > 0 && script().groups.count(arg[0]) != 0;
  if (command == "shell")
    return narg > 0 && std::strcmp(arg[0], "cd") != 0 && std::strcmp(arg[0], "putenv") != 0;
  if (command == "print")
    return writes_file(narg, arg);
  if (command == "log" && narg == 1 && std::strcmp(arg[0], "none") != 0) {
    lmp->input->one(("log " + std::string(arg[0]) + " append").c_str());
    return true;
  }
  keep_output(lmp, command, narg, arg);
  return false;
}

/// A script without `resumable` reads the checkpoint itself, or not at all.
void check_reading(LAMMPS* lmp, const std::string& command, int narg, char** arg) {
  const std::string remedy = ": write the line 'resumable' before it (docs/checkpoints.md), or remove or rename folder "
                             "checkpoints to begin anew";
  if (command != "read_restart")
    refuse(lmp, "the run is to go on from " + checkpoint_name() + " but '" + command +
                    "' of the script makes a new box" + remedy);
  std::error_code unreachable;
  if (narg < 1 || !fs::equivalent(arg[0], script().choice.restart_file, unreachable))
    refuse(lmp, "the run is to go on from '" + script().choice.restart_file + "' but the script reads '" +
                    (narg > 0 ? arg[0] : "") + "'" + remedy);
  script().read = true;
}

void check_first_run(LAMMPS* lmp) {
  Script& now = script();
  if (now.read && lmp->update->ntimestep != now.choice.mark.step)
    refuse(lmp, checkpoint_name() + " is read but the first run begins at step " +
                    std::to_string(lmp->update->ntimestep) + ": remove what changes the step before the run");
  check_fluid(lmp);
  now.goes_on = false;
}

/// The stock launcher knows no -resume: its variables say the same.
void resume_from_variables(LAMMPS* lmp) {
  const auto value = [lmp](const char* name) {
    std::string variable = name;
    const char* const text = lmp->input->variable->retrieve(variable.data());
    return std::string(text ? text : "");
  };
  if (script().asked || value("resumes") != "1")
    return;
  const std::string file = value("checkpoint");
  std::string why;
  const std::optional<link::Manifest> manifest = link::check_folder(fs::path(file).parent_path(), &why);
  if (!manifest)
    refuse(lmp,
           "resumable: variable checkpoint is '" + file + "' but " + why + "; expected checkpoints/STEP/dem.restart");
  link::CheckpointChoice choice;
  choice.mark = manifest->mark;
  choice.restart_file = file;
  choice.notes = manifest->notes;
  resume_from(choice);
}

void resumable_command(LAMMPS* lmp, int narg, char** arg) {
  Script& now = script();
  if (lmp->domain->box_exist != 0)
    refuse(lmp, "resumable: there is a box already: write it before create_box, read_data or read_restart");
  resume_from_variables(lmp);
  now.every = 0;
  try {
    base::OptionReader reader({arg, arg + narg});
    while (reader.more()) {
      if (reader.keyword() != "every")
        reader.unknown("every N");
      now.every = reader.count(1, "steps");
    }
  } catch (const std::invalid_argument& problem) {
    refuse(lmp, std::string("resumable: ") + problem.what());
  }
  now.resumable = true;
  now.replaying = now.goes_on;
}

void create_resumable(LAMMPS* lmp, int narg, char** arg) {
  resumable_command(lmp, narg, arg);
}

StyleRecord resumable_record() {
  StyleRecord record{"command", "resumable", "with -resume, the script goes on from the newest checkpoint"};
  record.command = &create_resumable;
  return record;
}

const RegisterStyle registered(resumable_record());

} // namespace

void resume_from(const link::CheckpointChoice& choice) {
  Script& now = script();
  now = Script();
  now.asked = true;
  now.choice = choice;
  now.goes_on = choice.mark.step >= 0;
  for (const auto& [name, value] : choice.notes)
    if (name == "run") {
      std::istringstream numbers(value);
      RunSpan span{};
      numbers >> span.first >> span.last;
      now.done.push_back(span);
    }
}

bool asked_to_resume() {
  return script().asked;
}

std::int64_t resumed_step() {
  return script().read ? script().choice.mark.step : -1;
}

bool resumes_alone() {
  const link::Notes& notes = script().choice.notes;
  return std::none_of(notes.begin(), notes.end(),
                      [](const auto& note) { return note.first == "fluid" && !note.second.empty(); });
}

bool forces_carry_on() {
  return !script().set_up_anew;
}

bool keeps_checkpoints(LAMMPS* lmp) {
  return FixCheckpoint::find(lmp) != nullptr;
}

std::vector<RunSpan> runs_so_far() {
  return script().runs;
}

bool stands_in_for(LAMMPS* lmp, const char* name, int narg, char** arg) {
  const std::string command = name;
  Script& now = script();
  if (now.replaying)
    return replay(lmp, command, narg, arg);
  if (now.goes_on && kBeginnings.count(command) != 0)
    check_reading(lmp, command, narg, arg);
  if (command != "run" && command != "run_time")
    return false;
  if (now.goes_on)
    check_first_run(lmp);
  else if (!now.inside_run)
    now.set_up_anew = stands_at_end_of_run(lmp) && sets_up(narg, arg);
  if (!now.inside_run)
    now.runs.push_back(span_of(lmp, command, narg, arg, lmp->update->ntimestep));
  return false;
}

void after(LAMMPS* lmp, const std::string& command, const std::vector<std::string>& arguments) {
  Script& now = script();
  if (now.resumable && kBeginnings.count(command) != 0 && lmp->domain->box_exist != 0)
    FixCheckpoint::add(lmp, now.every);
  // A file of many steps goes on; of files of one step each, those after the checkpoint are written again.
  if (now.replaying && command == "dump" && arguments.size() > 4 && arguments[4].find('*') == std::string::npos)
    lmp->input->one(("dump_modify " + arguments[0] + " append yes").c_str());
}

} // namespace eccentra::styles
