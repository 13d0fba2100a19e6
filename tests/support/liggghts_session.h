// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A LIGGGHTS instance with our styles inside a test program: commands in, atoms out.
#pragma once

#include <mpi.h>

#include "atom.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <initializer_list>
#include <memory>
#include <string>

namespace eccentra::test {

/// Quiet by default; set ECCENTRA_TEST_VERBOSE in the environment to see what LIGGGHTS prints.
class LiggghtsSession {
 public:
  explicit LiggghtsSession(MPI_Comm ranks = MPI_COMM_WORLD);
  ~LiggghtsSession();
  LiggghtsSession(const LiggghtsSession&) = delete;
  LiggghtsSession& operator=(const LiggghtsSession&) = delete;

  /// Executes one line of an input script. LIGGGHTS ends the process when it finds an error.
  void command(const std::string& line);
  /// Executes a script: one command a line; "&" at the end of a line continues it; "#" starts a comment.
  void script(const std::string& lines);

  LAMMPS_NS::LAMMPS& lammps() { return *lammps_; }
  LAMMPS_NS::Atom& atom() { return *lammps_->atom; }
  /// Local index of the atom with this tag, or -1 if another rank owns it.
  int local(int tag) const;
  int rank() const;
  int ranks() const;

 private:
  std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

} // namespace eccentra::test
