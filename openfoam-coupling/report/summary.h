// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of a case: means over the last part of the run, profile over the height, cost by part.
#pragma once

#include "report/body_classes.h"
#include "report/case_data.h"

#include <string>
#include <vector>

namespace eccentra::report {

struct Mean {
  double value = 0;
  double error = 0; ///< standard error, from the means of successive parts of the run; 0 if there is one part
};

/// Mean and standard error of values that follow each other in time, from `parts` batch means (fewer if there are fewer
/// values). Throws std::invalid_argument without values.
Mean mean_of(const std::vector<double>& values, std::size_t parts = 5);

/// One line of the summary.
struct Quantity {
  std::string name;
  std::string unit;
  Mean mean;
  double scale = 1; ///< the value is printed times this
};

struct Summary {
  std::string name;
  double from = 0;       ///< mean from here [s] ...
  double until = 0;      ///< ... to here
  bool in_steps = false; ///< both are steps: log.liggghts does not say how long these are
  std::vector<Quantity> quantities;
  std::vector<double> profile;                         ///< solid fraction per layer, low side first; of an annulus
  std::vector<std::pair<std::string, double>> seconds; ///< wall-clock seconds by part
  std::vector<BodyClass> classes;                      ///< of its bodies
};

/// Unit vector towards the high side; towards +y (away from the pipe) in a vertical hole, which has no high side.
std::array<double, 2> high_side();

/// `share`: the last part of the run that counts, 0 to 1. Throws std::invalid_argument outside this range.
Summary summarise(const Case& data, double share, std::size_t layers);

/// Cases side by side, one quantity a line.
std::string to_text(const std::vector<Summary>& summaries);
std::string to_csv(const std::vector<Summary>& summaries);
/// A table of the classes of each case that has more than one; empty if none has.
std::string classes_text(const std::vector<Summary>& summaries);
std::string classes_csv(const std::vector<Summary>& summaries);
std::string profile_csv(const std::vector<Summary>& summaries);

} // namespace eccentra::report
