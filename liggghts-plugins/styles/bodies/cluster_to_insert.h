// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One cluster on its way into the scene through stock fix insert/*.
#pragma once

#include <mpi.h>

#include "particleToInsert.h"
#include "random_park.h"

namespace eccentra::styles {

/// A particle to insert that becomes a body: stock code draws its place as for a sphere of the bounding radius; overlap
/// is tested with its sub-spheres.
class ClusterToInsert : public LAMMPS_NS::ParticleToInsert {
 public:
  ClusterToInsert(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::FixPropertyAtom* release)
      : ParticleToInsert(lmp, 1, release), shape_id(-1), own_orientation{1, 0, 0, 0} {}

  int shape_id; ///< in FixClusterBodies::shapes()
  LAMMPS_NS::RanPark* orientations =
      nullptr;               ///< draws other orientations where the first does not fit; null: none fits
  double own_orientation[4]; ///< drawn by the template; the `orientation` of fix insert comes on top

  int insert() override;
  int check_near_set_x_v_omega(double* x, double* v, double* omega, double* quat,
                               RegionNeighborList<interpolate_no>& near) override;
  int set_x_v_omega(double* x, double* v, double* omega, double* quat) override;
  void scale_pti(double factor) override;

 private:
  void set_orientation(const double* insertion);
  double orientation_[4] = {1, 0, 0, 0};
};

} // namespace eccentra::styles
