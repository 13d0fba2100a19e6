// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which level of detail is good enough: from the results of scripts/accuracy-cost, or from geometry alone.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <istream>
#include <string>
#include <vector>

namespace eccentra::shape {

/// One level of detail in one scene, by one result: a row of levels.csv (docs/accuracy-cost.md).
struct LevelResult {
  std::string scene, body, result, level;
  double mean = 0, standard_error = 0;       ///< of the result, over `runs`; NaN where it failed
  double deviation = 0, deviation_error = 0; ///< from the reference, relative; NaN for the reference itself
  double seconds = 0;                        ///< CPU time of a run [s]
  int runs = 0;
  bool failed = false;
};

/// Reads levels.csv; columns by name, others are passed over. Throws std::invalid_argument with one sentence that names
/// `name` and the line.
std::vector<LevelResult> read_level_results(std::istream& in, const std::string& name);

/// How sure the data are that a level stays within the error.
enum class Confidence {
  sure,      ///< deviation and its standard error together stay below it
  likely,    ///< the deviation does, but its standard error reaches beyond
  reference, ///< no level does: the reference alone is left
  unknown    ///< the finest level was not run, or gives 0: nothing to compare with
};

/// The cheapest level of one scene and result.
struct Advice {
  std::string scene, result;
  LevelResult level, reference;
  Confidence confidence = Confidence::reference;
};

/// One advice for each scene and result that `body` (cube, disk) was run in; `scene` empty: all of them. The reference
/// is the last level of a scene's result, as scripts/accuracy-cost writes them. Throws std::invalid_argument where
/// there is no result at all.
std::vector<Advice> advise(const std::vector<LevelResult>& results, const std::string& body, const std::string& scene,
                           double error);

/// A table and what it rests on; `source`: the file's name.
std::string text_of(const std::vector<Advice>& advice, double error, const std::string& source);
nlohmann::json json_of(const std::vector<Advice>& advice, double error, const std::string& source);

/// What geometry alone says of a level: relative deviations from the finest level of the family.
struct GeometryLevel {
  std::string name;
  int spheres = 0;
  double eccentricity = 0; ///< of the mean delta_e/R_eq on a plane
  double sphericity = 0;
  double inertia = 0; ///< of the ratio of the largest to the smallest principal moment
  double largest() const;
};

/// Levels of `body` from the coarsest to the finest, the reference, which comes last. Throws std::invalid_argument for
/// a family without levels.
std::vector<GeometryLevel> geometry_levels(const std::string& body);
std::string text_of(const std::vector<GeometryLevel>& levels, double error);
nlohmann::json json_of(const std::vector<GeometryLevel>& levels, double error);

} // namespace eccentra::shape
