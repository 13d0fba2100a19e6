// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hosts LIGGGHTS; kept apart from OpenFOAM's headers and macros.
#include "coupled/embeddedDem.h"

#include "styles/entry/error_reports.h"
#include "styles/entry/script_replay.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "input.h"
#include "lammps.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace eccentra {
namespace {

/// Name of the log while a script runs; empty when it has ended well. Outlives everything, for exit handlers.
std::string& running_log() {
  static std::string* name = new std::string;
  return *name;
}

// The script has ended the process by itself (quit, or an exit of a style) without an error that was shown.
void report_early_end() {
  if (running_log().empty() || styles::error_was_shown())
    return;
  std::fprintf(stderr, "annulusFoam: error: the DEM script has ended before its end: see %s\n", running_log().c_str());
  std::fflush(stderr);
}

} // namespace

void run_dem_script(const std::string& script, const std::string& log,
                    const std::optional<link::CheckpointChoice>& resumes) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    running_log() = log;
    std::atexit(report_early_end);
  }
  // Not "-screen none": some stock styles print without asking whether there is a screen.
  std::vector<std::string> words = {"liggghts", "-log", log, "-screen", "/dev/null"};
  if (resumes) {
    styles::resume_from(*resumes);
    const std::vector<std::string> more = link::script_variables(*resumes);
    words.insert(words.end(), more.begin(), more.end());
  }
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  styles::name_hosting_program("annulusFoam");
  {
    LAMMPS_NS::LAMMPS liggghts(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD);
    styles::enter(&liggghts);
    liggghts.input->file(script.c_str());
  }
  running_log().clear();
}

} // namespace eccentra
