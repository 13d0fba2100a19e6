// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The cores of rounded bodies where they are.
#pragma once

#include "bodies_scene.h"

#include "contact/contact_core.h"

#include <vector>

namespace eccentra::test {

/// Of all bodies of a scene on one rank, by local index; each of them is rounded.
inline std::vector<contact::PosedCore> posed_cores(LiggghtsSession& session) {
  const styles::FixClusterBodies& bodies = *styles::FixClusterBodies::find(&session.lammps());
  std::vector<contact::PosedCore> posed(session.atom().nlocal);
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const double* q = bodies.quaternion(static_cast<int>(i));
    posed[i].pose(bodies.shapes().surface(bodies.shape_id(static_cast<int>(i))).core,
                  Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix());
  }
  return posed;
}

} // namespace eccentra::test
