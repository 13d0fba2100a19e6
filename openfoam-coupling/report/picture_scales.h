// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a picture says of itself: a bar of length, the directions of gravity and flow, lines of text.
#pragma once

#include <vtkRenderer.h>

#include <array>
#include <string>
#include <vector>

namespace eccentra::report {

constexpr double kScalePixels = 100; ///< height of the strip that add_scales fills
constexpr int kSmallText = 17;       ///< of the lines under a title, in pixels
constexpr double kLinePixels = 24;   ///< from one such line to the next

/// Of one column of a picture, in which gravity points down.
struct Scales {
  double pixels = 0; ///< width of the column
  double pixels_per_metre = 0;
  bool gravity = false;
  std::array<double, 2> flow = {0, 0}; ///< direction in the picture: right, up; zero: none
};

/// Fills a strip of kScalePixels below a column.
void add_scales(vtkRenderer& renderer, const Scales& scales);

/// Lines of words that fit into a width [pixels] at kSmallText.
std::vector<std::string> wrapped(const std::string& text, double pixels);

/// A title with lines of kSmallText below it, in a strip of this height.
void add_title(vtkRenderer& renderer, const std::string& title, const std::vector<std::string>& lines, double pixels);

/// Height of the strip for a title and so many lines [pixels].
double title_pixels(std::size_t lines);

} // namespace eccentra::report
