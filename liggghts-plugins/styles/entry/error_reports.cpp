// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the place of LIGGGHTS's error routines (as preload_hook.cpp stands in front of its input): the same sentence
// and end, without a path of LIGGGHTS's sources and without the remarks that stock adds to some errors. Signals of a
// crash are reported, too.
#include "styles/entry/error_reports.h"

#include <mpi.h>

#include "compute.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "output.h"
#include "universe.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

namespace eccentra::styles {
namespace {

/// An error of all ranks that one rank raises alone would wait for the others for ever [s].
constexpr double kAloneAfter = 20.0;

/// What outlives everything: exit handlers and signals come late.
struct Watch {
  std::string program;  ///< that hosts LIGGGHTS; empty where LIGGGHTS is the program
  std::string log_name; ///< of the whole job
  int log = -1;         ///< appends to it
  bool shown = false;   ///< an error stands on the terminal
  char crash[256] = {}; ///< up to the name of the signal
  std::size_t crash_length = 0;
  std::vector<LastWords*> listeners;
};
Watch& watch() {
  static auto* const instance = new Watch;
  return *instance;
}

struct Crash {
  int signal;
  const char* name;
  struct sigaction before;
};
Crash crashes[] = {{SIGSEGV, "a segmentation fault", {}},
                   {SIGBUS, "a bus error", {}},
                   {SIGILL, "an illegal instruction", {}},
                   {SIGABRT, "an abort or an exception that nobody caught", {}}};

void write_all(int file, const char* text, std::size_t length) {
  (void)!write(file, text, length);
}

// Only what a signal handler may call. What stood before us (the MPI library's or OpenFOAM's stack) comes after.
void report_crash(int signal) {
  const Watch& w = watch();
  for (const Crash& crash : crashes) {
    if (crash.signal != signal)
      continue;
    for (const int file : {STDERR_FILENO, w.log}) {
      if (file < 0)
        continue;
      write_all(file, w.crash, w.crash_length);
      write_all(file, crash.name, std::strlen(crash.name));
      constexpr char kEnd[] = "; the last lines of the log say where, please report it\n";
      write_all(file, kEnd, sizeof kEnd - 1);
    }
    sigaction(signal, &crash.before, nullptr);
  }
  raise(signal);
}

void watch_crashes(int rank) {
  Watch& w = watch();
  const bool first = w.crash_length == 0;
  std::snprintf(w.crash, sizeof w.crash, "%s%s%d: the program has crashed by ", w.program.c_str(),
                w.program.empty() ? "ERROR on proc " : ": error: rank ", rank);
  w.crash_length = std::strlen(w.crash);
  if (!first)
    return;
  for (Crash& crash : crashes) {
    struct sigaction action = {};
    action.sa_handler = report_crash;
    action.sa_flags = SA_NODEFER;
    sigaction(crash.signal, &action, &crash.before);
  }
}

/// The file behind an open stream; empty if it has no name.
std::string name_of(FILE* stream) {
  if (!stream)
    return "";
  char name[PATH_MAX];
  const ssize_t length = readlink(("/proc/self/fd/" + std::to_string(fileno(stream))).c_str(), name, sizeof name);
  return length > 0 && name[0] == '/' ? std::string(name, static_cast<std::size_t>(length)) : "";
}

} // namespace

LastWords::LastWords(std::function<void(const std::string&)> hear) : hear_(std::move(hear)) {
  watch().listeners.push_back(this);
}

LastWords::~LastWords() {
  std::vector<LastWords*>& all = watch().listeners;
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
}

void tell_last_words(const std::string& sentence) {
  const std::vector<LastWords*> all = std::move(watch().listeners);
  watch().listeners.clear();
  for (const LastWords* listener : all)
    listener->hear_(sentence);
}

void name_hosting_program(const std::string& program) {
  watch().program = program;
}

bool error_was_shown() {
  return watch().shown;
}

void watch_errors(LAMMPS_NS::LAMMPS* lmp) {
  Watch& w = watch();
  int rank = 0;
  MPI_Comm_rank(lmp->world, &rank);
  std::string name = name_of(lmp->logfile);
  int length = static_cast<int>(name.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, lmp->world);
  name.resize(length);
  MPI_Bcast(name.data(), length, MPI_CHAR, 0, lmp->world);
  if (lmp->logfile) {
    // By whole lines and at the end, whoever writes: an abort throws away what a buffer still holds.
    std::fflush(lmp->logfile);
    std::setvbuf(lmp->logfile, nullptr, _IOLBF, BUFSIZ);
    const int file = fileno(lmp->logfile);
    fcntl(file, F_SETFL, fcntl(file, F_GETFL) | O_APPEND);
  }
  if (name != w.log_name) {
    if (w.log >= 0)
      close(w.log);
    w.log = name.empty() ? -1 : open(name.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    w.log_name = name;
  }
  watch_crashes(rank);
}

namespace {

/// What LIGGGHTS's error routines know of their instance.
struct Instance {
  MPI_Comm world;
  FILE *screen, *log;
  LAMMPS_NS::Output* output;
  bool partitioned; ///< one of several worlds of a universe
};

int rank_in(MPI_Comm world) {
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  return rank;
}

int size_of(MPI_Comm world) {
  int size = 1;
  MPI_Comm_size(world, &size);
  return size;
}

/// `rank`: the one that raised the error, of several; -1: all.
std::string shown_sentence(const std::string& sentence, int rank) {
  const std::string& program = watch().program;
  const std::string number = rank < 0 ? "" : std::to_string(rank);
  if (program.empty())
    return (rank < 0 ? "ERROR: " : "ERROR on proc " + number + ": ") + sentence;
  return program + ": error: " + (rank < 0 ? "in the DEM script: " : "on rank " + number + ", in the DEM script: ") +
         sentence;
}

/// The log also says where in LIGGGHTS's own sources a sentence comes from.
std::string logged_sentence(const std::string& sentence, const char* file, int line) {
  const bool of_stock = file && !std::strstr(file, "/styles/");
  return "ERROR: " + sentence + "\n" +
         (of_stock ? "(raised at " + std::string(file) + ":" + std::to_string(line) + " of LIGGGHTS)\n" : "");
}

void show(const std::string& sentence, int rank, FILE* screen) {
  Watch& w = watch();
  const std::string line = shown_sentence(sentence, rank) + "\n";
  if (screen)
    std::fputs(line.c_str(), screen);
  std::fflush(nullptr);
  if (screen != stdout)
    write_all(STDERR_FILENO, line.data(), line.size());
  w.shown = true;
}

/// Ends the process where its rank is the only one, and all ranks otherwise.
[[noreturn]] void end_alone(MPI_Comm world) {
  if (size_of(world) == 1) {
    MPI_Finalize();
    std::exit(EXIT_FAILURE);
  }
  MPI_Abort(world, EXIT_FAILURE);
  std::abort();
}

/// The error of one rank.
[[noreturn]] void raise_alone(MPI_Comm world, FILE* screen, const std::string& sentence, const char* file, int line) {
  show(sentence, size_of(world) > 1 ? rank_in(world) : -1, screen);
  const std::string logged = logged_sentence(sentence, file, line);
  if (watch().log >= 0)
    write_all(watch().log, logged.data(), logged.size());
  tell_last_words(sentence);
  end_alone(world);
}

/// Waits until all ranks are here, which an error of all ranks takes for granted; false if they do not come.
bool all_are_here(MPI_Comm world) {
  MPI_Request request;
  MPI_Ibarrier(world, &request);
  const auto begun = std::chrono::steady_clock::now();
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done)
      return true;
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() > kAloneAfter)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// The error of all ranks. Dumps are closed as at the end of a script.
[[noreturn]] void raise_together(const Instance& of, const std::string& sentence, const char* file, int line) {
  if (!all_are_here(of.world))
    raise_alone(of.world, nullptr, sentence, file, line);
  if (rank_in(of.world) == 0) {
    if (of.log)
      std::fputs(logged_sentence(sentence, file, line).c_str(), of.log);
    show(sentence, -1, of.screen);
    tell_last_words(sentence);
  }
  delete of.output;
  if (of.screen && of.screen != stdout)
    std::fclose(of.screen);
  if (of.log)
    std::fclose(of.log);
  if (of.partitioned)
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  MPI_Finalize();
  std::exit(EXIT_FAILURE);
}

/// LIGGGHTS says nothing but where it was raised if the text is of two letters at most.
std::string of_style(const char* kind, const char* what, const char* style, const char* id, const char* text) {
  if (std::strlen(text) <= 2)
    return std::string("Illegal ") + what + " " + style + " (id " + id + ") command";
  return std::string(kind) + " " + style + " (id " + id + "): " + text;
}

} // namespace
} // namespace eccentra::styles

namespace LAMMPS_NS {

using namespace eccentra::styles;

void Error::one(const char* file, int line, const char* str) {
  raise_alone(universe->nworlds > 1 ? universe->uworld : world, screen, str, file, line);
}

void Error::universe_one(const char* file, int line, const char* str) {
  raise_alone(universe->uworld, universe->uscreen, str, file, line);
}

void Error::universe_all(const char* file, int line, const char* str) {
  raise_together({universe->uworld, universe->uscreen, universe->ulogfile, output, false}, str, file, line);
}

void Error::all(const char* file, int line, const char* str) {
  raise_together({world, screen, logfile, output, universe->nworlds > 1}, str, file, line);
}

void Error::fix_error(const char* file, int line, Fix* fix, const char* style, const char* str) {
  raise_together({world, screen, logfile, output, universe->nworlds > 1}, of_style("Fix", "fix", style, fix->id, str),
                 file, line);
}

void Error::compute_error(const char* file, int line, Compute* compute, const char* str) {
  raise_together({world, screen, logfile, output, universe->nworlds > 1},
                 of_style("Compute", "compute", compute->style, compute->id, str), file, line);
}

} // namespace LAMMPS_NS
