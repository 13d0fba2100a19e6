// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Convex hulls of STL files.
#pragma once

#include "shape/rounded_words.h"

namespace eccentra::shape {

/// The hull of the solid in an STL file, lengths times `scale`, thinned; it says where the solid is not convex or where
/// the hull was thinned. Throws std::invalid_argument as Solid does.
HullOfFile hull_of_stl(const std::string& path, double scale);

/// Makes `hull NAME.stl` known to its family. Call once at start.
void install_hull_words();

} // namespace eccentra::shape
