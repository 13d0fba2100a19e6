// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the cheapest level within an error, and says what the choice rests on.
#include "tools/advise.h"

#include "shape/eccentricity.h"
#include "shape/shape_family.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr const char* kMaker = "scripts/accuracy-cost writes such files";
constexpr double kDiameter = 1.0; ///< ratios do not depend on it
constexpr double kPercent = 100.0;

/// Cells of a line of CSV (RFC 4180): quotes keep commas together, "" is a quote.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const char c = line[n];
    if (quoted && c == '"' && n + 1 < line.size() && line[n + 1] == '"') {
      cells.back() += c;
      ++n;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

double number(const std::string& text, const std::string& where) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end)
    throw std::invalid_argument(where + " has '" + text + "' where a number belongs: " + kMaker);
  return value;
}

const char* word_of(Confidence confidence) {
  switch (confidence) {
  case Confidence::sure:
    return "sure";
  case Confidence::likely:
    return "likely";
  case Confidence::reference:
    return "reference only";
  case Confidence::unknown:
    break;
  }
  return "not known";
}

double relative(double value, double reference) {
  return std::abs(value / reference - 1.0);
}

/// First level that stays within the error, with all finer ones.
const GeometryLevel& chosen_of(const std::vector<GeometryLevel>& levels, double error) {
  std::size_t first = levels.size() - 1;
  while (first > 0 && levels[first - 1].largest() <= error)
    --first;
  return levels[first];
}

} // namespace

std::vector<LevelResult> read_level_results(std::istream& in, const std::string& name) {
  enum { kScene, kBody, kResult, kLevel, kMean, kError, kRuns, kDeviation, kDeviationError, kSeconds, kFailed, kCount };
  static const std::array<const char*, kCount> columns = {
      "scene", "body",      "result",          "level", "mean",  "standard_error",
      "runs",  "deviation", "deviation_error", "cpu_s", "failed"};
  std::string line;
  if (!std::getline(in, line))
    throw std::invalid_argument("'" + name + "' is empty: " + kMaker);
  const std::vector<std::string> header = split(line);
  std::array<std::size_t, kCount> at{};
  for (std::size_t k = 0; k < kCount; ++k) {
    at[k] = std::find(header.begin(), header.end(), columns[k]) - header.begin();
    if (at[k] == header.size())
      throw std::invalid_argument("'" + name + "' line 1 has no column '" + columns[k] + "': " + kMaker);
  }
  std::vector<LevelResult> results;
  for (int number_of_line = 2; std::getline(in, line); ++number_of_line) {
    const std::vector<std::string> cells = split(line);
    const std::string where = "'" + name + "' line " + std::to_string(number_of_line);
    if (cells.size() != header.size())
      throw std::invalid_argument(where + " has " + std::to_string(cells.size()) + " cells and the header " +
                                  std::to_string(header.size()) + ": " + kMaker);
    LevelResult row;
    row.scene = cells[at[kScene]];
    row.body = cells[at[kBody]];
    row.result = cells[at[kResult]];
    row.level = cells[at[kLevel]];
    row.failed = !cells[at[kFailed]].empty();
    if (!row.failed) {
      row.mean = number(cells[at[kMean]], where);
      row.standard_error = number(cells[at[kError]], where);
      row.deviation = number(cells[at[kDeviation]], where);
      row.deviation_error = number(cells[at[kDeviationError]], where);
      row.seconds = number(cells[at[kSeconds]], where);
      row.runs = static_cast<int>(number(cells[at[kRuns]], where));
    }
    results.push_back(row);
  }
  return results;
}

