// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The sub-contacts of one step with their forces, written down by pair style and walls where an output wants them.
#pragma once

#include <mpi.h>

#include "compute.h"

#include <algorithm>
#include <vector>

namespace eccentra::styles {

/// World frame, SI.
struct ContactRecord {
  static constexpr int wall = -1;

  int a, b;         ///< local or ghost indices of the bodies; b: `wall` for a wall
  int sub_a, sub_b; ///< sub-spheres, as numbered in SurfaceSpheres; sub_b of a wall: 0
  double arm[3];    ///< from A's centre of mass to the contact point, in the middle of the overlap [m]
  double normal[3]; ///< unit, from B to A
  double overlap;
  double radius_a, radius_b; ///< of the sub-spheres; radius_b of a wall: 0
  double force[3];           ///< on A [N]
  double torque[3];          ///< on A about its centre of mass [N m], without rolling friction
  double history[3];         ///< tangential displacement [m]
};

/// Outputs announce themselves; who computes forces asks once a step whether one of them is due.
class ContactRecords {
 public:
  void add_reader(LAMMPS_NS::Compute* reader) {
    if (readers_.empty())
      step_ = -1;
    readers_.push_back(reader);
  }
  void remove_reader(LAMMPS_NS::Compute* reader) {
    readers_.erase(std::remove(readers_.begin(), readers_.end(), reader), readers_.end());
  }
  /// True if the contacts of this step are to be written down.
  bool wanted(LAMMPS_NS::bigint step) {
    if (readers_.empty())
      return false;
    bool due = false;
    for (LAMMPS_NS::Compute* reader : readers_)
      due = due || reader->matchstep(step);
    return due;
  }
  /// Forgets the contacts of earlier steps: the pair style comes first.
  void begin(LAMMPS_NS::bigint step) {
    step_ = step;
    rows.clear();
  }
  bool holds(LAMMPS_NS::bigint step) const { return step_ == step; }

  std::vector<ContactRecord> rows;

  /// Contact m of a block of the contact law, evaluated, of atom `a` with `b`.
  template <class Block> void add(const Block& c, int m, int a, int b, int sub_a, int sub_b) {
    ContactRecord row;
    row.a = a;
    row.b = b;
    row.sub_a = sub_a;
    row.sub_b = sub_b;
    row.overlap = c.overlap[m];
    row.radius_a = c.radius_a[m];
    row.radius_b = b == ContactRecord::wall ? 0 : c.radius_b[m];
    for (int k = 0; k < 3; ++k) {
      row.normal[k] = c.normal[k][m];
      row.arm[k] = c.arm[k][m] - (row.radius_a - 0.5 * row.overlap) * row.normal[k];
      row.force[k] = c.force[k][m];
      row.torque[k] = c.torque[k][m];
      row.history[k] = c.history[k][m];
    }
    rows.push_back(row);
  }

 private:
  std::vector<LAMMPS_NS::Compute*> readers_;
  LAMMPS_NS::bigint step_ = -1;
};

/// Those of a LIGGGHTS instance.
ContactRecords& contact_records(LAMMPS_NS::LAMMPS* lmp);

} // namespace eccentra::styles
