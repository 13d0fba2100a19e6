// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Words of a contact model that name one of several options, with a sentence that lists them, a switch, or a shape.
#pragma once

#include <mpi.h>

#include "pointers.h"
#include "settings.h"

#include <string>
#include <utility>
#include <vector>

namespace eccentra::styles {

/// `name OPTION`, one of `options` (word and value); the first is the default. `target` must outlive the parsing.
void register_option(Settings& settings, const std::string& model, const std::string& name, int& target,
                     const std::vector<std::pair<std::string, int>>& options);

/// `name on|off`, also yes, no and none; `target` has the default. It must outlive the parsing.
void register_switch(Settings& settings, const std::string& model, const std::string& name, bool& target);

/// `name on|off|FACTOR`: 1, 0 or a number of at least 0; `target` has the default. It must outlive the parsing.
void register_factor(Settings& settings, const std::string& model, const std::string& name, double& target);

/// `shape WORDS`, those of any family of shapes, up to the next keyword of the model or the end of the line: they go to
/// `target`, which must outlive the parsing.
void register_shape_keywords(const LAMMPS_NS::LAMMPS& lmp, Settings& settings, const std::string& model,
                             std::vector<std::string>& target);

} // namespace eccentra::styles
