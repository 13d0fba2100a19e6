// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The launcher: LIGGGHTS with our styles, used exactly as the `liggghts` command is.
#include "eccentra/version.h"
#include "link/checkpoint/checkpoint_choice.h"
#include "link/checkpoint/checkpoint_room.h"
#include "link/checkpoint/resume_command.h"
#include "link/start_mpi.h"
#include "styles/entry/script_replay.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// Ends the program, of which one rank has failed.
[[noreturn]] void fail(const std::string& sentence) {
  std::fflush(nullptr);
  std::fprintf(stderr, "eccentra-dem: error: %s\n", sentence.c_str());
  std::fflush(stderr);
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (size > 1)
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  MPI_Finalize();
  std::_Exit(EXIT_FAILURE);
}

void print_styles() {
  std::printf("eccentra-dem %s for LIGGGHTS-PUBLIC %s\n", ECCENTRA_VERSION, ECCENTRA_LIGGGHTS_VERSION);
  std::printf("usage: eccentra-dem -in SCRIPT [-resume] [any option of liggghts]\n"
              "  -resume: go on from the newest complete checkpoint (docs/checkpoints.md)\n\nStyles "
              "beyond those of LIGGGHTS:\n");
  for (const auto& record : eccentra::styles::style_records())
    std::printf("  %-17s %-34s %s\n", record.kind.c_str(), record.name.c_str(), record.summary.c_str());
}

/// LIGGGHTS finishes the present step and writes its restart when these arrive.
void install_signal_handlers() {
  struct sigaction interrupt = {};
  interrupt.sa_handler = LAMMPS_NS::SignalHandler::int_handler;
  sigaction(SIGINT, &interrupt, nullptr);
  sigaction(SIGTERM, &interrupt, nullptr);
  struct sigaction warning = {};
  warning.sa_handler = LAMMPS_NS::SignalHandler::usr1_handler;
  sigaction(SIGUSR1, &warning, nullptr);
  // A file that may not grow further is told to whoever writes it.
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Text of the first rank on all.
std::string shared(std::string text) {
  int bytes = static_cast<int>(text.size());
  MPI_Bcast(&bytes, 1, MPI_INT, 0, MPI_COMM_WORLD);
  text.resize(bytes);
  MPI_Bcast(text.data(), bytes, MPI_CHAR, 0, MPI_COMM_WORLD);
  return text;
}

/// The newest complete checkpoint, the same on all ranks. Ends the program where there are checkpoints and none is
/// complete.
eccentra::link::CheckpointChoice choose_checkpoint() {
  using namespace eccentra::link;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  CheckpointChoice choice;
  std::string notes;
  if (rank == 0) {
    choice = newest_checkpoint(fluid_record_is_whole);
    for (const std::string& sentence : choice.passed_over)
      std::printf("%s\n", sentence.c_str());
    if (choice.none_is_whole())
      fail("none of the checkpoints in '" + std::string(kCheckpoints) +
           "' is complete: remove or rename that folder to begin anew");
    if (choice.mark.step < 0)
      std::printf("no complete checkpoint: the run begins at its beginning\n");
    else
      std::printf("the run goes on from checkpoint %lld\n", static_cast<long long>(choice.mark.step));
    for (const auto& [name, value] : choice.notes)
      notes += name + ' ' + value + '\n';
  }
  // The file's name follows from the step.
  MPI_Bcast(&choice.mark, sizeof choice.mark, MPI_BYTE, 0, MPI_COMM_WORLD);
  choice.restart_file = restart_file_of(choice.mark);
  std::istringstream lines(shared(notes));
  choice.notes.clear();
  for (std::string line; std::getline(lines, line);)
    choice.notes.emplace_back(line.substr(0, line.find(' ')), line.substr(line.find(' ') + 1));
  return choice;
}

/// The log of the interrupted run stays, under another name.
void keep_log(int argc, char** argv) {
  std::string log = "log.liggghts";
  for (int i = 1; i + 1 < argc; ++i)
    if (!std::strcmp(argv[i], "-log") || !std::strcmp(argv[i], "-l"))
      log = argv[i + 1];
  std::error_code unreachable;
  if (!std::filesystem::is_regular_file(log, unreachable))
    return;
  try {
    eccentra::link::keep_beside(log);
  } catch (const eccentra::link::Refusal& refusal) {
    std::printf("warning: %s\n", refusal.what());
  }
}

/// Runs the script, and says so where its end has been reached.
void run_script(std::vector<char*> arguments) {
  LAMMPS_NS::LAMMPS liggghts(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD);
  liggghts.input->file();
  if (LAMMPS_NS::SignalHandler::request_quit || !eccentra::styles::keeps_checkpoints(&liggghts))
    return;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
    eccentra::link::mark_finished(".");
}

} // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "-h") || !std::strcmp(argv[i], "--help") || !std::strcmp(argv[i], "--version")) {
      print_styles();
      return 0;
    }
  }
  eccentra::link::remember_command(argc, argv);
  install_signal_handlers();
  eccentra::link::start_mpi(&argc, &argv);
  std::vector<std::string> words;
  for (int i = 0; i < argc; ++i) {
    if (std::strcmp(argv[i], "-resume") != 0) {
      words.emplace_back(argv[i]);
      continue;
    }
    const eccentra::link::CheckpointChoice choice = choose_checkpoint();
    eccentra::styles::resume_from(choice);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0 && choice.mark.step >= 0)
      keep_log(argc, argv);
    const std::vector<std::string> more = eccentra::link::script_variables(choice);
    words.insert(words.end(), more.begin(), more.end());
  }
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  try {
    run_script(arguments);
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
  std::fflush(stdout);
  bool lost = std::ferror(stdout) != 0;
  if (lost) {
    std::clearerr(stdout);
    std::printf("warning: messages before this one have found no room in standard output\n");
    lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  }
  if (lost)
    std::fprintf(stderr, "eccentra-dem: error: the script has come to its end but standard output takes no "
                         "messages: give them a file or disk with room\n");
  MPI_Finalize();
  return lost ? EXIT_FAILURE : EXIT_SUCCESS;
}