std::vector<Advice> advise(const std::vector<LevelResult>& results, const std::string& body, const std::string& scene,
                           double error) {
  std::vector<Advice> all;
  const auto wanted = [&](const LevelResult& row) { return row.body == body && (scene.empty() || row.scene == scene); };
  const auto has_result = [](const LevelResult& row) { return !row.failed && std::isfinite(row.mean); };
  for (const LevelResult& row : results) {
    if (!wanted(row))
      continue;
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const Advice& a) { return a.scene == row.scene && a.result == row.result; });
    Advice& advice = known == all.end() ? all.emplace_back() : *known;
    const bool usable = has_result(row) && row.mean != 0;
    advice = {row.scene, row.result, row, row, usable ? Confidence::reference : Confidence::unknown};
  }
  for (Advice& advice : all) {
    if (advice.confidence == Confidence::unknown)
      continue;
    for (const LevelResult& row : results) {
      if (!wanted(row) || !has_result(row) || row.scene != advice.scene || row.result != advice.result ||
          !(std::abs(row.deviation) <= error))
        continue;
      const Confidence confidence =
          std::abs(row.deviation) + row.deviation_error <= error ? Confidence::sure : Confidence::likely;
      if (confidence < advice.confidence || (confidence == advice.confidence && row.seconds < advice.level.seconds)) {
        advice.confidence = confidence;
        advice.level = row;
      }
    }
  }
  if (all.empty())
    throw std::invalid_argument(
        "there is no result of " + body + (scene.empty() ? "" : " in the scene '" + scene + "'") +
        ": run scripts/accuracy-cost with it, or leave --data out for what geometry alone says");
  return all;
}

std::string text_of(const std::vector<Advice>& advice, double error, const std::string& source) {
  std::size_t scene = 0, result = 0;
  for (const Advice& a : advice) {
    scene = std::max(scene, a.scene.size());
    result = std::max(result, a.result.size());
  }
  std::string text =
      fmt::format("cheapest level within {:g} % of the finest one, by the runs in {}\n"
                  "  {:<{}} {:<{}} {:<14} {:>20} {:>9}  {}\n",
                  kPercent * error, source, "scene", scene, "result", result, "level", "deviation", "of time", "it is");
  int missing = 0, unsure = 0, fewest = std::numeric_limits<int>::max();
  double noise = 0;
  for (const Advice& a : advice) {
    if (a.confidence == Confidence::unknown) {
      text += fmt::format("  {:<{}} {:<{}} {:<14} {:>20} {:>9}  {}\n", a.scene, scene, a.result, result, "-",
                          a.reference.level + " has no result", "-", word_of(a.confidence));
      ++missing;
      continue;
    }
    const double reference_noise = std::abs(a.reference.standard_error / a.reference.mean);
    noise = std::max(noise, std::isfinite(reference_noise) ? reference_noise : 0.0);
    unsure += a.confidence != Confidence::sure;
    fewest = std::min(fewest, std::min(a.level.runs, a.reference.runs));
    const std::string deviation =
        a.confidence == Confidence::reference
            ? "is the reference"
            : fmt::format("{:+.1f} +- {:.1f} %", kPercent * a.level.deviation, kPercent * a.level.deviation_error);
    text += fmt::format("  {:<{}} {:<{}} {:<14} {:>20} {:>8.2f}x  {}\n", a.scene, scene, a.result, result,
                        a.level.level, deviation, a.level.seconds / a.reference.seconds, word_of(a.confidence));
  }
  if (missing < static_cast<int>(advice.size()))
    text += fmt::format(
        "This rests on {} run(s) or more of each level; the references themselves are known to {:.1f} % at worst.\n",
        fewest, kPercent * noise);
  if (missing)
    text += fmt::format(
        "'not known', {} times: the finest level was not run or gives 0, so that no deviation is known.\n", missing);
  if (unsure)
    text +=
        "'likely': the deviation is within the error, but its standard error is not: more seeds would tell. 'reference "
        "only': no cheaper level is within it.\n";
  return text + "Another scene may need another level: these are results of these scenes alone.\n";
}

