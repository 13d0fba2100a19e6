// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of the beds: bodies coloured by speed in front of the fluid's speed on the plane through both axes.
#pragma once

#include "report/case_data.h"

namespace eccentra::report {

/// One column per case, with gravity pointing down: above, a side view cut at the plane through both axes; below, the
/// cross-section at half length. All have the same scale of length and of colour.
/// Writes a PNG. Needs a display (shape::VirtualDisplay).
void draw_beds(const std::vector<Case>& cases, const std::filesystem::path& file);

} // namespace eccentra::report
