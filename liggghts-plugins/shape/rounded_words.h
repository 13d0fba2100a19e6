// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies as users type them.
#pragma once

#include "shape/rounded_hull.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// A body made of arguments, and what its user should know about it.
struct RoundedShape {
  RoundedHull hull;
  std::string remark; ///< a sentence, or empty
};

/// True for the first arguments of a rounded body: smooth, hull.
bool is_rounded_word(const std::string& word);

/// Reads from arguments[first] on, `used` becomes the number of arguments consumed:
///   smooth cube | smooth box A B C | smooth disk aspect H | hull NAME.stl [scale S]
/// each with `rounding R` or `sphericity S`, and maybe `contact_radius C`. R in (0, 1] is the radius of edges and
/// corners over half the smallest outer extent; H is thickness over diameter; A B C are outer edges [m], or their
/// proportions where a diameter is given. `diameter` [m] of the sphere of equal volume; <= 0 keeps the size that a box
/// or a file gives. Throws std::invalid_argument with one sentence that names the word, its value and the remedy.
RoundedShape make_rounded(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                          double diameter);

/// The convex hull of a file, for `hull NAME.stl`; VTK, which reads it, lives apart.
struct HullOfFile {
  ConvexCore core;
  std::string remark; ///< where the file's body is not convex, or has more vertices than a hull may have
};
using HullReader = HullOfFile (*)(const std::string& path, double scale);
void install_hull_reader(HullReader reader);

} // namespace eccentra::shape
