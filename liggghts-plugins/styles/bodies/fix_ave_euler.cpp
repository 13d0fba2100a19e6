// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock's fix ave/euler, which averages volume fraction, velocity and stress on a grid, with the true volumes of
// clusters.
#include "styles/bodies/equal_volume_radii.h"
#include "styles/entry/style_registry.h"

#include "fix_ave_euler.h"

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

class FixAveEulerCluster : public FixAveEuler {
 public:
  using FixAveEuler::FixAveEuler;
  void end_of_step() override {
    const EqualVolumeRadii true_volumes(lmp);
    FixAveEuler::end_of_step();
  }
};

const RegisterFix<FixAveEulerCluster> registered("ave/euler", "stock's, with the true volumes of clusters");
const RegisterFix<FixAveEulerCluster> stress("ave/euler/stress", "stock's, with the true volumes of clusters");

} // namespace

} // namespace eccentra::styles
