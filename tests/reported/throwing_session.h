// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS in the process of the test, with errors that are exceptions. For one source file of a program: it defines
// functions of LIGGGHTS.
#pragma once

#include "link/start_mpi.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "atom.h"
#include "error.h"
#include "input.h"
#include "lammps.h"

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// LIGGGHTS ends the process with its errors; here they are exceptions, so that one process tries many.
// NOLINTBEGIN(misc-definitions-in-headers): one source file of a program includes this
namespace LAMMPS_NS {
void Error::all(const char*, int, const char* sentence) {
  throw std::runtime_error(sentence);
}
void Error::one(const char*, int, const char* sentence) {
  throw std::runtime_error(sentence);
}
void Error::fix_error(const char*, int, Fix*, const char* sentence) {
  throw std::runtime_error(sentence);
}
void Error::fix_error(const char*, int, Fix*, const char*, const char* sentence) {
  throw std::runtime_error(sentence);
}
} // namespace LAMMPS_NS
// NOLINTEND(misc-definitions-in-headers)

namespace eccentra::test {

/// LIGGGHTS inside this process, whose errors are exceptions.
class Session {
 public:
  explicit Session(const std::string& script) {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (!initialised) {
      link::start_mpi(nullptr, nullptr);
      std::atexit([] { MPI_Finalize(); });
    }
    static std::vector<std::string> words = {"liggghts", "-log", "none", "-screen", "/dev/null"};
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    // An instance that an exception has left is in no state to be taken down.
    lammps_ = new LAMMPS_NS::LAMMPS(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD);
    styles::enter(lammps_);
    run(script);
  }

  void run(const std::string& script) {
    std::istringstream lines(script);
    for (std::string line; std::getline(lines, line);)
      lammps_->input->one(line.c_str());
  }

  /// The sentence that stops the script, or an empty one.
  std::string refusal(const std::string& script) {
    try {
      run(script);
    } catch (const std::runtime_error& sentence) {
      return sentence.what();
    }
    return {};
  }

  LAMMPS_NS::LAMMPS& lammps() { return *lammps_; }
  LAMMPS_NS::Atom& atom() { return *lammps_->atom; }
  styles::FixClusterBodies& bodies() { return styles::FixClusterBodies::require(lammps_); }

 private:
  LAMMPS_NS::LAMMPS* lammps_;
};

} // namespace eccentra::test
