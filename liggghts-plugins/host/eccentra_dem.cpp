// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The launcher: LIGGGHTS with our styles, used exactly as the `liggghts` command is.
#include "eccentra/version.h"
#include "host/style_registry.h"

#include <mpi.h>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

#include <csignal>
#include <cstdio>
#include <cstring>

namespace {

void print_styles() {
  std::printf("eccentra-dem %s for LIGGGHTS-PUBLIC %s\n", ECCENTRA_VERSION, ECCENTRA_LIGGGHTS_VERSION);
  std::printf("usage: eccentra-dem -in SCRIPT [any option of liggghts]\n\nStyles beyond those of LIGGGHTS:\n");
  for (const auto& record : eccentra::host::style_records())
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
  {
    LAMMPS_NS::LAMMPS liggghts(argc, argv, MPI_COMM_WORLD);
    liggghts.input->file();
  }
  MPI_Finalize();
  return 0;
}
