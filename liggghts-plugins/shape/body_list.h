// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Positions, orientations and velocities of bodies in a text file. Includes no LIGGGHTS header.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace eccentra::shape {

/// One line of the list. World frame, SI.
struct ListedBody {
  int line;                               ///< in the file, from 1
  double place[3];                        ///< of the centre of mass [m]
  double orientation[4] = {1, 0, 0, 0};   ///< w x y z, body to world, of length 1
  double velocity[3] = {0, 0, 0};         ///< [m/s]
  double angular_velocity[3] = {0, 0, 0}; ///< world frame [rad/s]
};

/// Reads one body per line: x y z, then optionally w x y z of the orientation, the velocity and the angular velocity.
/// A line has 3, 7, 10 or 13 numbers, separated by blanks or commas. # starts a comment. Throws std::invalid_argument
/// with a sentence that names the file and the line.
std::vector<ListedBody> read_body_list(std::istream& in, const std::string& file);

} // namespace eccentra::shape
