// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of any scene: bodies at their true shape, walls, the speed of the fluid on a plane, scale bar and gravity.
#pragma once

#include "report/case_data.h"

#include <string>
#include <vector>

namespace eccentra::report {

/// One column of a picture.
struct View {
  const Case* data = nullptr;
  std::size_t file = 0; ///< of data->spheres
  std::string caption;
};

/// The last file of each case, with its name, time and number of bodies.
std::vector<View> last_views(const std::vector<Case>& cases);

/// `count` files of one case, evenly from the first to the last; with a fluid from its start on. Throws
/// std::invalid_argument if `count` is 0.
std::vector<View> strip(const Case& data, std::size_t count);

/// Time [s] of a file of particles: from the time step of the log, and in a coupled run from the end of coupling.csv,
/// so that it is negative before the flow begins. -1 if the log does not say the time step.
double time_of(const Case& data, const ParticleFile& file);

/// The name of a case and the time of its last file.
std::string title_of(const Case& data);

/// The columns beside each other, gravity downwards, with one scale of length for those of one case. A turning drum is
/// seen along its axis, everything else across its shortest horizontal side; with a fluid the bodies in front of the
/// middle plane are drawn before the speed of the fluid on it.
/// Writes a PNG. Needs a display (shape::VirtualDisplay).
void draw_views(const std::vector<View>& views, const std::filesystem::path& file);

/// The pictures of one case one after the other, a tenth of a second each, as an animated PNG: with one sight, one
/// scale of length and one of colour.
void draw_film(const std::vector<View>& views, const std::filesystem::path& file);

} // namespace eccentra::report
