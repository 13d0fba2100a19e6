// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies as plain numbers, for restart files.
#pragma once

#include "shape/rounded_hull.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// All data of the body, bit for bit, without its name.
std::vector<double> record_of(const RoundedHull& hull);
/// The body of a record.
RoundedHull hull_of_record(const std::string& name, const std::vector<double>& record);

} // namespace eccentra::shape
