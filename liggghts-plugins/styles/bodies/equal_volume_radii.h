// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lets stock code that computes a volume from an atom's radius see the true volume of a cluster.
#pragma once

#include "styles/bodies/fix_cluster_bodies.h"

#include "atom.h"

#include <cmath>
#include <vector>

namespace eccentra::styles {

/// While it lives, the radius of each cluster (ghosts as well) is that of the sphere of equal volume.
class EqualVolumeRadii {
 public:
  explicit EqualVolumeRadii(LAMMPS_NS::LAMMPS* lmp) : atom_(*lmp->atom) {
    const FixClusterBodies* bodies = FixClusterBodies::find(lmp);
    if (!bodies || bodies->shapes().size() == 0)
      return;
    const int all = atom_.nlocal + atom_.nghost;
    kept_.assign(atom_.radius, atom_.radius + all);
    std::vector<double> radius;
    for (int id = 0; id < bodies->shapes().size(); ++id)
      radius.push_back(std::cbrt(0.75 * bodies->shapes()[id].volume() / M_PI));
    for (int i = 0; i < all; ++i)
      if (const int shape = bodies->shape_id(i); shape != FixClusterBodies::plain_sphere)
        atom_.radius[i] = radius[shape];
  }
  ~EqualVolumeRadii() { std::copy(kept_.begin(), kept_.end(), atom_.radius); }
  EqualVolumeRadii(const EqualVolumeRadii&) = delete;
  EqualVolumeRadii& operator=(const EqualVolumeRadii&) = delete;

 private:
  LAMMPS_NS::Atom& atom_;
  std::vector<double> kept_;
};

} // namespace eccentra::styles
