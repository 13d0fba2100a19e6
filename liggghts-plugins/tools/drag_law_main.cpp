// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// dragLaw: the drag coefficients of the closures as a table.
#include "base/option_reader.h"
#include "base/refusal.h"
#include "base/standard_output.h"
#include "closures/drag_table.h"

#include "eccentra/version.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

namespace {
using namespace eccentra::closures;
using eccentra::base::finite_number;
using eccentra::base::OptionReader;
using eccentra::base::refuse;

constexpr const char* kHelp =
    "dragLaw LAW[,LAW...]|all --reynolds RE [--sphericity PHI] [--crosswise P] [--fraction A]\n"
    "dragLaw LAW[,LAW...]|all --points FILE|- [--fraction A]\n"
    "Prints C_D in a Newtonian fluid as comma-separated values, on the diameter of the sphere of equal volume.\n"
    "  --reynolds    rho U d/mu\n"
    "  --sphericity  surface of the sphere of equal volume over that of the particle (default 1)\n"
    "  --crosswise   pi d^2/4 over the area that the particle shows to the flow (default: the sphericity)\n"
    "  --fraction    fluid fraction (default 1)\n"
    "  --points      a file of lines 'sphericity reynolds [crosswise]'; - is standard input\n";

struct Point {
  double sphericity = 1.0, reynolds = 0.0, crosswise = 0.0; ///< crosswise 0: the sphericity
};

void check(const Point& p, const std::string& where) {
  if (!(p.sphericity > 0.0 && p.sphericity <= 1.0))
    refuse("{}: the sphericity '{}' is not greater than 0 and at most 1; expected 1 for a sphere, less for others",
           where, p.sphericity);
  if (!(p.reynolds > 0.0))
    refuse("{}: the Reynolds number '{}' is not positive; expected rho U d/mu", where, p.reynolds);
  if (p.crosswise < 0.0)
    refuse("{}: the crosswise sphericity '{}' is negative; expected pi d^2/4 over the area across the flow", where,
           p.crosswise);
}

std::vector<Point> read_points(const std::string& name) {
  std::ifstream file;
  if (name != "-") {
    file.open(name);
    if (!file)
      refuse("--points: '{}' cannot be read; expected a file of lines 'sphericity reynolds [crosswise]'", name);
  }
  std::istream& in = name == "-" ? std::cin : file;
  std::vector<Point> points;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::istringstream words(line);
    std::vector<double> values;
    for (std::string word; words >> word;) {
      const auto value = finite_number(word);
      if (!value)
        refuse("{}, line {}: '{}' is not a number; expected 'sphericity reynolds [crosswise]'", name, number, word);
      values.push_back(*value);
    }
    if (values.empty())
      continue;
    if (values.size() < 2 || values.size() > 3)
      refuse("{}, line {}: {} values; expected 'sphericity reynolds [crosswise]'", name, number, values.size());
    points.push_back({values[0], values[1], values.size() > 2 ? values[2] : 0.0});
    check(points.back(), fmt::format("{}, line {}", name, number));
  }
  return points;
}

std::vector<const DragLaw*> laws_of(std::string names) {
  if (names == "all")
    names = drag_law_names();
  std::vector<const DragLaw*> laws;
  std::string name;
  for (const char c : names + ",") {
    if (c != ',' && c != '|') {
      name += c;
      continue;
    }
    laws.push_back(find_drag_law(name));
    if (!laws.back())
      refuse("'{}' is no drag law; expected {}|all", name, drag_law_names());
    name.clear();
  }
  return laws;
}

int run(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments[0] == "--version") {
    std::puts("dragLaw " ECCENTRA_VERSION);
    return 0;
  }
  if (arguments.empty() || arguments[0] == "--help" || arguments[0] == "-h") {
    std::fputs(kHelp, arguments.empty() ? stderr : stdout);
    return arguments.empty() ? 1 : 0;
  }
  const std::vector<const DragLaw*> laws = laws_of(arguments[0]);
  OptionReader reader({arguments.begin() + 1, arguments.end()});
  Point one;
  DragPlace place;
  std::string file, of_one;
  while (reader.more()) {
    const std::string word = reader.keyword();
    if (word == "--points")
      file = reader.value("a file name, or - for standard input");
    else if (word == "--fraction") {
      place.fraction = reader.positive("the fluid fraction");
      if (place.fraction > 1.0)
        refuse("--fraction: '{}' is greater than 1; expected a fluid fraction", place.fraction);
    } else if (word == "--reynolds")
      one.reynolds = reader.positive(of_one = word);
    else if (word == "--sphericity")
      one.sphericity = reader.positive(of_one = word);
    else if (word == "--crosswise")
      one.crosswise = reader.positive(of_one = word);
    else
      reader.unknown("--reynolds, --sphericity, --crosswise, --fraction, --points");
  }
  if (!file.empty() && !of_one.empty())
    refuse("{}: the file of --points has this value in each line; expected one of the two", of_one);
  if (file.empty())
    check(one, "--reynolds");
  const Rheology fluid{0.0, 1.0, 1.0, 1.0};
  std::string text = "sphericity,reynolds,crosswise";
  for (const DragLaw* law : laws)
    text += fmt::format(",{}", law->name);
  text += '\n';
  for (const Point& p : file.empty() ? std::vector<Point>{one} : read_points(file)) {
    place.crosswise = p.crosswise > 0.0 ? p.crosswise : p.sphericity;
    text += fmt::format("{},{},{}", p.sphericity, p.reynolds, place.crosswise);
    for (const DragLaw* law : laws)
      text += fmt::format(",{:.12g}", law->reduced({p.sphericity}, place, fluid, p.reynolds).value / p.reynolds);
    text += '\n';
  }
  std::fputs(text.c_str(), stdout);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    const int status = run({argv + 1, argv + argc});
    eccentra::finish_standard_output();
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dragLaw: error: %s\n", error.what());
    return 1;
  }
}
