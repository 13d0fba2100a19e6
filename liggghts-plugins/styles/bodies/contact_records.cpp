// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where pair style, walls and outputs of one LIGGGHTS instance meet.
#include "styles/bodies/contact_records.h"

#include <map>

namespace eccentra::styles {

ContactRecords& contact_records(LAMMPS_NS::LAMMPS* lmp) {
  static std::map<LAMMPS_NS::LAMMPS*, ContactRecords> records;
  return records[lmp];
}

} // namespace eccentra::styles
