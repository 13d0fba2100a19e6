// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Four charts of one or more cases in one picture: profile, flux, pressure gradient, cost by part.
#pragma once

#include "report/summary.h"

namespace eccentra::report {

/// Writes charts.png and charts.svg. `cases` and `summaries` belong together row by row. Needs a display
/// (shape::VirtualDisplay).
void draw_charts(const std::vector<Case>& cases, const std::vector<Summary>& summaries,
                 const std::filesystem::path& folder);

} // namespace eccentra::report
