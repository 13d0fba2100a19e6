// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that a case was computed with, in the words of its own files.
#pragma once

#include "report/case_data.h"

#include <string>
#include <vector>

namespace eccentra::report {

struct Parameter {
  std::string name;
  std::string value;
  std::string meaning; ///< the comment behind it; may be empty
};

/// Entries of the file scene; without one, the index variables of the log.
std::vector<Parameter> parameters_of(const Case& data);

/// What distinguishes a scene, for a line under its name: holes, shapes, sizes, flow.
std::string caption_of_parameters(const Case& data);

} // namespace eccentra::report
