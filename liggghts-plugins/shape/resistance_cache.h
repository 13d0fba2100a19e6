// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Resistances of shapes kept in files, so that a shape is solved once and not at each start.
#pragma once

#include "shape/resistance.h"

#include <string>

namespace eccentra::shape {

/// Where the files are: $ECCENTRA_CACHE; else $XDG_CACHE_HOME/eccentra; else $HOME/.cache/eccentra. Empty: nowhere
/// (ECCENTRA_CACHE=none, or no home).
std::string resistance_cache_folder();

/// resistance_of(), from the file of this geometry if there is one. A file is named by a hash of the geometry in units
/// of d (so one serves all sizes) and of the method's version; one that was cut short, changed or written by another
/// version is solved anew and written over. A folder that cannot be written to is no error: the shape is solved each
/// time.
Resistance cached_resistance(const ClusterShape& shape);
Resistance cached_resistance(const RoundedHull& body);

} // namespace eccentra::shape