nlohmann::json json_of(const std::vector<Advice>& advice, double error, const std::string& source) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Advice& a : advice) {
    if (a.confidence == Confidence::unknown) {
      rows.push_back({{"scene", a.scene},
                      {"result", a.result},
                      {"reference", a.reference.level},
                      {"confidence", word_of(a.confidence)}});
      continue;
    }
    rows.push_back({{"scene", a.scene},
                    {"result", a.result},
                    {"level", a.level.level},
                    {"deviation", a.confidence == Confidence::reference ? 0.0 : a.level.deviation},
                    {"deviation_error", a.confidence == Confidence::reference ? 0.0 : a.level.deviation_error},
                    {"share_of_time", a.level.seconds / a.reference.seconds},
                    {"reference", a.reference.level},
                    {"runs", std::min(a.level.runs, a.reference.runs)},
                    {"confidence", word_of(a.confidence)}});
  }
  return {{"error", error}, {"rests_on", source}, {"advice", rows}};
}

double GeometryLevel::largest() const {
  return std::max({eccentricity, sphericity, inertia});
}

std::vector<GeometryLevel> geometry_levels(const std::string& body) {
  const std::vector<std::vector<std::string>>& names = shape_family(body).levels;
  if (names.empty())
    throw std::invalid_argument("advise knows no levels of '" + body +
                                "': give a family that has some, such as cube or disk");
  struct Measures {
    double eccentricity, sphericity, inertia;
  };
  std::vector<Measures> measures;
  std::vector<GeometryLevel> levels;
  for (const auto& words : names) {
    std::size_t used = 0;
    const ClusterShape shape = make_shape(words, 0, used, kDiameter);
    const auto inertia = shape.inertia_per_mass();
    measures.push_back({eccentricity_plane(shape).mean(), shape.sphericity(), inertia.maxCoeff() / inertia.minCoeff()});
    levels.push_back({shape.name(), static_cast<int>(shape.spheres().size()), 0, 0, 0});
  }
  const Measures& finest = measures.back();
  for (std::size_t k = 0; k < levels.size(); ++k) {
    levels[k].eccentricity = relative(measures[k].eccentricity, finest.eccentricity);
    levels[k].sphericity = relative(measures[k].sphericity, finest.sphericity);
    levels[k].inertia = relative(measures[k].inertia, finest.inertia);
  }
  return levels;
}

std::string text_of(const std::vector<GeometryLevel>& levels, double error) {
  const GeometryLevel& chosen = chosen_of(levels, error);
  std::string text = fmt::format("deviation from {} [%]\n  {:<12} {:>22} {:>12} {:>16}\n", levels.back().name, "level",
                                 "mean delta_e on plane", "sphericity", "inertia ratio");
  for (const GeometryLevel& level : levels)
    text += fmt::format("  {:<12} {:>22.2f} {:>12.2f} {:>16.2f}{}\n", level.name, kPercent * level.eccentricity,
                        kPercent * level.sphericity, kPercent * level.inertia,
                        &level == &chosen ? "  <- within the error" : "");
  return text +
         fmt::format(
             "{} is the coarsest level within {:g} %{}.\nThis rests on geometry alone: no run supports it. A scene may "
             "need less (a dilute flow) or more (a heap); run scripts/accuracy-cost and give its levels.csv by "
             "--data.\n",
             chosen.name, kPercent * error, &chosen == &levels.back() ? ", as the finest one that is compared" : "");
}

nlohmann::json json_of(const std::vector<GeometryLevel>& levels, double error) {
  nlohmann::json rows = nlohmann::json::array();
  for (const GeometryLevel& level : levels)
    rows.push_back({{"level", level.name},
                    {"eccentricity_error", level.eccentricity},
                    {"sphericity_error", level.sphericity},
                    {"inertia_error", level.inertia}});
  return {{"error", error}, {"rests_on", "geometry alone"}, {"level", chosen_of(levels, error).name}, {"levels", rows}};
}

} // namespace eccentra::shape
