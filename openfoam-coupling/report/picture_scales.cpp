// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements picture_scales.h.
#include "report/picture_scales.h"

#include "report/picture_parts.h"

#include <vtkLeaderActor2D.h>
#include <vtkProperty2D.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace eccentra::report {
namespace {

constexpr double kLetter = 0.52; // mean width of a letter over the size of the text

/// 1, 2 or 5 times a power of ten: the longest one up to `limit`.
double round_length(double limit) {
  const double digit = std::pow(10.0, std::floor(std::log10(limit)));
  constexpr double one_digit = 1 + 1e-9;
  for (const double step : {5.0, 2.0})
    if (step * digit <= limit * one_digit)
      return step * digit;
  return digit;
}

void add_leader(vtkRenderer& renderer, double x0, double y0, double x1, double y1, bool arrow) {
  const auto leader = vtkSmartPointer<vtkLeaderActor2D>::New();
  leader->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  leader->GetPosition2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  leader->GetPosition2Coordinate()->SetReferenceCoordinate(nullptr);
  leader->SetPosition(x0, y0);
  leader->SetPosition2(x1, y1);
  if (arrow)
    leader->SetArrowPlacementToPoint2();
  else
    leader->SetArrowPlacementToNone();
  leader->SetArrowStyleToFilled();
  leader->GetProperty()->SetColor(0, 0, 0);
  leader->GetProperty()->SetLineWidth(4);
  renderer.AddViewProp(leader);
}

} // namespace

void add_scales(vtkRenderer& renderer, const Scales& scales) {
  const double width = scales.pixels;
  constexpr double share = 0.4; // of the column that the bar takes at most
  const double length = round_length(share * width / scales.pixels_per_metre);
  const double part = length * scales.pixels_per_metre / width;
  constexpr double left = 0.08, height = 0.72;
  add_leader(renderer, left, height, left + part, height, false);
  const std::string said = length < 1 ? fmt::format("{:.3g} mm", 1e3 * length) : fmt::format("{:.3g} m", length);
  constexpr double edge = 6; // pixels, which a short bar's text keeps from the side
  const double half_text = kLetter * kTextSize * static_cast<double>(said.size()) / 2;
  add_text(renderer, said, kTextSize, std::max(left + part / 2, (half_text + edge) / width), 0.36);
  const double size = std::hypot(scales.flow[0], scales.flow[1]);
  if (size > 0) {
    constexpr double middle = 0.68, half = 32; // pixels
    const double right = half * scales.flow[0] / size, up = half * scales.flow[1] / size;
    add_leader(renderer, middle - right / width, 0.6 - up / kScalePixels, middle + right / width,
               0.6 + up / kScalePixels, true);
    // Beside an arrow that stands, below one that lies.
    const bool lies = std::abs(right) > std::abs(up);
    add_text(renderer, "flow", kTextSize, lies ? middle : middle - 40 / width, lies ? 0.15 : 0.6);
  }
  if (!scales.gravity)
    return;
  constexpr double right = 0.92;
  add_leader(renderer, right, 0.9, right, 0.25, true);
  add_text(renderer, "g", kTextSize, right - 22 / width, 0.6);
}

std::vector<std::string> wrapped(const std::string& text, double pixels) {
  const auto most = static_cast<std::size_t>(std::max(12.0, pixels / (kLetter * kSmallText)));
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > most)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  }
  return lines;
}

double title_pixels(std::size_t lines) {
  return kTitlePixels + kLinePixels * static_cast<double>(lines);
}

void add_title(vtkRenderer& renderer, const std::string& title, const std::vector<std::string>& lines, double pixels) {
  add_text(renderer, title, kTextSize + 4, 0.5, 1 - 0.55 * kTitlePixels / pixels);
  for (std::size_t k = 0; k < lines.size(); ++k)
    add_text(renderer, lines[k], kSmallText, 0.5,
             1 - (0.95 * kTitlePixels + kLinePixels * static_cast<double>(k)) / pixels);
}

} // namespace eccentra::report
