// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One contact of a (sub-)sphere with a wall, whatever the wall is made of.
#pragma once

#include "contact/wall_history.h"

#include <Eigen/Core>

#include <cmath>

namespace eccentra::contact {

/// World frame, SI. Vectors that start at the body's centre are free of periodic images.
struct WallTouch {
  int atom;                      ///< local index
  WallHistoryEntry* history;     ///< of this contact
  WallContactKey key;            ///< of this contact
  Eigen::Vector3d normal;        ///< unit, from the wall to the sphere
  Eigen::Vector3d lever;         ///< from the body's centre to the contact point (half the overlap deep)
  Eigen::Vector3d to_wall;       ///< from the body's centre to the wall's surface
  Eigen::Vector3d wall_velocity; ///< of the wall's material there
  Eigen::Vector3d wall_omega;    ///< angular velocity of the wall
  double overlap;                ///< > 0
  double radius;                 ///< of the sphere
  int wall_type;                 ///< material
  int triangle;                  ///< local index in the mesh of key.mesh(); -1 for primitive walls
  double weight = 1;             ///< of a rounded body's spring; negative: an elastic correction
  double hertz_radius = 0;       ///< in Hertz's law, where it is not the sphere's

  /// What Hertz's law makes of the overlap: a = w sqrt(R overlap) [m].
  double contact_radius() const { return weight * std::sqrt((hertz_radius > 0 ? hertz_radius : radius) * overlap); }
};

} // namespace eccentra::contact
