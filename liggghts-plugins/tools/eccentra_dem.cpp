// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The launcher: LIGGGHTS with our styles, used exactly as the `liggghts` command is.
#include "eccentra/version.h"
#include "link/checkpoint/checkpoint_choice.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

void print_styles() {
  std::printf("eccentra-dem %s for LIGGGHTS-PUBLIC %s\n", ECCENTRA_VERSION, ECCENTRA_LIGGGHTS_VERSION);
  std::printf("usage: eccentra-dem -in SCRIPT [-resume] [any option of liggghts]\n"
              "  -resume: go on from the newest complete checkpoint of a coupled run (docs/checkpoints.md)\n\nStyles "
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
}

/// Words of the command line that make the script go on from the newest complete checkpoint; the same on all ranks.
std::vector<std::string> arguments_to_resume() {
  using namespace eccentra::link;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  CheckpointChoice choice;
  if (rank == 0) {
    choice = newest_checkpoint(fluid_record_is_whole);
    for (const std::string& sentence : choice.passed_over)
      std::printf("%s\n", sentence.c_str());
    if (choice.mark.step < 0)
      std::printf("no complete checkpoint: the run begins at its beginning\n");
    else
      std::printf("the run goes on from checkpoint %lld\n", static_cast<long long>(choice.mark.step));
  }
  // The file's name follows from the step.
  MPI_Bcast(&choice.mark, sizeof choice.mark, MPI_BYTE, 0, MPI_COMM_WORLD);
  choice.restart_file = restart_file_of(choice.mark);
  return script_variables(choice);
}

} // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "-h") || !std::strcmp(argv[i], "--help") || !std::strcmp(argv[i], "--version")) {
      print_styles();
      return 0;
    }
  }
  install_signal_handlers();
  MPI_Init(&argc, &argv);
  std::vector<std::string> words;
  for (int i = 0; i < argc; ++i) {
    if (std::strcmp(argv[i], "-resume") != 0) {
      words.emplace_back(argv[i]);
      continue;
    }
    const std::vector<std::string> more = arguments_to_resume();
    words.insert(words.end(), more.begin(), more.end());
  }
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  {
    LAMMPS_NS::LAMMPS liggghts(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD);
    liggghts.input->file();
  }
  MPI_Finalize();
  return 0;
}
