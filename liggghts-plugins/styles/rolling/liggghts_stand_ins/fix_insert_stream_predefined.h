// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for the header of this name in Debian's package, a stub that does not compile. LIGGGHTS-PUBLIC has no such
// fix: its pair loop looks for one, finds none, and calls none of this.
#pragma once

#include "fix_insert_stream.h"

namespace LAMMPS_NS {

class FixInsertStreamPredefined : public FixInsertStream {
 public:
  bool has_inserted() const { return false; }
  void copy_history(int, int, double*) const {}
};

} // namespace LAMMPS_NS
