// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements case_parameters.h.
#include "report/case_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>

namespace eccentra::report {
namespace {

namespace fs = std::filesystem;

std::string without_quotes(const std::string& value) {
  return value.size() > 1 && value.front() == '"' && value.back() == '"' ? value.substr(1, value.size() - 2) : value;
}

/// Matches of a pattern of (name, value, comment) in the lines of a file; the last one of a name counts.
std::vector<Parameter> lines_of(const fs::path& file, const std::regex& pattern) {
  std::vector<Parameter> parameters;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, pattern))
      continue;
    const Parameter found{match.str(1), without_quotes(match.str(2)), match.size() > 3 ? match.str(3) : ""};
    const auto known = std::find_if(parameters.begin(), parameters.end(),
                                    [&found](const Parameter& other) { return other.name == found.name; });
    if (known == parameters.end())
      parameters.push_back(found);
    else
      known->value = found.value;
  }
  return parameters;
}

/// How a parameter is said in a caption: as it is, or as a number times `factor` with a unit.
struct Phrase {
  const char* name;
  const char* before;
  double factor; ///< 0: the words as they are
  const char* unit;
};
constexpr Phrase kPhrases[] = {{"holeRadius", "hole", 2000, " mm"},
                               {"pipeRadius", "pipe", 2000, " mm"},
                               {"eccentricity", "eccentricity", 1, ""},
                               {"inclination", "inclination", 1, " degrees"},
                               {"width", "column", 1000, " mm"},
                               {"drumRadius", "drum", 2000, " mm"},
                               {"rpm", "", 1, " rpm"},
                               {"velocity", "mean velocity", 1, " m/s"},
                               {"velocityLast", "superficial velocity", 1, " m/s"},
                               {"tau0", "tau0", 1, " Pa"},
                               {"k", "k", 1, " Pa s^n"},
                               {"n", "n", 1, ""},
                               {"shape", "", 0, ""},
                               {"diameter", "grains of", 1000, " mm"}};

} // namespace

std::vector<Parameter> parameters_of(const Case& data) {
  static const std::regex entry(R"re(\s*(\w+)\s+("[^"]*"|[^\s;]+)\s*;\s*(?://\s*(.*))?)re");
  static const std::regex variable(R"re(\s*variable\s+(\w+)\s+index\s+("[^"]*"|[^\s#]+).*)re");
  std::vector<Parameter> parameters = lines_of(data.folder / "scene", entry);
  return parameters.empty() ? lines_of(data.folder / "log.liggghts", variable) : parameters;
}

std::string caption_of_parameters(const Case& data) {
  std::map<std::string, std::string> values;
  for (const Parameter& parameter : parameters_of(data))
    values[parameter.name] = parameter.value;
  if (data.is_annulus) { // the mesh knows, whatever the script says
    const Section& section = data.section;
    values["holeRadius"] = fmt::format("{}", section.hole_radius);
    values["pipeRadius"] = fmt::format("{}", section.pipe_radius);
    values["eccentricity"] =
        fmt::format("{:.3g}", -section.pipe_centre[1] / (section.hole_radius - section.pipe_radius));
    values["inclination"] = fmt::format("{}", data.inclination);
  }
  if (values.count("clusters") != 0 && values["clusters"] == "0")
    values["shape"] = "sphere";
  std::string caption;
  for (const Phrase& phrase : kPhrases) {
    const auto found = values.find(phrase.name);
    if (found == values.end())
      continue;
    char* end = nullptr;
    const double number = std::strtod(found->second.c_str(), &end);
    if (phrase.factor > 0 && *end != '\0')
      continue;
    caption += caption.empty() ? "" : ", ";
    caption += phrase.before;
    caption += *phrase.before != '\0' ? " " : "";
    caption += phrase.factor > 0 ? fmt::format("{:.4g}{}", phrase.factor * number, phrase.unit) : found->second;
  }
  if (values.count("sizes") != 0) // the diameter is that in their middle
    caption += ", " + values["sizes"].substr(0, values["sizes"].find(' ')) + " sizes";
  return caption;
}

} // namespace eccentra::report
