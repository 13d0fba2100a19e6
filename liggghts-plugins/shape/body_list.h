// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Places, orientations and velocities of bodies in a text file; pure, no LIGGGHTS.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace eccentra::shape {

struct ListedBody {
  int line;                               ///< in the file, from 1
  double place[3];                        ///< of the centre of mass [m]
  double orientation[4] = {1, 0, 0, 0};   ///< w x y z, body to world, of length 1
  double velocity[3] = {0, 0, 0};         ///< [m/s]
  double angular_velocity[3] = {0, 0, 0}; ///< world frame [rad/s]
};

/// One body a line: x y z, then w x y z of the orientation, the velocity and the angular velocity, as far as they are
/// given: 3, 7, 10 or 13 numbers, with blanks or commas between them. # begins a comment. Throws std::invalid_argument
/// with a sentence that names the file and the line.
std::vector<ListedBody> read_body_list(std::istream& in, const std::string& file);

} // namespace eccentra::shape
