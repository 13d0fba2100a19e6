// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// dump cluster/vtk: all sub-spheres and surfaces (or one row per body) as a VTK file per dump step, for ParaView.
#pragma once

#include <mpi.h>

#include "dump.h"

#include <string>
#include <vector>

namespace eccentra::styles {

/// Rows are sorted by body, so that a file is the same on any number of ranks.
class DumpClusterVtk : public LAMMPS_NS::Dump {
 public:
  DumpClusterVtk(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  void write() override;

 private:
  void init_style() override;
  int modify_param(int narg, char** arg) override;
  [[noreturn]] void refuse_word(const std::string& text);
  // Dump::write would call these; ours gathers and writes by itself.
  void write_header(LAMMPS_NS::bigint) override {}
  void pack(int*) override {}
  void write_data(int, double*) override {}

  std::string file_name() const;
  std::vector<double> gather() const;
  std::string write_file(const std::vector<double>& rows) const;

  bool bodies_only_ = false;
};

} // namespace eccentra::styles
