// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Distributions of size as a few classes of bodies of one size each.
#pragma once

#include <string>
#include <vector>

namespace eccentra::shape {

/// Bodies of one size: the part of all bodies, and the diameter of the sphere of equal volume [m].
struct SizeClass {
  double number;   ///< part of the number of all bodies [-]
  double diameter; ///< of the sphere of equal volume [m]
};

/// What the parts of a distribution are parts of.
enum class SizeBasis { number, mass };

/// Classes in ascending order, each with the same part of the number or of the mass. A class has the number and the
/// mass of the bodies that the distribution has in its range. `count` >= 1. Throws std::invalid_argument, without a
/// name in front, if a number does not fit.
std::vector<SizeClass> uniform_sizes(SizeBasis basis, double least, double most, int count);
/// Cut off at three deviations.
std::vector<SizeClass> gaussian_sizes(SizeBasis basis, double mean, double deviation, int count);
/// ln(diameter/median) has this deviation and is cut off at three of them.
std::vector<SizeClass> lognormal_sizes(SizeBasis basis, double median, double deviation, int count);

/// Of the text of a sieve analysis: rows of an aperture [m] and of the part of the mass that passes it [%], both
/// rising, from 0 to 100 %. Between two apertures mass is spread evenly over the logarithm of the size; each range is a
/// class. `where` names the file in messages. Throws std::invalid_argument with one sentence that names the line.
std::vector<SizeClass> sieve_sizes(const std::string& text, const std::string& where);

} // namespace eccentra::shape
